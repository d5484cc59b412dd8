// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/temporal.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// Fewer accept a wrong look, more delay a jump; swept (events): half 5 won, twice 15 lost.
constexpr std::uint32_t kConfirmations = 3;
// So long a held value ages by the usual period; swept (events): half 1 moved, twice 1 moved.
constexpr std::uint32_t kStillFramesMax = 2;
// Frames of two time constants of 10 s at 20 Hz: the largest temporal_smoothing_tau and a quick sensor.
constexpr std::uint32_t kFramesUntilSettled = 400;
// A millisecond: no LiDAR is that quick, so it is the same frame again, or the stamps are no nanoseconds.
constexpr std::int64_t kStillBelow_ns = 1000000;

// A NaN level must not be hidden by a number.
double larger_or_nan(double a, double b) {
  return !(a <= b) ? a : b;
}

// A jump from the last good value further than machine and errors allow: one of the two values is wrong. Both stay
// possible until the new one has come kConfirmations times more. If there was no good value yet and frames were
// refused, the first measurement is one of several looks at the same thing, and the others were refused.
void check_innovation(const Measurement& m, [[maybe_unused]] const Settings& s, Track* t) {
  const double protection = m.protection.sum();
  const double from_good = protection + t->good.raw_protection + t->good.grown.total();
  if (t->good.exists ? passes<gate::INNOVATION>(std::fabs(m.raw - t->good.raw), from_good) : t->to_confirm == 0) {
    t->to_confirm = 0;
    return;
  }
  const double from_last = protection + t->raw_protection + t->grown.total();
  const bool comes_again = t->has_value && t->to_confirm > 0 && std::fabs(m.raw - t->raw) <= from_last;
  t->to_confirm = comes_again ? t->to_confirm - 1 : kConfirmations;
  POSE_WALL_NOTE(if (!t->good.exists) passes<gate::CONFIRMED>(t->to_confirm, s));
}

// A rival wall seen a moment ago is not gone because this frame does not show it. A level that reached to one falls
// once kConfirmations frames in a row have seen none as far off. Until then a new measurement may be the rival. Floors
// are different: uneven ground shows another slope in one frame of five, and is right in the others.
void keep_doubts(const Settings& s, Track* t, Measurement* m) {
  constexpr double kFrames = kConfirmations + 1;  // in so many frames at most the level that is remembered grew
  const double grown = t->grown.total();
  const bool remembers = !passes<gate::DOUBTED>(t->doubted_frames, s);
  const bool as_far_off = !remembers || m->protection.sum() + kFrames * grown >= t->raw_protection;
  if ((m->reasons & POSE_WALL_R_WALL_AMBIGUOUS) != 0 && as_far_off) {
    t->doubted_frames = kConfirmations;
    return;
  }
  if (!remembers) return;
  --t->doubted_frames;
  m->protection.reach(std::fabs(m->raw - t->raw) + t->raw_protection + grown, POSE_WALL_PART_RIVAL);
}

// Until a jump is confirmed the last good value may be the right one. Without one, the level is no better than the
// alert limit.
void reach_to_last_good(std::uint32_t quantity, const Settings& s, const Track& t, Measurement* m) {
  m->reasons |= POSE_WALL_R_INNOVATION;
  if (t.good.exists) {
    m->protection.reach(std::fabs(m->raw - t.good.raw) + t.good.raw_protection + t.good.grown.total(),
                        POSE_WALL_PART_RIVAL);
  } else {
    m->protection[POSE_WALL_PART_RIVAL] += alert_limit(quantity, s);
  }
}

// Largest distance of the value from raw: a quarter of raw's protection, and not so far that it is no longer valid.
double lag_most(double protection, double alert) {
  // More would hide a good measurement (README, Smoothing); swept (events): half 411 moved, twice 405 moved.
  constexpr double kShare = 0.25;
  constexpr double kOfRoom = 0.99;  // a hundredth for rounding of the parts' sum
  const double share = kShare * protection, room = kOfRoom * (alert - protection);
  return room > 0.0 && room < share ? room : share;
}

double clamped(double x, double centre, double reach) {
  if (x > centre + reach) return centre + reach;
  return x < centre - reach ? centre - reach : x;
}

// Predicts the value by a steady change and corrects it by the measurement. In this g-h filter the memory fades as fast
// for the value as for its rate. So it neither lags in a steady turn nor swings (Benedict and Bordner 1962; Brookner
// 1998, eq. 1.2-16: g = 1 - theta^2, h = (1 - theta)^2). The memory is no longer than the measurements so far. The
// second one gives the rate, without the lag of a filter that assumes rest.
double smoothed(double raw, double trust, double tau_s, Track* t) {
  const double dt_s = t->age_s;
  const bool filters = dt_s > 0.0 && tau_s > 0.0;
  if (t->smoothed_frames < kFramesUntilSettled) ++t->smoothed_frames;
  const double frames = t->smoothed_frames, remembered = (frames - 1.0) / (frames + 1.0);
  const double settled = filters ? tau_s / (tau_s + dt_s) : 0.0;
  const double theta = settled < remembered ? settled : remembered;
  const double predicted = t->value + t->rate * dt_s;
  const double off = trust * (raw - predicted);
  t->rate = filters ? t->rate + (1.0 - theta) * (1.0 - theta) * off / dt_s : 0.0;
  return filters ? predicted + (1.0 - theta * theta) * off : raw;
}

// Moves the smoothed value; true if the yaw limit held it back. A value near its raw is better than a smooth one, so
// the limit acts only within lag_most().
bool follow(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t) {
  const double protection = m.protection.sum(), known = t->protection.sum() + t->grown.total(), before = t->value;
  const double trust = protection > known ? known / protection : 1.0;  // a wider one than before pulls less
  const double free = smoothed(m.raw, trust, s.temporal_smoothing_tau, t);
  const bool limited = quantity == POSE_WALL_YAW && !passes<gate::RATE>(std::fabs(free - before), s);
  const double wished = limited ? clamped(free, before, limit_of<gate::RATE>(s)) : free;
  t->value = clamped(wished, m.raw, lag_most(protection, alert_limit(quantity, s)));
  return limited && t->value == wished;
}

// Copies member by member. A struct's copy may bring unwritten padding along, and the engine's sum covers padding too.
void keep_good(const Measurement& m, Track* t) {
  LastGood& good = t->good;
  good.exists = true;
  good.raw = m.raw;
  good.raw_protection = m.protection.sum();
  good.value = t->value;
  good.protection = t->protection;
  good.grown = Unknown{};
  good.age_s = 0.0;
}

void report_protection(const ProtectionParts& protection, pose_wall_value* out) {
  out->protection_level = protection.sum();
  out->cause = POSE_WALL_PART_RANDOM;
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
    out->part[part] = protection.of[part];
    if (protection.of[part] > protection.of[out->cause]) out->cause = part;
  }
}

// By the road where an odometry knows the way, else smoothed. The truth is within the measurement's level of raw, so
// that covers the lag of smoothing too.
void set_value(std::uint32_t quantity, const Change& change, bool afresh, const Settings& s, Track* t, Measurement* m) {
  const bool by_road = change.by_odometry && !afresh && !m->stale;
  if (afresh || m->stale) t->road.exists = false;
  const Recalled recalled = look_again(*m, t->raw, change, quantity, s, &t->road);
  if (afresh || by_road) {
    t->value = recalled.value;
    t->rate = 0.0;
    t->smoothed_frames = 0;
  } else if (follow(*m, quantity, s, t)) {
    m->reasons |= POSE_WALL_R_RATE_LIMITED;
  }
  t->protection = recalled.protection;
  if (!by_road) t->protection[POSE_WALL_PART_LAG] += std::fabs(t->value - m->raw);
}

void set_measured(Measurement m, std::uint32_t quantity, const Change& change, bool afresh, const Settings& s, Track* t,
                  pose_wall_value* out) {
  const bool in_doubt = t->doubted_frames > 0;
  keep_doubts(s, t, &m);
  check_innovation(m, s, t);
  const double seen_protection = m.protection.sum();
  if (t->to_confirm > 0) {
    reach_to_last_good(quantity, s, *t, &m);
  } else {
    m.protection[POSE_WALL_PART_AGE] += m.shown_motion;
  }
  set_value(quantity, change, afresh, s, t, &m);
  t->has_value = true;
  t->expired = false;
  t->raw = m.raw;
  t->sigma = m.sigma;
  t->raw_protection = seen_protection;
  t->age_s = 0.0;
  t->grown = Unknown{};
  const double alert = alert_limit(quantity, s), alone = m.protection.sum();
  const bool within = passes<gate::PROTECTION_SMOOTHED>(t->protection.sum(), alert);
  // The road may tell more than this look, whose own level passed the limit.
  constexpr std::uint32_t kBeyond = POSE_WALL_R_ALERT_LIMIT;
  m.reasons = within ? m.reasons & ~kBeyond : m.reasons | kBeyond;
  const bool valid = within && !m.stale && t->to_confirm == 0;
  if (valid) keep_good(m, t);
  if (!valid && in_doubt) m.reasons |= POSE_WALL_R_WALL_AMBIGUOUS;
  out->state = valid ? POSE_WALL_VALID : POSE_WALL_DEGRADED;
  out->raw_state = valid && alone <= alert ? POSE_WALL_VALID : POSE_WALL_DEGRADED;
  out->reasons = valid ? m.reasons & ~kDoubts : m.reasons;
  out->raw = m.raw;
  out->value = t->value;
  out->raw_protection_level = alone;
  report_protection(t->protection, out);
}

// Holds the last good value if there is one: a degraded frame since then does not replace it.
void set_held(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t, pose_wall_value* out) {
  out->reasons = m.reasons;
  if (!t->good.exists) t->to_confirm = kConfirmations;
  if (!passes<gate::EVER>(t->has_value)) {
    out->reasons |= POSE_WALL_R_NEVER_MEASURED;
    return;
  }
  ProtectionParts last_protection = t->protection, good_protection = t->good.protection;
  last_protection[POSE_WALL_PART_AGE] += t->grown.total();
  good_protection[POSE_WALL_PART_AGE] += t->good.grown.total();
  // An unconfirmed jump may be real: the level of the last value reaches to both.
  const bool hold_good = t->good.exists && t->to_confirm == 0 && good_protection.sum() < last_protection.sum();
  out->value = hold_good ? t->good.value : t->value;
  out->age_s = hold_good ? t->good.age_s : t->age_s;
  report_protection(hold_good ? good_protection : last_protection, out);
  const Unknown& grown = hold_good ? t->good.grown : t->grown;
  const bool narrow = passes<gate::PROTECTION_HELD>(out->protection_level, alert_limit(quantity, s));
  const bool within = passes<gate::HELD_AGE>(grown.blind_s, s) && narrow;
  // A place that is unknown for a while may be known again, and the value with it.
  t->expired = !passes<gate::HELD_BEFORE>(!t->expired) || (!within && grown.steps_by_places == 0);
  const bool holds = within && !t->expired;
  if (!holds) out->reasons |= POSE_WALL_R_HOLD_EXPIRED;
  out->state = holds ? POSE_WALL_HELD : POSE_WALL_INVALID;
}

// While the clock stands still, the machine does not. A frame takes as long as the longer of the last two. The frame in
// which the clock stopped may have been cut short, and takes as long.
double time_while_still(const TemporalState& state) {
  const double period_s = larger_or_nan(state.last_dt_s, state.dt_before_s);
  const double cut_off_s = state.still_frames == 0 ? period_s - state.last_dt_s : 0.0;
  return period_s + cut_off_s;
}

pose_wall_value blank() {
  pose_wall_value v{};
  v.value = v.raw = v.sigma = v.protection_level = v.raw_protection_level = not_a_number();
  for (double& part : v.part) part = not_a_number();
  v.cause = POSE_WALL_PARTS;
  return v;
}

void pass_time(double elapsed_s, const Change& change, std::uint32_t quantity, Track* t) {
  if (!(elapsed_s > 0.0)) return;
  t->age_s += elapsed_s;
  t->good.age_s += elapsed_s;
  t->grown.grow(change, quantity, elapsed_s);
  t->good.grown.grow(change, quantity, elapsed_s);
  const double carried = change.carry[quantity];
  if (carried == 0.0) return;
  for (double* number : {&t->value, &t->raw, &t->good.value, &t->good.raw}) *number += carried;
  t->rate = 0.0;  // the value has been moved
}

// Places and the config's rates both bound the change. A held value goes by places while that leaves it usable, else by
// the narrower of the two.
const Change& narrower(const Change& by_places, const Change& by_config, double elapsed_s, std::uint32_t quantity,
                       const Settings& s, const Track& t) {
  if (!by_places.by_places[quantity] || !t.has_value) return by_places;
  const double protection = t.good.exists ? t.good.protection.sum() : t.protection.sum();
  Unknown told = t.good.exists ? t.good.grown : t.grown, allowed = told;
  told.grow(by_places, quantity, elapsed_s);
  allowed.grow(by_config, quantity, elapsed_s);
  const bool usable = protection + told.total() <= alert_limit(quantity, s);
  return usable || told.total() < allowed.total() ? by_places : by_config;
}

void set_confidence(const Track& t, std::uint32_t quantity, const Settings& s, pose_wall_value* out) {
  if (t.has_value) out->sigma = t.sigma;
  const double alert = alert_limit(quantity, s);
  out->confidence = out->state == POSE_WALL_INVALID ? 0.0 : alert / (alert + out->protection_level);
}

}  // namespace

FrameTiming time_frame(const TemporalState& state, std::int64_t stamp_ns, const Settings& settings) {
  FrameTiming t;
  t.first = !state.has_stamp;
  if (t.first) return t;
  // In floating point: the difference of two arbitrary stamps need not fit an int64.
  t.dt_s = (static_cast<double>(stamp_ns) - static_cast<double>(state.stamp_ns)) * kNanosecond_s;
  const bool exact = t.dt_s > -1e6 && t.dt_s < 1e6;
  if (exact) t.dt_s = static_cast<double>(stamp_ns - state.stamp_ns) * kNanosecond_s;
  POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_FRAME));
  Verdict verdict;
  t.back = !demand<gate::STAMP_BACK>(&verdict, t.dt_s, settings);
  const bool still = !t.back && exact && stamp_ns - state.stamp_ns < kStillBelow_ns;
  t.still = !demand<gate::STAMP_STILL>(&verdict, !still);
  t.leap = !demand<gate::STAMP_LEAP>(&verdict, t.dt_s, settings);
  t.reasons = verdict.reasons;
  return t;
}

double elapsed_of(const TemporalState& state, const FrameTiming& timing) {
  return timing.still ? time_while_still(state) : timing.dt_s;
}

ScanStep scan_step_of(const TemporalState& state, const FrameTiming& timing, const Settings& settings) {
  if (timing.first) return {};
  if (!timing.back && !timing.leap && !timing.still) return {timing.dt_s, true};
  return {state.last_dt_s > 0.0 ? state.last_dt_s : settings.scan_max, false};
}

bool contradict(const Change& change, const Measurements& measured, const FrameTiming& timing,
                const TemporalState& state) {
  if (timing.leap || timing.back || timing.still) return false;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const Track& t = state.track[q];
    const Measurement& m = measured.quantity[q];
    if (!m.measured || !t.has_value || t.expired) continue;
    Unknown grown = t.grown;
    grown.grow(change, q, timing.dt_s);
    const double expected = t.raw + change.carry[q], reach = m.protection.sum() + t.raw_protection + grown.total();
    if (!(std::fabs(m.raw - expected) <= reach)) return true;
  }
  return false;
}

void smooth_and_hold(const Measurements& measured, const FrameTiming& timing, std::int64_t stamp_ns,
                     const Change& change, const Settings& settings, TemporalState* state,
                     pose_wall_value (*values)[POSE_WALL_QUANTITIES]) {
  const double elapsed_s = elapsed_of(*state, timing);
  const Change by_config = change_by_config(settings, elapsed_s);
  state->has_stamp = true;
  state->stamp_ns = stamp_ns;
  state->still_frames = timing.still ? state->still_frames + 1 : 0;
  if (!timing.leap && !timing.still && timing.dt_s > 0.0) {
    state->dt_before_s = state->last_dt_s;
    state->last_dt_s = timing.dt_s;
  }
  const Track& yaw = state->track[POSE_WALL_YAW];
  const double carried_yaw_rad = yaw.has_value ? yaw.raw + change.carry[POSE_WALL_YAW] : 0.0;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    Track& t = state->track[q];
    const Measurement& m = measured.quantity[q];
    pose_wall_value& out = (*values)[q] = blank();
    pass_time(elapsed_s, m.measured ? change : narrower(change, by_config, elapsed_s, q, settings, t), q, &t);
    POSE_WALL_NOTE(trace::subject(POSE_WALL_TRACE_QUANTITY + q));
    // A leap starts afresh: a doubt from before it is of another place, and so are the looks that were refused.
    if (timing.leap) t.doubted_frames = t.to_confirm = 0;
    // After a jump back, or while the clock stands still, the elapsed time is unknown: a held value has no bound any
    // more.
    const bool unknown = timing.still && !(elapsed_s > 0.0);
    if (timing.back || unknown || state->still_frames > kStillFramesMax) t.expired = true;
    if (timing.back) t.good.exists = false;
    // Turned so far, the old side walls are none any more, and the new ones were not seen.
    const bool is_sideways = q >= POSE_WALL_YAW && std::fabs(carried_yaw_rad) > radians(settings.yaw_max_deg);
    if (is_sideways && !m.measured) t.expired = true;
    carry_on(change, q, settings, &t.road);
    if (m.measured) {
      set_measured(m, q, change, !t.has_value || t.expired || timing.leap, settings, &t, &out);
    } else {
      set_held(m, q, settings, &t, &out);
    }
    set_confidence(t, q, settings, &out);
    round_off(&t.road);
  }
}

void age_values(double elapsed_s, std::uint32_t reasons, const Settings& settings, TemporalState* state,
                pose_wall_value (*values)[POSE_WALL_QUANTITIES]) {
  const Change change = change_by_config(settings, elapsed_s);
  Measurement nothing;
  nothing.reasons = reasons;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    // A copy: the next frame counts its own time from the last one, and this time would count twice.
    Track aged = state->track[q];
    pose_wall_value& out = (*values)[q];
    out = blank();
    pass_time(elapsed_s, change, q, &aged);
    set_held(nothing, q, settings, &aged, &out);
    set_confidence(aged, q, settings, &out);
    state->track[q].expired = aged.expired;
  }
}

void rebase(double elapsed_s, std::int64_t stamp_ns, const Settings& settings, TemporalState* state) {
  const Change change = change_by_config(settings, elapsed_s);
  const bool dated = elapsed_s >= 0.0;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    Track& t = state->track[q];
    pass_time(elapsed_s, change, q, &t);
    if (dated) continue;
    t.expired = true;
    t.good.exists = false;
  }
  state->has_stamp = dated && state->has_stamp;
  state->stamp_ns = stamp_ns;
  state->still_frames = 0;
}

}  // namespace pose_wall

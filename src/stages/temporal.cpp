// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/temporal.hpp"

#include <cmath>

#include "math/elementary.hpp"
#include "math/finite.hpp"
#include "trace/trace.hpp"

namespace pose_wall {
namespace {

constexpr double kNanosecond_s = 1e-9;
constexpr std::uint32_t kConfirmations = 3;
constexpr std::uint32_t kStillFramesMax = 2;
// No LiDAR is that quick: it is the same frame again, or the stamps are no nanoseconds, by which everything would be
// held a thousand times too long.
constexpr std::int64_t kStillBelow_ns = 1000000;

// A level that is not a number must not be hidden by one that is.
double larger_or_nan(double a, double b) {
  return !(a <= b) ? a : b;
}

// First-order low pass by backward Euler: exact in the mean for any dt, and free of exp().
double gain(double dt_s, double tau_s) {
  return dt_s >= 0.0 && tau_s > 0.0 ? dt_s / (tau_s + dt_s) : 1.0;
}

// A jump from the last good value further than machine and errors allow: either this value or that one is wrong. Both
// stay possible until the new one has come again kConfirmations times. And where there was no good value yet and frames
// were refused, the first that is not is one of several looks at the same thing, and the others said no.
void check_innovation(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t) {
  const double rate = fastest(quantity, s);
  const double from_good = m.protection + t->good.raw_protection + rate * t->good.age_s;
  if (t->good.exists ? std::fabs(m.raw - t->good.raw) <= from_good : t->to_confirm == 0) {
    t->to_confirm = 0;
    return;
  }
  const double from_last = m.protection + t->raw_protection + rate * t->age_s;
  const bool comes_again = t->has_value && t->to_confirm > 0 && std::fabs(m.raw - t->raw) <= from_last;
  t->to_confirm = comes_again ? t->to_confirm - 1 : kConfirmations;
}

// A rival wall that was seen a moment ago is not gone because this frame does not show it. A level that reached to one
// falls once kConfirmations frames in a row have seen none; until then what is measured anew may be the rival. Not so
// of floors: uneven ground shows another slope in one frame of five, and is right in the others.
double level_in_doubt(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t) {
  if ((m.reasons & POSE_WALL_R_WALL_AMBIGUOUS) != 0) {
    t->doubted_frames = kConfirmations;
    return m.protection;
  }
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_DOUBTED, t->doubted_frames, 0.0, t->doubted_frames == 0));
  if (t->doubted_frames == 0) return m.protection;
  --t->doubted_frames;
  const double reach = std::fabs(m.raw - t->raw) + t->raw_protection + fastest(quantity, s) * t->age_s;
  return larger_or_nan(m.protection, reach);
}

// Moves the smoothed value towards the raw one; true where the yaw limit held it back.
bool follow(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t) {
  const double alert = alert_limit(quantity, s);
  const double trust = m.protection > alert ? alert / m.protection : 1.0;  // a weak measurement pulls less
  double change = trust * gain(t->age_s, s.temporal_smoothing_tau) * (m.raw - t->value);
  const double limit = radians(s.yaw_rate_limit_deg);
  POSE_WALL_NOTE(if (quantity == POSE_WALL_YAW)
                     trace::gate(POSE_WALL_TRACE_RATE, std::fabs(change), limit, !(std::fabs(change) > limit)));
  const bool limited = quantity == POSE_WALL_YAW && std::fabs(change) > limit;
  if (limited) change = change > 0.0 ? limit : -limit;
  t->value += change;
  return limited;
}

#ifdef POSE_WALL_TRACE
void note_timing(const FrameTiming& t, const Settings& s) {
  trace::subject(POSE_WALL_TRACE_FRAME);
  trace::gate(POSE_WALL_TRACE_STAMP_STILL, !t.still);
  trace::gate(POSE_WALL_TRACE_STAMP_BACK, t.dt_s, 0.0, !t.back);
  trace::gate(POSE_WALL_TRACE_STAMP_LEAP, t.dt_s, s.stamp_gap_max, !t.leap);
}

void note_innovation(const Measurement& m, std::uint32_t quantity, const Settings& s, const Track& t) {
  if (!t.good.exists) {
    trace::gate(POSE_WALL_TRACE_CONFIRMED, t.to_confirm, 0.0, t.to_confirm == 0);
    return;
  }
  const double reach = m.protection + t.good.raw_protection + fastest(quantity, s) * t.good.age_s;
  trace::gate(POSE_WALL_TRACE_INNOVATION, std::fabs(m.raw - t.good.raw), reach, t.to_confirm == 0);
}

void note_held(const pose_wall_value& v, std::uint32_t quantity, const Settings& s, const Track& t) {
  const double alert = alert_limit(quantity, s);
  trace::gate(POSE_WALL_TRACE_HELD_LEVEL, v.protection_level, alert, v.protection_level <= alert);
  trace::gate(POSE_WALL_TRACE_HELD_AGE, v.age_s, s.hold_max, v.age_s <= s.hold_max);
  trace::gate(POSE_WALL_TRACE_HELD_BEFORE, !t.expired);
}
#endif

// Member by member: a struct's copy may bring padding along that nobody wrote, and the engine's sum is over padding,
// too.
void keep_good(const Measurement& m, Track* t) {
  LastGood& good = t->good;
  good.exists = true;
  good.raw = m.raw;
  good.raw_protection = m.protection;
  good.value = t->value;
  good.value_protection = t->protection;
  good.age_s = 0.0;
}

void set_measured(Measurement m, std::uint32_t quantity, bool afresh, const Settings& s, Track* t,
                  pose_wall_value* out) {
  const bool in_doubt = t->doubted_frames > 0;
  m.protection = level_in_doubt(m, quantity, s, t);
  out->reasons = m.reasons;
  check_innovation(m, quantity, s, t);
  if (afresh) {
    t->value = m.raw;
  } else if (follow(m, quantity, s, t)) {
    out->reasons |= POSE_WALL_R_RATE_LIMITED;
  }
  t->has_value = true;
  t->expired = false;
  t->raw = m.raw;
  t->sigma = m.sigma;
  t->raw_protection = m.protection;
  t->age_s = 0.0;
  // The truth is within the measurement's level of raw, so this covers the lag of smoothing too.
  t->protection = m.protection + std::fabs(t->value - m.raw);
  POSE_WALL_NOTE(note_innovation(m, quantity, s, *t));
  if (t->to_confirm > 0) {
    if (t->good.exists) {
      const double reach = t->good.raw_protection + fastest(quantity, s) * t->good.age_s;
      const double away = larger_or_nan(std::fabs(t->value - t->good.raw), std::fabs(m.raw - t->good.raw));
      t->protection = larger_or_nan(t->protection, away + reach);
    } else {
      t->protection += alert_limit(quantity, s);  // no better than what would do harm
    }
    out->reasons |= POSE_WALL_R_INNOVATION;
  }
  const bool within = t->protection <= alert_limit(quantity, s);
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_LEVEL_SMOOTHED, t->protection, alert_limit(quantity, s), within));
  if (!within) out->reasons |= POSE_WALL_R_ALERT_LIMIT;
  const bool valid = within && !m.weak && t->to_confirm == 0;
  if (valid) keep_good(m, t);
  if (!valid && in_doubt) out->reasons |= POSE_WALL_R_WALL_AMBIGUOUS;
  out->state = valid ? POSE_WALL_VALID : POSE_WALL_DEGRADED;
  out->raw = m.raw;
  out->value = t->value;
  out->protection_level = t->protection;
}

// What is held is the last good value where there is one: a weak frame since then does not replace it.
void set_held(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t, pose_wall_value* out) {
  out->reasons = m.reasons;
  out->raw = not_a_number();
  if (!t->good.exists) t->to_confirm = kConfirmations;
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_EVER, t->has_value));
  if (!t->has_value) {
    out->reasons |= POSE_WALL_R_NEVER_MEASURED;
    out->state = POSE_WALL_INVALID;
    return;
  }
  const double rate = fastest(quantity, s);
  const double last_level = t->protection + rate * t->age_s;
  const double good_level = t->good.value_protection + rate * t->good.age_s;
  // A jump that nobody has confirmed yet may be one: the level of what came last reaches to both.
  const bool hold_good = t->good.exists && t->to_confirm == 0 && good_level < last_level;
  out->value = hold_good ? t->good.value : t->value;
  out->age_s = hold_good ? t->good.age_s : t->age_s;
  out->protection_level = hold_good ? good_level : last_level;
  const bool within = out->protection_level <= alert_limit(quantity, s) && out->age_s <= s.hold_max;
  POSE_WALL_NOTE(note_held(*out, quantity, s, *t));
  t->expired = t->expired || !within;
  if (t->expired) out->reasons |= POSE_WALL_R_HOLD_EXPIRED;
  out->state = t->expired ? POSE_WALL_INVALID : POSE_WALL_HELD;
}

// While the clock stands still, the machine does not: a frame takes as long as the longer of the last two. So did the
// one in whose course the clock stopped, which may have cut it short.
double time_while_still(const TemporalState& state) {
  const double period_s = larger_or_nan(state.last_dt_s, state.dt_before_s);
  const double cut_off_s = state.still_frames == 1 ? period_s - state.last_dt_s : 0.0;
  return period_s + cut_off_s;
}

pose_wall_value blank() {
  pose_wall_value v{};
  v.value = v.raw = v.sigma = v.protection_level = not_a_number();
  return v;
}

void pass_time(double elapsed_s, Track* t) {
  if (!(elapsed_s > 0.0)) return;
  t->age_s += elapsed_s;
  t->good.age_s += elapsed_s;
}

void set_confidence(const Track& t, std::uint32_t quantity, const Settings& s, pose_wall_value* out) {
  if (t.has_value) out->sigma = t.sigma;
  const double alert = alert_limit(quantity, s);
  out->confidence = out->state == POSE_WALL_INVALID ? 0.0 : alert / (alert + out->protection_level);
}

}  // namespace

double fastest(std::uint32_t quantity, const Settings& s) {
  return quantity <= POSE_WALL_YAW ? s.hold_rate_angle : s.hold_rate_distance;
}

FrameTiming time_frame(const TemporalState& state, std::int64_t stamp_ns, const Settings& settings) {
  FrameTiming t;
  t.first = !state.has_stamp;
  if (t.first) return t;
  // In floating point: the difference of two arbitrary stamps need not fit an int64.
  t.dt_s = (static_cast<double>(stamp_ns) - static_cast<double>(state.stamp_ns)) * kNanosecond_s;
  const bool exact = t.dt_s > -1e6 && t.dt_s < 1e6;
  if (exact) t.dt_s = static_cast<double>(stamp_ns - state.stamp_ns) * kNanosecond_s;
  t.back = stamp_ns < state.stamp_ns;
  t.still = !t.back && exact && stamp_ns - state.stamp_ns < kStillBelow_ns;
  t.leap = t.dt_s > settings.stamp_gap_max;
  POSE_WALL_NOTE(note_timing(t, settings));
  if (t.still) t.reasons |= POSE_WALL_R_STAMP_STILL;
  if (t.back) t.reasons |= POSE_WALL_R_STAMP_BACK;
  if (t.leap) t.reasons |= POSE_WALL_R_STAMP_LEAP;
  return t;
}

void smooth_and_hold(const Measurements& measured, const FrameTiming& timing, std::int64_t stamp_ns,
                     const Settings& settings, TemporalState* state, pose_wall_value (*values)[POSE_WALL_QUANTITIES]) {
  state->has_stamp = true;
  state->stamp_ns = stamp_ns;
  state->still_frames = timing.still ? state->still_frames + 1 : 0;
  const double elapsed_s = timing.still ? time_while_still(*state) : timing.dt_s;
  if (!timing.leap && !timing.still && timing.dt_s > 0.0) {
    state->dt_before_s = state->last_dt_s;
    state->last_dt_s = timing.dt_s;
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    Track& t = state->track[q];
    const Measurement& m = measured.quantity[q];
    pose_wall_value& out = (*values)[q];
    out = blank();
    pass_time(elapsed_s, &t);
    POSE_WALL_NOTE(trace::subject(POSE_WALL_TRACE_QUANTITY + q));
    // After a jump back, or while the clock stands still, nobody knows how much time has passed: what is held has no
    // bound any more.
    const bool unknown = timing.still && !(elapsed_s > 0.0);
    if (timing.back || unknown || state->still_frames > kStillFramesMax) t.expired = true;
    if (timing.back) t.good.exists = false;
    if (m.measured) {
      set_measured(m, q, !t.has_value || t.expired || timing.leap, settings, &t, &out);
    } else {
      set_held(m, q, settings, &t, &out);
    }
    set_confidence(t, q, settings, &out);
  }
}

void age_values(double elapsed_s, std::uint32_t reasons, const Settings& settings, TemporalState* state,
                pose_wall_value (*values)[POSE_WALL_QUANTITIES]) {
  Measurement nothing;
  nothing.reasons = reasons;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    // A copy: the next frame counts its own time from the last one, and this time would count twice.
    Track aged = state->track[q];
    pose_wall_value& out = (*values)[q];
    out = blank();
    pass_time(elapsed_s, &aged);
    set_held(nothing, q, settings, &aged, &out);
    set_confidence(aged, q, settings, &out);
    state->track[q].expired = aged.expired;
  }
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/temporal.hpp"

#include <cmath>

#include "math/elementary.hpp"
#include "math/finite.hpp"

namespace pose_wall {
namespace {

constexpr double kNanosecond_s = 1e-9;
constexpr std::uint32_t kConfirmations = 3;

double larger(double a, double b) {
  return a > b ? a : b;
}

double fastest(std::uint32_t quantity, const Settings& s) {
  return quantity <= POSE_WALL_YAW ? s.hold_rate_angle : s.hold_rate_distance;
}

// First-order low pass by backward Euler: exact in the mean for any dt, and free of exp().
double gain(double dt_s, double tau_s) {
  return dt_s >= 0.0 && tau_s > 0.0 ? dt_s / (tau_s + dt_s) : 1.0;
}

// A jump further than machine and errors allow: either this value or the old one is wrong. Both stay possible until
// the new one has come again kConfirmations times.
void check_innovation(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t) {
  const double allowed = m.protection + t->raw_protection + fastest(quantity, s) * t->age_s;
  if (!(std::fabs(m.raw - t->raw) <= allowed)) {
    t->trusted = t->value;
    t->trusted_protection = t->own_protection;
    t->trusted_age_s = t->age_s;
    t->to_confirm = kConfirmations;
  } else if (t->to_confirm > 0) {
    --t->to_confirm;
  }
}

// Moves the smoothed value towards the raw one; true where the yaw limit held it back.
bool follow(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t) {
  const double alert = alert_limit(quantity, s);
  const double trust = m.protection > alert ? alert / m.protection : 1.0;  // a weak measurement pulls less
  double change = trust * gain(t->age_s, s.temporal_smoothing_tau) * (m.raw - t->value);
  const double limit = radians(s.yaw_rate_limit_deg);
  const bool limited = quantity == POSE_WALL_YAW && std::fabs(change) > limit;
  if (limited) change = change > 0.0 ? limit : -limit;
  t->value += change;
  return limited;
}

void set_measured(const Measurement& m, std::uint32_t quantity, bool afresh, const Settings& s, Track* t,
                  pose_wall_value* out) {
  out->reasons = m.reasons;
  if (afresh) {
    *t = Track{};
    t->value = m.raw;
  } else {
    check_innovation(m, quantity, s, t);
    if (follow(m, quantity, s, t)) out->reasons |= POSE_WALL_R_RATE_LIMITED;
  }
  t->has_value = true;
  t->raw = m.raw;
  t->sigma = m.sigma;
  t->raw_protection = m.protection;
  t->age_s = 0.0;
  // The truth is within the measurement's level of raw, so this covers the lag of smoothing too.
  t->own_protection = m.protection + std::fabs(t->value - m.raw);
  t->protection = t->own_protection;
  if (t->to_confirm > 0) {
    const double reach = t->trusted_protection + fastest(quantity, s) * t->trusted_age_s;
    t->protection = larger(t->protection, std::fabs(t->value - t->trusted) + reach);
    out->reasons |= POSE_WALL_R_INNOVATION;
  }
  const double alert = alert_limit(quantity, s);
  const bool good = !m.weak && t->to_confirm == 0 && t->protection <= alert;
  if (!(t->protection <= alert)) out->reasons |= POSE_WALL_R_ALERT_LIMIT;
  out->state = good ? POSE_WALL_VALID : POSE_WALL_DEGRADED;
  out->raw = m.raw;
  out->protection_level = t->protection;
}

void set_held(const Measurement& m, std::uint32_t quantity, const Settings& s, Track* t, pose_wall_value* out) {
  out->reasons = m.reasons;
  out->raw = not_a_number();
  if (!t->has_value) {
    out->reasons |= POSE_WALL_R_NEVER_MEASURED;
    out->state = POSE_WALL_INVALID;
    return;
  }
  out->protection_level = t->protection + fastest(quantity, s) * t->age_s;
  t->expired = t->expired || !(out->protection_level <= alert_limit(quantity, s)) || !(t->age_s <= s.hold_max);
  if (t->expired) out->reasons |= POSE_WALL_R_HOLD_EXPIRED;
  out->state = t->expired ? POSE_WALL_INVALID : POSE_WALL_HELD;
}

pose_wall_value blank() {
  pose_wall_value v{};
  v.value = v.raw = v.sigma = v.protection_level = not_a_number();
  return v;
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
  t.still = stamp_ns == state.stamp_ns;
  t.back = stamp_ns < state.stamp_ns;
  t.leap = t.dt_s > settings.stamp_gap_max;
  if (t.still) t.reasons |= POSE_WALL_R_STAMP_STILL;
  if (t.back) t.reasons |= POSE_WALL_R_STAMP_BACK;
  if (t.leap) t.reasons |= POSE_WALL_R_STAMP_LEAP;
  return t;
}

void smooth_and_hold(const Measurements& measured, const FrameTiming& timing, std::int64_t stamp_ns,
                     const Settings& settings, TemporalState* state, pose_wall_value (*values)[POSE_WALL_QUANTITIES]) {
  state->has_stamp = true;
  state->stamp_ns = stamp_ns;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    Track& t = state->track[q];
    const Measurement& m = measured.quantity[q];
    pose_wall_value& out = (*values)[q];
    out = blank();
    if (timing.dt_s > 0.0) {
      t.age_s += timing.dt_s;
      t.trusted_age_s += timing.dt_s;
    }
    // After a jump back nobody knows how much time has passed: what is held has no bound any more.
    if (timing.back) t.expired = true;
    if (m.measured) {
      set_measured(m, q, !t.has_value || t.expired || timing.leap, settings, &t, &out);
    } else {
      set_held(m, q, settings, &t, &out);
    }
    if (t.has_value) {
      out.value = t.value;
      out.sigma = t.sigma;
      out.age_s = t.age_s;
    }
    const double alert = alert_limit(q, settings);
    out.confidence = out.state == POSE_WALL_INVALID ? 0.0 : alert / (alert + out.protection_level);
  }
}

}  // namespace pose_wall

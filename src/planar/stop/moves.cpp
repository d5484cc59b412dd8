// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/moves.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kStill = 1e-9;  // m/s and rad/s: it stands
constexpr double kGap_s = 1.0;   // beyond stale_s: what the machine did in between is not known

}  // namespace

void Moves::open(const StopSettings& settings, const Mount& mount, double radius_m, double sigmas) {
  settings_ = settings;
  forward_ = mount.forward_base;
  radius_m_ = radius_m;
  way_.open({settings.acceleration_m_s2, kSweepReach_m, radius_m, sigmas, forward_});
  now_ = last_ = Motion{};
}

void Moves::forget() {
  way_.forget();
  fast_m_s_ = slow_m_s_ = changing_s_ = 0.0;
  now_ = last_ = Motion{};
}

bool Moves::is_sound(double speed_m_s, double turn_rad_s) {
  constexpr double kMost = 1000.0;  // no machine: more is a wrong unit
  return speed_m_s >= -kMost && speed_m_s <= kMost && turn_rad_s >= -kMost && turn_rad_s <= kMost;
}

void Moves::take(const pose_wall_planar_stop_motion& m, std::int64_t stamp_ns) {
  now_ = Motion{};
  now_.speed_error_m_s = settings_.speed_error_m_s, now_.turn_error_rad_s = settings_.turn_error_rad_s;
  now_.given[kMeasured] = (m.given & POSE_WALL_PLANAR_STOP_MEASURED) != 0;
  now_.given[kCommanded] = (m.given & POSE_WALL_PLANAR_STOP_COMMANDED) != 0;
  now_.speed_m_s[kMeasured] = m.speed_m_s, now_.turn_rad_s[kMeasured] = m.turn_rad_s;
  now_.speed_m_s[kCommanded] = m.command_speed_m_s, now_.turn_rad_s[kCommanded] = m.command_turn_rad_s;
  const MeasuredMotion seen = way_.motion(stamp_ns);
  if (!now_.given[kMeasured] && seen.is_known) {
    now_.given[kMeasured] = true;
    now_.speed_m_s[kMeasured] = seen.speed_m_s, now_.turn_rad_s[kMeasured] = seen.turn_rad_s;
    now_.speed_error_m_s = seen.speed_error_m_s, now_.turn_error_rad_s = seen.turn_error_rad_s;
    now_.may_stand =
        std::fabs(seen.speed_m_s) <= seen.speed_error_m_s && std::fabs(seen.turn_rad_s) <= seen.turn_error_rad_s;
  }
  now_.is_known = now_.given[kMeasured] || now_.given[kCommanded];
  for (int kind = 0; kind < kKinds; ++kind) {
    if (!now_.given[kind]) now_.speed_m_s[kind] = now_.turn_rad_s[kind] = 0.0;
    now_.is_known = now_.is_known && is_sound(now_.speed_m_s[kind], now_.turn_rad_s[kind]);
  }
}

void Moves::tell(pose_wall_planar_stop_result* r) const {
  const bool is_told = now_.is_known && now_.given[kMeasured];
  const double speed_m_s = now_.speed_m_s[kMeasured], turn_rad_s = now_.turn_rad_s[kMeasured];
  r->speed_m_s = is_told ? speed_m_s : not_a_number();
  r->speed_error_m_s =
      is_told ? settings_.speed_error_ratio * std::fabs(speed_m_s) + now_.speed_error_m_s : not_a_number();
  r->turn_rad_s = is_told ? turn_rad_s : not_a_number();
  r->turn_error_rad_s =
      is_told ? settings_.speed_error_ratio * std::fabs(turn_rad_s) + now_.turn_error_rad_s : not_a_number();
}

bool Moves::moves(const Motion& motion, int kind) {
  return motion.given[kind] && std::fabs(motion.speed_m_s[kind]) + std::fabs(motion.turn_rad_s[kind]) > kStill;
}

double Moves::rim_of(double speed_m_s, double turn_rad_s) const {
  const Eigen::Vector2d v = speed_m_s * forward_;
  double most = 0.0;
  for (std::uint32_t k = 0; k < settings_.corners; ++k) {
    const double* c = settings_.corner_m[k];
    const double x = v.x() - turn_rad_s * c[1], y = v.y() + turn_rad_s * c[0];
    most = larger(most, std::sqrt(x * x + y * y));
  }
  return most;
}

double Moves::rim_m_s() const {
  if (!now_.is_known) return settings_.speed_max_m_s;
  double rim_m_s = 0.0;
  for (int kind = 0; kind < kKinds; ++kind) {
    if (!moves(now_, kind)) continue;
    rim_m_s = larger(rim_m_s, rim_of(std::fabs(now_.speed_m_s[kind]), std::fabs(now_.turn_rad_s[kind])));
  }
  return rim_m_s;
}

double Moves::rim_error_m_s(double rim_m_s) const {
  return settings_.speed_error_ratio * rim_m_s + settings_.speed_error_m_s;
}

// The direction is the command's, or the measured one where nothing is commanded. What may stand sets off ahead: its
// noise is no direction. What the measured motion has beside the direction is a deviation, and so is the part of its
// error that goes the other way.
SweepMotion Moves::sweep() const {
  SweepMotion sweep;
  sweep.any = !now_.is_known;
  sweep.velocity = forward_;
  if (sweep.any) return sweep;
  double v = 0.0, w = 0.0;
  for (int kind = 0; kind < kKinds; ++kind) {
    if (moves(now_, kind) && !(kind == kMeasured && now_.may_stand)) {
      v = now_.speed_m_s[kind], w = now_.turn_rad_s[kind];
    }
  }
  if (const double rim = rim_of(v, w); rim > kStill) {
    sweep.velocity = v / rim * forward_;
    sweep.turn_rad_m = w / rim;
  }
  sweep.speed_error_ratio = settings_.speed_error_ratio;
  sweep.speed_error_m_s = now_.speed_error_m_s;
  sweep.turn_error_rad_s = now_.turn_error_rad_s;
  if (!now_.given[kMeasured]) {
    sweep.aside_m_s = fast_m_s_ - slow_m_s_;
    sweep.may_go_on = sweep.aside_m_s > kStill;
    return sweep;
  }
  if (!now_.may_stand) {
    sweep.measured_m_s = now_.speed_m_s[kMeasured] * forward_;
    sweep.measured_turn_rad_s = now_.turn_rad_s[kMeasured];
  }
  // In the plane of speed and turn by the lever: the part of the measured motion that the direction leaves.
  const double a = sweep.velocity.dot(forward_), b = sweep.turn_rad_m * radius_m_, ab = a * a + b * b;
  const double m = now_.speed_m_s[kMeasured], n = now_.turn_rad_s[kMeasured] * radius_m_;
  const double share = ab > 0.0 ? larger((m * a + n * b) / ab, 0.0) : 0.0;
  sweep.aside_m_s = larger(std::fabs(m - share * a), now_.speed_error_m_s - share * std::fabs(a));
  sweep.turn_error_rad_s += std::fabs(n - share * b) / radius_m_;
  // Along the arc a faster machine would turn faster, too. An error of the speed alone leaves the arc.
  if (ab > 0.0) {
    sweep.aside_m_s += now_.speed_error_m_s * b * b / ab;
    sweep.turn_error_rad_s += now_.speed_error_m_s * std::fabs(a * b) / (ab * radius_m_);
  }
  return sweep;
}

// A machine obeys after latency_s, brakes at least with deceleration_m_s2 and speeds up at most with acceleration_m_s2.
void Moves::lag_behind(double seconds) {
  const double told_m_s = now_.given[kCommanded] && now_.is_known
                              ? rim_of(std::fabs(now_.speed_m_s[kCommanded]), std::fabs(now_.turn_rad_s[kCommanded]))
                              : 0.0;
  const bool changes = !(fast_m_s_ == told_m_s && slow_m_s_ == told_m_s);
  changing_s_ = changes ? changing_s_ + seconds : 0.0;
  const double obeyed_s = changing_s_ > settings_.latency_s ? seconds : 0.0;
  fast_m_s_ = larger(told_m_s, fast_m_s_ - settings_.deceleration_m_s2 * obeyed_s);
  const double may_be_m_s = slow_m_s_ + settings_.acceleration_m_s2 * obeyed_s;
  slow_m_s_ = may_be_m_s < told_m_s ? may_be_m_s : told_m_s;
}

// By the mean of the motions at both ends.
void Moves::go(std::int64_t stamp_ns, std::uint32_t now_ms, double seconds) {
  double v = 0.0, w = 0.0, rim = 0.0, error_m_s = 0.0, error_rad_s = 0.0;
  const bool is_known = now_.is_known && last_.is_known && seconds <= settings_.stale_s + kGap_s;
  bool is_still = is_known;
  const Motion* const ends[] = {&last_, &now_};
  for (const Motion* m : ends) {
    const int kind = m->given[kMeasured] ? kMeasured : kCommanded;
    v += 0.5 * m->speed_m_s[kind], w += 0.5 * m->turn_rad_s[kind];
    rim = larger(rim, rim_of(m->speed_m_s[kind], m->turn_rad_s[kind]));
    error_m_s = larger(error_m_s, m->speed_error_m_s), error_rad_s = larger(error_rad_s, m->turn_error_rad_s);
    is_still = is_still && !moves(*m, kind);
  }
  lag_behind(seconds);
  if (!last_.given[kMeasured] || !now_.given[kMeasured]) {
    error_m_s += fast_m_s_ - slow_m_s_;
    is_still = is_still && !(fast_m_s_ - slow_m_s_ > kStill);
  }
  last_ = now_;
  if (!is_known) {
    way_.go(stamp_ns, now_ms, Pose2(), 2.0 * settings_.drift_max_m);  // nothing is remembered
    return;
  }
  const Eigen::Vector2d step = Turn2(0.5 * w * seconds) * (v * seconds * forward_);
  const double error_m =
      is_still ? 0.0 : seconds * (settings_.speed_error_ratio * rim + error_m_s + error_rad_s * radius_m_);
  way_.go(stamp_ns, now_ms, {step.x(), step.y(), wrapped(w * seconds)}, error_m);
}

}  // namespace pose_wall::planar

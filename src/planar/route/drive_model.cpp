// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/drive_model.hpp"

#include <cmath>

#include "base/math/finite.hpp"
#include "planar/route/footprint.hpp"

namespace pose_wall::planar::route {
namespace {

constexpr double kLearnEach_m = 0.4;  // way between two lessons: noise of poses counts less over a longer one
constexpr double kLearn = 0.3;        // share of a lesson
// What is learned stays within: a machine that keeps half of a command, or a fifth more, has another fault.
constexpr double kKeptLeast = 0.5, kKeptMost = 1.2, kDriftMost_1_m = 0.5;

}  // namespace

void DriveModel::open(double delay_s, double lag_s, double oldest_s) {
  *this = DriveModel();
  delay_s_ = delay_s;
  lag_s_ = lag_s;
  horizon_s_ = delay_s + oldest_s;
}

void DriveModel::forget_commands() {
  first_ = count_ = 0;
  kept_s_ = 0.0;
  last_ = Rates();
  before_ = Drive();
  has_mark_ = false;
}

// First order: exact for a command that lasts.
void DriveModel::follow(Drive* drive, const Rates& command, double step_s) const {
  const double share = lag_s_ > 1e-6 ? 1.0 - exponential(-clamped(step_s / lag_s_, 0.0, 50.0)) : 1.0;
  const Rates before = drive->rates;
  drive->rates.speed_m_s += share * (command.speed_m_s - before.speed_m_s);
  drive->rates.turn_rad_s += share * (command.turn_rad_s - before.turn_rad_s);
  drive->way_m += 0.5 * (before.speed_m_s + drive->rates.speed_m_s) * step_s;
  drive->turn_rad += 0.5 * (before.turn_rad_s + drive->rates.turn_rad_s) * step_s;
}

Rates DriveModel::real(const Rates& rates) const {
  const double speed_m_s = kept_ * rates.speed_m_s;
  return {speed_m_s, kept_ * rates.turn_rad_s + drift_1_m_ * std::abs(speed_m_s)};
}

void DriveModel::advance(double step_s) {
  const auto drop = [&] {
    follow(&before_, given(0).rates, given(0).duration_s);
    kept_s_ -= given(0).duration_s;
    first_ = (first_ + 1) % kCommandsMost;
    --count_;
  };
  if (count_ == kCommandsMost) drop();  // steps shorter than agreed
  given_[(first_ + count_) % kCommandsMost] = {step_s, last_};
  ++count_;
  kept_s_ += step_s;
  for (std::uint32_t k = 0; k < kCommandsMost && count_ > 0; ++k) {
    if (!(kept_s_ - given(0).duration_s > horizon_s_)) break;
    drop();
  }
}

template <typename Visit>
DriveModel::Drive DriveModel::replay(double seconds_s, const Visit& visit) const {
  Drive drive = before_, then = before_;
  double begun_s = 0.0;
  for (std::uint32_t k = 0; k < count_; ++k) {
    const double duration_s = given(k).duration_s, first_s = clamped(seconds_s - begun_s, 0.0, duration_s);
    if (first_s > 0.0) follow(&drive, given(k).rates, first_s);
    if (first_s > 0.0) then = drive;
    if (duration_s > first_s) {
      const Rates before = drive.rates;
      follow(&drive, given(k).rates, duration_s - first_s);
      visit(Rates{0.5 * (before.speed_m_s + drive.rates.speed_m_s), 0.5 * (before.turn_rad_s + drive.rates.turn_rad_s)},
            duration_s - first_s);
    }
    begun_s += duration_s;
  }
  return then;
}

Pose2 DriveModel::predicted(const Pose2& then, double age_s) const {
  Pose2 at = then;
  replay(seconds_to(age_s), [&](const Rates& rates, double seconds) {
    const Rates moved = real(rates);
    at = along_arc(at, moved.speed_m_s * seconds, moved.turn_rad_s * seconds);
  });
  return at;
}

bool DriveModel::stands() const {
  // Below these rates it moves by less than a millimetre, and 0.06 degrees, in a quarter of a second.
  constexpr double kStill_m_s = 0.004, kStill_rad_s = 0.004;
  const Drive now = replay(kept_s_ - delay_s_, [](const Rates&, double) {});
  if (!(std::abs(now.rates.speed_m_s) < kStill_m_s && std::abs(now.rates.turn_rad_s) < kStill_rad_s)) return false;
  double ago_s = kept_s_;
  for (std::uint32_t k = 0; k < count_; ++k) {
    const Rates& rates = given(k).rates;
    ago_s -= given(k).duration_s;
    if (ago_s < delay_s_ && (rates.speed_m_s != 0.0 || rates.turn_rad_s != 0.0)) return false;
  }
  return last_.speed_m_s == 0.0 && last_.turn_rad_s == 0.0;
}

// A lesson begins with a mark and ends with the next one. A stop, or a turn on the spot, breaks it off.
void DriveModel::learn(const Pose2& pose, double age_s) {
  const Drive now = replay(seconds_to(age_s), [](const Rates&, double) {});
  const double way_m = std::abs(now.way_m - drive_at_mark_.way_m);
  if (has_mark_ && !(way_m >= kLearnEach_m)) return;
  if (has_mark_) {
    const double chord_m = (pose.place() - mark_.place()).norm();
    const double turned_rad = wrapped(pose.yaw_rad - mark_.yaw_rad), half_rad = 0.5 * std::abs(turned_rad);
    const double came_m = half_rad > 1e-3 && half_rad < 1.5 ? chord_m * half_rad / sine(half_rad) : chord_m;
    kept_ = clamped(kept_ + kLearn * (came_m / way_m - kept_), kKeptLeast, kKeptMost);
    const double meant_rad = kept_ * (now.turn_rad - drive_at_mark_.turn_rad);
    const double drift_1_m = wrapped(turned_rad - meant_rad) / (came_m > 0.1 ? came_m : 0.1);
    drift_1_m_ = clamped(drift_1_m_ + kLearn * (drift_1_m - drift_1_m_), -kDriftMost_1_m, kDriftMost_1_m);
  }
  mark_ = pose;
  drive_at_mark_ = now;
  has_mark_ = true;
}

}  // namespace pose_wall::planar::route

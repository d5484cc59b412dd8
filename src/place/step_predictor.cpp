// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/step_predictor.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::planar {
namespace {

// Half of the 0.6 m and 0.6 rad that a machine may move from scan to scan: so wide is a step of which nothing is known,
// and a share of a long one at most. Odometry that leaps would explain any place otherwise.
constexpr double kAnyStep_m = 0.3, kAnyStep_rad = 0.3;

}  // namespace

void StepPredictor::open(double share_m, double share_rad) {
  share_m_ = share_m;
  share_rad_ = share_rad;
  begin();
}

void StepPredictor::begin() {
  odometry_ = last_step_ = since_agreed_ = agreed_odometry_ = Pose2();
  knows_step_ = has_odometry_ = has_agreed_ = is_astray_ = false;
}

void StepPredictor::start(const Pose2* odometry) {
  begin();
  has_odometry_ = has_agreed_ = odometry != nullptr;
  if (has_odometry_) odometry_ = agreed_odometry_ = *odometry;
}

StepPredictor::Prediction StepPredictor::by(const Pose2& from, const Pose2& step, double sigma_m,
                                            double sigma_rad) const {
  const double length_m = std::sqrt(step.x_m * step.x_m + step.y_m * step.y_m);
  Prediction out;
  out.pose = compose(from, step);
  out.sigma_m = sigma_m + std::min(kAnyStep_m, share_m_ * length_m);
  out.sigma_rad = sigma_rad + share_rad_ * std::abs(step.yaw_rad);
  return out;
}

std::uint32_t StepPredictor::predict(const Pose2& from, const Pose2* odometry, Prediction* out) const {
  // Of a counter that stands, and of a machine that goes on for the time of a scan: on recorded logs.
  constexpr double kStep_m = 0.01, kStep_rad = 0.01, kInertia_m = 0.1, kInertia_rad = 0.1;
  // Twice the logarithm of how often: odometry that stalled makes up for it in one scan of 20, and lies in one of 400.
  constexpr double kStalled = 6.0, kWrong = 12.0;
  std::uint32_t count = 0;
  if (odometry != nullptr && has_odometry_) {
    out[count] = by(from, between(odometry_, *odometry), kStep_m, kStep_rad);
    out[count++].is_odometry = true;
    if (is_astray_) {
      out[count] = by(compose(from, inverse(since_agreed_)), between(agreed_odometry_, *odometry), kStep_m, kStep_rad);
      out[count].is_odometry = true;
      out[count++].unlikely = kStalled;
    }
  }
  out[count] = by(from, last_step_, knows_step_ ? kInertia_m : kAnyStep_m, knows_step_ ? kInertia_rad : kAnyStep_rad);
  out[count].unlikely = count > 0 ? kWrong : 0.0;
  return count + 1;
}

void StepPredictor::follow(const Pose2& from, const Pose2& to, const Pose2* odometry, bool agrees) {
  // Odometry that stalled for good agrees with a machine that stands, and would never make up for what it missed.
  const bool stood_still =
      odometry != nullptr && has_odometry_ &&
      between(odometry_, *odometry).place().squaredNorm() + std::abs(wrapped(odometry->yaw_rad - odometry_.yaw_rad)) ==
          0.0;
  last_step_ = between(from, to);
  knows_step_ = true;
  since_agreed_ = compose(since_agreed_, last_step_);
  is_astray_ = odometry == nullptr || (is_astray_ ? !agrees || stood_still : !agrees);
  has_odometry_ = odometry != nullptr;
  if (odometry == nullptr) return;
  odometry_ = *odometry;
  if (is_astray_ && has_agreed_) return;
  since_agreed_ = Pose2();
  agreed_odometry_ = *odometry;
  has_agreed_ = true;
}

}  // namespace pose_wall::planar

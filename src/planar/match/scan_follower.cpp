// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/match/scan_follower.hpp"

#include <algorithm>

namespace pose_wall::planar {

void ScanFollower::open(double odometry_m, double odometry_rad) {
  predictor_.open(odometry_m, odometry_rad);
}

void ScanFollower::begin() {
  predictor_.begin();
}

void ScanFollower::see_first(const Pose2* odometry) {
  predictor_.follow(Pose2(), Pose2(), odometry, true);
}

// Half of the squared distance.
double ScanFollower::Belief::cost(const Pose2& pose) const {
  const Eigen::Vector3d off(pose.x_m - prior.pose.x_m, pose.y_m - prior.pose.y_m,
                            wrapped(pose.yaw_rad - prior.pose.yaw_rad));
  return unlikely + 0.5 * off.dot(prior.information * off);
}

std::uint32_t ScanFollower::predict(const Pose2& from, const Pose2* odometry, Belief* beliefs) const {
  StepPredictor::Prediction predictions[StepPredictor::kMost];
  const std::uint32_t count = predictor_.predict(from, odometry, predictions);
  for (std::uint32_t k = 0; k < count; ++k) {
    const StepPredictor::Prediction& one = predictions[k];
    const double place = 1.0 / (one.sigma_m * one.sigma_m);
    beliefs[k] = {{one.pose, Eigen::Matrix3d::Zero()}, one.unlikely};
    beliefs[k].prior.information.diagonal() << place, place, 1.0 / (one.sigma_rad * one.sigma_rad);
  }
  return count;
}

// Where no prediction explains the scan, the best place that the machine can have reached joins in.
ScanFollower::Followed ScanFollower::follow(const Pose2& from, Span<const ScanPoint> points, const SurfaceMap& near,
                                            double noise_m, const Pose2* odometry, const Matcher& matcher) {
  constexpr double kGood = 0.9;  // share of explained points
  constexpr double kFar_m = 0.6, kFar_rad = 0.6, kAnywhere = 12.0;
  constexpr std::uint32_t kNodes = 128;
  Belief beliefs[StepPredictor::kMost];
  const std::uint32_t count = predict(from, odometry, beliefs);
  Refined best;
  double least = 0.0;
  const auto offer = [&](const Pose2& start, const Prior& prior) {
    const Refined match = matcher.refine(points, near, start, prior, noise_m);
    double unlikely = kAnywhere;
    for (std::uint32_t k = 0; k < count; ++k) unlikely = std::min(unlikely, beliefs[k].cost(match.pose));
    const double cost = 0.5 * match.misfit / kAlike + unlikely;
    if (!match.is_valid || (best.is_valid && cost >= least)) return;
    best = match;
    least = cost;
  };
  const auto is_good = [&] { return best.is_valid && best.explained > kGood; };
  for (std::uint32_t k = 0; k < count && !is_good(); ++k) offer(beliefs[k].prior.pose, beliefs[k].prior);
  if (!is_good()) {
    const Prior around = best.is_valid ? Prior{best.pose, Eigen::Matrix3d::Zero()} : beliefs[0].prior;
    const Found found = matcher.search(points, near, {around.pose, kFar_m, kFar_rad, kNodes});
    Prior loose{around.pose, Eigen::Matrix3d::Zero()};
    loose.information.diagonal() << 1.0 / (kFar_m * kFar_m), 1.0 / (kFar_m * kFar_m), 1.0 / (kFar_rad * kFar_rad);
    offer(found.pose, loose);
  }
  if (!best.is_valid) best.pose = beliefs[0].prior.pose;
  predictor_.follow(from, best.pose, odometry, 2.0 * beliefs[0].cost(best.pose) < StepPredictor::kAgrees);
  return {best, beliefs[0].prior};
}

}  // namespace pose_wall::planar

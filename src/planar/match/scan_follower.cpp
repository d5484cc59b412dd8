// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/match/scan_follower.hpp"

#include <algorithm>

#include "planar/gates.hpp"

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

std::uint32_t ScanFollower::predict(const Pose2& from, const Pose2* odometry, Predicted* out) const {
  StepPredictor::Prediction predictions[StepPredictor::kMost];
  const std::uint32_t count = predictor_.predict(from, odometry, predictions);
  for (std::uint32_t k = 0; k < count; ++k) {
    const StepPredictor::Prediction& one = predictions[k];
    const double place = 1.0 / (one.sigma_m * one.sigma_m);
    out[k] = {{one.pose, Eigen::Matrix3d::Zero()}, one.unlikely};
    out[k].prior.information.diagonal() << place, place, 1.0 / (one.sigma_rad * one.sigma_rad);
  }
  return count;
}

// Where no prediction explains the scan, the best place that the machine can have reached joins in.
ScanFollower::Followed ScanFollower::follow(const Pose2& from, Span<const ScanPoint> points, const SurfaceMap& near,
                                            double noise_m, const Pose2* odometry, Matcher& matcher) {
  // What a machine may move from scan to scan; what it costs to believe such a place without a prediction: more than
  // that odometry lies.
  constexpr double kFar_m = 0.6, kFar_rad = 0.6, kAnywhere = 24.0;
  constexpr std::uint32_t kNodes = 128;  // of the search, which is in the call's time
  Predicted predicted[StepPredictor::kMost];
  const std::uint32_t count = predict(from, odometry, predicted);
  const PatchedPoints& view = matcher.sort(points, noise_m);
  Fit best;
  double least = 0.0;
  const auto offer = [&](const Pose2& start, const Prior& prior) {
    const Fit match = fit_pose(near, points, start, {noise_m, prior});
    PatchCosts costs;
    double unlikely = kAnywhere;
    for (std::uint32_t k = 0; k < count; ++k) {
      unlikely = std::min(unlikely, predicted[k].unlikely + predicted[k].prior.squared_distance(match.pose));
    }
    const double cost = judge_patches(near, view, match.pose, &costs).cost + unlikely;
    if (!match.is_valid || (best.is_valid && cost >= least)) return;
    best = match;
    least = cost;
  };
  const auto is_good = [&] { return best.is_valid && passes<gate::SCAN_EXPLAINED>(best.explained); };
  for (std::uint32_t k = 0; k < count && !is_good(); ++k) offer(predicted[k].prior.pose, predicted[k].prior);
  if (!is_good()) {
    const Prior around = best.is_valid ? Prior{best.pose, Eigen::Matrix3d::Zero()} : predicted[0].prior;
    const Found found = matcher.search(points, near, {around.pose, kFar_m, kFar_rad, kNodes});
    Prior loose{around.pose, Eigen::Matrix3d::Zero()};
    loose.information.diagonal() << 1.0 / (kFar_m * kFar_m), 1.0 / (kFar_m * kFar_m), 1.0 / (kFar_rad * kFar_rad);
    offer(found.pose, loose);
  }
  if (!best.is_valid) best.pose = predicted[0].prior.pose;
  predictor_.follow(from, best.pose, odometry, passes<gate::AGREES>(predicted[0].prior.squared_distance(best.pose)));
  return {best, predicted[0].prior};
}

}  // namespace pose_wall::planar

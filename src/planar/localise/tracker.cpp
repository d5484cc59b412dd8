// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "planar/match/matcher.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kFits = 0.75, kContradicts = 0.5;  // share of the seen patches
constexpr std::uint32_t kPatchesLeast = 8;
constexpr double kReach_m = 0.25;
constexpr double kSlid_m = 0.4;

}  // namespace

void Tracker::open(const TrackRule& rule) {
  rule_ = rule;
  begin(Pose2(), 1.0, 1.0);
}

void Tracker::begin(const Pose2& pose, double sigma_m, double sigma_rad) {
  pose_ = pose;
  last_step_ = odometry_ = Pose2();
  covariance_.setZero();
  covariance_.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  fit_ = Fit();
  verdict_ = PatchVerdict();
  slide_m_ = doubtful_m_ = 0.0;
  contradicted_ = 0;
  has_odometry_ = false;
}

// Where base stands by odometry, or by its last step once more; the covariance grows.
Pose2 Tracker::predict(const Pose2* odometry) {
  constexpr double kStep_m = 0.01, kStep_rad = 0.01, kInertia_m = 0.1, kInertia_rad = 0.1;
  const bool knows = odometry != nullptr && has_odometry_;
  const Pose2 step = knows ? between(odometry_, *odometry) : last_step_;
  const double sigma_m = knows ? kStep_m + rule_.odometry_m * step.place().norm() : kInertia_m;
  const double sigma_rad = knows ? kStep_rad + rule_.odometry_rad * std::abs(step.yaw_rad) : kInertia_rad;
  const Pose2 predicted = compose(pose_, step);
  const Eigen::Vector2d moved = predicted.place() - pose_.place();
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J(0, 2) = -moved.y();
  J(1, 2) = moved.x();
  covariance_ = (J * covariance_ * J.transpose()).eval();
  covariance_.diagonal() += Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad);
  has_odometry_ = odometry != nullptr;
  if (odometry != nullptr) odometry_ = *odometry;
  return predicted;
}

// The fit about the prediction. Where the scan is not explained there, wider residuals find what is near.
void Tracker::place(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room) {
  const Eigen::Matrix3d weight = covariance_.inverse();
  const auto offer = [&](const Pose2& start, bool is_first) {
    FitRule rule{look.sigma_m, kReach_m, 1, 8, predicted};
    rule.weight = weight;
    const Fit fit = fit_pose(map, look, start, rule);
    const PatchVerdict verdict = judge_patches(map, look, fit.pose, &room[0]);
    if (!is_first && verdict.cost >= verdict_.cost) return;
    fit_ = fit;
    verdict_ = verdict;
  };
  offer(predicted, true);
  if (verdict_.fits >= kFits) return;
  constexpr double kWide_m = 0.2;
  for (const double turn_rad : {0.0, 0.1, -0.1}) {
    Pose2 start = predicted;
    start.yaw_rad = wrapped(start.yaw_rad + turn_rad);
    FitRule rule{kWide_m, PlaceMap::kReach_m, 4, 6, predicted};
    rule.weight = weight;
    offer(fit_pose(map, look, start, rule).pose, false);
  }
}

// What the fit tells joins what was known. Along a wall that holds nothing, the prediction stays.
void Tracker::update(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room) {
  const Slid slid = slide_of(map, look, fit_, room);
  slide_m_ = slid.reach_m;
  Eigen::Matrix3d told = fit_.information / kAlike;
  if (slid.reach_m >= kSlid_m) {
    const Eigen::Vector3d d(slid.direction.x(), slid.direction.y(), 0.0);
    const Eigen::Vector3d held = told * d;
    const double along = d.dot(held);
    if (along > 0.0) told -= held * held.transpose() / along;
    const double off_m = slid.direction.dot(fit_.pose.place() - predicted.place());
    fit_.pose.x_m -= off_m * slid.direction.x();
    fit_.pose.y_m -= off_m * slid.direction.y();
  }
  covariance_ = (told + covariance_.inverse()).inverse().eval();
  // The map itself is no better than this.
  constexpr double kMap_m = 0.01, kMap_rad = 0.001;
  covariance_.diagonal() += Eigen::Vector3d(kMap_m * kMap_m, kMap_m * kMap_m, kMap_rad * kMap_rad);
}

Track Tracker::judge(double step_m) {
  constexpr std::uint32_t kContradictions = 3;
  constexpr double kPatience_m = 8.0, kLost_m = 1.5;
  const bool sees = verdict_.seen >= kPatchesLeast && 2 * verdict_.seen >= verdict_.judged;
  Track track = Track::tracked;
  if (!sees) {
    track = Track::blind;
  } else if (!(verdict_.fits >= kContradicts)) {
    track = Track::contradicted;
  } else if (!(verdict_.fits >= kFits)) {
    track = Track::doubtful;
  }
  contradicted_ = track == Track::contradicted ? contradicted_ + 1 : track == Track::blind ? contradicted_ : 0;
  doubtful_m_ = track == Track::tracked ? 0.0 : doubtful_m_ + step_m;
  const double place_m2 = covariance_(0, 0) + covariance_(1, 1);
  const bool is_lost = contradicted_ >= kContradictions || !(doubtful_m_ < kPatience_m) || !(place_m2 < kLost_m * kLost_m);
  return is_lost ? Track::lost : track;
}

Track Tracker::follow(const PlaceMap& map, const Look& look, const Pose2* odometry, PatchCosts* room) {
  const Pose2 before = pose_;
  const Pose2 predicted = predict(odometry);
  place(map, look, predicted, room);
  const Track track = judge(between(before, predicted).place().norm());
  if (track == Track::tracked || track == Track::doubtful) {
    update(map, look, predicted, room);
    pose_ = fit_.pose;
  } else {
    pose_ = predicted;
  }
  last_step_ = between(before, pose_);
  return track;
}

}  // namespace pose_wall::planar

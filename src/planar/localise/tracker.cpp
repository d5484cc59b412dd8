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
  has_odometry_ = has_step_ = false;
}

// Where base stands by odometry, or by its last step once more; the covariance grows.
Pose2 Tracker::predict(const Pose2* odometry) {
  constexpr double kStep_m = 0.01, kStep_rad = 0.01, kInertia_m = 0.3, kInertia_rad = 0.15;
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
  has_step_ = knows;
  has_odometry_ = odometry != nullptr;
  if (odometry != nullptr) odometry_ = *odometry;
  return predicted;
}

// The fit that scan and prediction together like best. Where the scan is not explained, wider residuals find what is
// near. Where the place is uncertain along the road, other starts along it join in.
void Tracker::place(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room) {
  const Eigen::Matrix3d weight = covariance_.inverse();
  double least = 0.0;
  const auto offer = [&](const Pose2& start, bool is_first) {
    FitRule rule{look.sigma_m, kReach_m, 1, 8, predicted};
    rule.weight = weight;
    const Fit fit = fit_pose(map, look, start, rule);
    const PatchVerdict verdict = judge_patches(map, look, fit.pose, &room[0]);
    const Eigen::Vector3d off(fit.pose.x_m - predicted.x_m, fit.pose.y_m - predicted.y_m,
                              wrapped(fit.pose.yaw_rad - predicted.yaw_rad));
    const double cost = verdict.cost + off.dot(weight * off);
    if (!is_first && !(cost < least)) return;
    fit_ = fit;
    verdict_ = verdict;
    least = cost;
  };
  offer(predicted, true);
  const Along along = uncertain_along();
  constexpr double kCertain_m = 0.12, kStep_m = 0.25;
  constexpr int kStepsMost = 6;
  for (int k = 1; k <= kStepsMost && along.sigma_m > kCertain_m && (k - 1) * kStep_m < 2.0 * along.sigma_m; ++k) {
    for (const double sign : {1.0, -1.0}) {
      Pose2 start = predicted;
      start.x_m += sign * k * kStep_m * along.direction.x();
      start.y_m += sign * k * kStep_m * along.direction.y();
      offer(start, false);
    }
  }
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

// The place's direction of most variance.
Tracker::Along Tracker::uncertain_along() const {
  const double xx = covariance_(0, 0), yy = covariance_(1, 1), xy = covariance_(0, 1);
  const double half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy);
  const double angle_rad = root > 0.0 ? 0.5 * arc_tangent2(xy, half) : 0.0;
  return {{cosine(angle_rad), sine(angle_rad)}, std::sqrt(0.5 * (xx + yy) + root)};
}

// What the fit tells joins what was known. Along a road that holds little, odometry is better than the fit; without it
// the fit's place stays, as uncertain as it may slide: scans of the same walls err alike, and do not add up.
void Tracker::update(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room) {
  constexpr double kExcluded = 2.5;  // standard errors: less than after a restart, for the place is known about
  const Slid slid = slide_of(map, look, fit_, kExcluded, room);
  slide_m_ = slid.reach_m;
  Eigen::Matrix3d told = fit_.information / kAlike;
  const bool slides = slid.reach_m >= kSlid_m;
  const Eigen::Vector3d d(slid.direction.x(), slid.direction.y(), 0.0);
  const double known_m2 = d.dot(covariance_ * d);
  if (slides) {
    const Eigen::Vector3d held = told * d;
    const double along = d.dot(held);
    if (along > 0.0) told -= held * held.transpose() / along;
    if (known_m2 < slid.reach_m * slid.reach_m && has_step_) {
      const double off_m = slid.direction.dot(fit_.pose.place() - predicted.place());
      fit_.pose.x_m -= off_m * slid.direction.x();
      fit_.pose.y_m -= off_m * slid.direction.y();
    }
  }
  covariance_ = (told + covariance_.inverse()).inverse().eval();
  const double left_m2 = d.dot(covariance_ * d), most_m2 = slid.reach_m * slid.reach_m;
  if (slides && left_m2 > most_m2) {
    // As if one look of this precision had told it, however many there were.
    const double told_along = 1.0 / most_m2 - 1.0 / left_m2;
    covariance_ = (covariance_.inverse() + told_along * d * d.transpose()).inverse().eval();
  }
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
  const bool is_lost =
      contradicted_ >= kContradictions || !(doubtful_m_ < kPatience_m) || !(place_m2 < kLost_m * kLost_m);
  return is_lost ? Track::lost : track;
}

Track Tracker::confirm(const PlaceMap& map, const Look& look, const Pose2* odometry, PatchCosts* room) {
  has_odometry_ = odometry != nullptr;
  if (odometry != nullptr) odometry_ = *odometry;
  return follow_to(map, look, pose_, room);
}

Track Tracker::follow(const PlaceMap& map, const Look& look, const Pose2* odometry, PatchCosts* room) {
  return follow_to(map, look, predict(odometry), room);
}

Track Tracker::follow_to(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room) {
  const Pose2 before = pose_;
  place(map, look, predicted, room);
  const Track track = judge(between(before, predicted).place().norm());
  if (track == Track::tracked || track == Track::doubtful) {
    update(map, look, predicted, room);
    pose_ = fit_.pose;
  } else {
    pose_ = predicted;
  }
  last_step_ = between(before, pose_);
  constexpr double kPlaced_m = 0.2;  // a place that is less certain is not one place
  return track == Track::tracked && !(uncertain_along().sigma_m < kPlaced_m) ? Track::loose : track;
}

}  // namespace pose_wall::planar

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

Eigen::Vector3d Tracker::Belief::off(const Pose2& to) const {
  return {to.x_m - pose.x_m, to.y_m - pose.y_m, wrapped(to.yaw_rad - pose.yaw_rad)};
}

double Tracker::Belief::squared_distance(const Pose2& to) const {
  return off(to).dot(information * off(to));
}

void Tracker::open(double odometry_m, double odometry_rad) {
  predictor_.open(odometry_m, odometry_rad);
  begin(Pose2(), 1.0, 1.0);
}

void Tracker::begin(const Pose2& pose, double sigma_m, double sigma_rad) {
  predictor_.begin();
  has_followed_ = false;
  pose_ = pose;
  covariance_.setZero();
  covariance_.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  fit_ = Fit();
  verdict_ = PatchVerdict();
  slide_m_ = doubtful_m_ = 0.0;
  contradicted_ = 0;
}

// Where base may stand, each with the covariance that has grown by the step.
Tracker::Beliefs Tracker::predict(const Pose2* odometry) const {
  StepPredictor::Prediction predictions[StepPredictor::kMost];
  Beliefs beliefs;
  beliefs.count = predictor_.predict(pose_, odometry, predictions);
  for (std::uint32_t k = 0; k < beliefs.count; ++k) {
    const StepPredictor::Prediction& step = predictions[k];
    const double step_m2 = step.sigma_m * step.sigma_m, step_rad2 = step.sigma_rad * step.sigma_rad;
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    J(0, 2) = pose_.y_m - step.pose.y_m;
    J(1, 2) = step.pose.x_m - pose_.x_m;
    Belief& belief = beliefs.all[k];
    belief.pose = step.pose;
    belief.covariance = J * covariance_ * J.transpose();
    belief.covariance.diagonal() += Eigen::Vector3d(step_m2, step_m2, step_rad2);
    belief.information = belief.covariance.inverse();
    belief.unlikely = step.unlikely;
    belief.is_odometry = step.is_odometry;
  }
  return beliefs;
}

const Tracker::Belief& Tracker::Beliefs::likeliest(const Pose2& at, double* unlikely) const {
  const Belief* best = nullptr;
  for (const Belief& one : *this) {
    const double here = one.unlikely + one.squared_distance(at);
    if (best != nullptr && !(here < *unlikely)) continue;
    best = &one;
    *unlikely = here;
  }
  return *best;
}

Tracker::Placed Tracker::fit_from(const PlaceMap& map, const Look& look, const Pose2& start, const Belief& belief,
                                  const Beliefs& beliefs, PatchCosts* room) {
  FitRule rule{look.sigma_m, kReach_m, 1, 8, belief.pose};
  rule.weight = belief.information;
  Placed out;
  out.fit = fit_pose(map, look, start, rule);
  out.verdict = judge_patches(map, look, out.fit.pose, &room[0]);
  double unlikely = 0.0;
  out.belief = &beliefs.likeliest(out.fit.pose, &unlikely);
  out.cost = out.verdict.cost + unlikely;
  return out;
}

// The fit that the scan and one of the beliefs together like best. Beliefs that the first one's fit contradicts are
// tried, too. Where the place is uncertain along the road, other starts along it join in, and where the scan is not
// explained, wider residuals, which find what is near.
Tracker::Placed Tracker::place(const PlaceMap& map, const Look& look, const Beliefs& beliefs, PatchCosts* room) const {
  Placed best = fit_from(map, look, beliefs.first().pose, beliefs.first(), beliefs, room);
  const auto offer = [&](const Pose2& start, const Belief& belief) {
    const Placed one = fit_from(map, look, start, belief, beliefs, room);
    if (one.cost < best.cost) best = one;
  };
  const Along along = uncertain_along(beliefs.first().covariance);
  constexpr double kCertain_m = 0.12, kStep_m = 0.25;
  constexpr int kStepsMost = 6;
  for (int k = 1; k <= kStepsMost && along.sigma_m > kCertain_m && (k - 1) * kStep_m < 2.0 * along.sigma_m; ++k) {
    for (const double sign : {1.0, -1.0}) {
      Pose2 start = beliefs.first().pose;
      start.x_m += sign * k * kStep_m * along.direction.x();
      start.y_m += sign * k * kStep_m * along.direction.y();
      offer(start, beliefs.first());
    }
  }
  for (const Belief& one : beliefs) {
    if (&one != &beliefs.first() && !one.agrees(best.fit.pose)) offer(one.pose, one);
  }
  if (best.verdict.fits >= kFits) return best;
  constexpr double kWide_m = 0.2;
  for (const Belief& about : beliefs) {
    for (const double turn_rad : {0.0, 0.1, -0.1}) {
      Pose2 start = about.pose;
      start.yaw_rad = wrapped(start.yaw_rad + turn_rad);
      FitRule rule{kWide_m, PlaceMap::kReach_m, 4, 6, about.pose};
      rule.weight = about.information;
      offer(fit_pose(map, look, start, rule).pose, about);
    }
  }
  return best;
}

// The place's direction of most variance.
Tracker::Along Tracker::uncertain_along(const Eigen::Matrix3d& covariance) {
  const double xx = covariance(0, 0), yy = covariance(1, 1), xy = covariance(0, 1);
  const double half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy);
  const double angle_rad = root > 0.0 ? 0.5 * arc_tangent2(xy, half) : 0.0;
  return {{cosine(angle_rad), sine(angle_rad)}, std::sqrt(0.5 * (xx + yy) + root)};
}

// What the fit tells joins what was known. Along a road that holds little, odometry is better than the fit; without it
// the fit's place stays, as uncertain as it may slide: scans of the same walls err alike, and do not add up. Where the
// likeliest belief did not expect the place, or another one that the look does not exclude, the place may be wrong by
// all of the way between, until a later scan has looked along it.
void Tracker::update(const PlaceMap& map, const Look& look, const Beliefs& beliefs, const Belief& likeliest,
                     PatchCosts* room) {
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
    if (known_m2 < slid.reach_m * slid.reach_m && likeliest.is_odometry) {
      const double off_m = slid.direction.dot(fit_.pose.place() - likeliest.pose.place());
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
  for (const Belief& one : beliefs) {
    if (one.agrees(fit_.pose)) continue;
    const Eigen::Vector3d off = one.off(fit_.pose);
    const double along_m = d.dot(off);
    if (&one == &likeliest) {
      covariance_ += off * off.transpose();
    } else if (slides && std::abs(along_m) <= slid.reach_m) {
      covariance_ += along_m * along_m * d * d.transpose();
    }
  }
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
  Beliefs here;
  here.all[here.count++] = {pose_, covariance_, covariance_.inverse()};
  return follow_to(map, look, odometry, here, room);
}

Track Tracker::follow(const PlaceMap& map, const Look& look, const Pose2* odometry, PatchCosts* room) {
  return follow_to(map, look, odometry, predict(odometry), room);
}

Track Tracker::follow_to(const PlaceMap& map, const Look& look, const Pose2* odometry, const Beliefs& beliefs,
                         PatchCosts* room) {
  const Pose2 before = pose_;
  const Placed placed = place(map, look, beliefs, room);
  const Belief& likeliest = *placed.belief;
  fit_ = placed.fit;
  verdict_ = placed.verdict;
  const bool agrees = beliefs.first().agrees(fit_.pose);
  covariance_ = likeliest.covariance;
  const Track track = judge(between(before, likeliest.pose).place().norm());
  if (track == Track::tracked || track == Track::doubtful) {
    update(map, look, beliefs, likeliest, room);
    pose_ = fit_.pose;
  } else {
    pose_ = likeliest.pose;
  }
  // The first fit corrects where base was said to stand, which tells nothing of how it moves.
  has_followed_ ? predictor_.follow(before, pose_, odometry, agrees) : predictor_.start(odometry);
  has_followed_ = true;
  constexpr double kPlaced_m = 0.2;  // a place that is less certain is not one place
  return track == Track::tracked && !(uncertain_along(covariance_).sigma_m < kPlaced_m) ? Track::loose : track;
}

}  // namespace pose_wall::planar

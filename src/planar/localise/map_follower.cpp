// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/map_follower.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "place/slide.hpp"

namespace pose_wall::planar {
namespace {

// The place's direction of most variance.
struct Uncertain {
  Eigen::Vector2d direction;
  double sigma_m;

  explicit Uncertain(const Eigen::Matrix3d& covariance) {
    const PrincipalAxes axes(covariance(0, 0), covariance(0, 1), covariance(1, 1));
    direction = axes.most;
    sigma_m = std::sqrt(axes.most_value);
  }
};

}  // namespace

void MapFollower::open(double odometry_m, double odometry_rad) {
  predictor_.open(odometry_m, odometry_rad);
  begin(Pose2(), 1.0, 1.0);
}

void MapFollower::begin(const Pose2& pose, double sigma_m, double sigma_rad) {
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
MapFollower::Predictions MapFollower::predict(const Pose2* odometry) const {
  StepPredictor::Prediction steps[StepPredictor::kMost];
  Predictions predictions;
  predictions.count = predictor_.predict(pose_, odometry, steps);
  for (std::uint32_t k = 0; k < predictions.count; ++k) {
    const StepPredictor::Prediction& step = steps[k];
    const double step_m2 = step.sigma_m * step.sigma_m, step_rad2 = step.sigma_rad * step.sigma_rad;
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    J(0, 2) = pose_.y_m - step.pose.y_m;
    J(1, 2) = step.pose.x_m - pose_.x_m;
    Predicted& predicted = predictions.all[k];
    predicted.pose = step.pose;
    predicted.covariance = J * covariance_ * J.transpose();
    predicted.covariance.diagonal() += Eigen::Vector3d(step_m2, step_m2, step_rad2);
    predicted.information = predicted.covariance.inverse();
    predicted.unlikely = step.unlikely;
    predicted.is_odometry = step.is_odometry;
  }
  return predictions;
}

const MapFollower::Predicted& MapFollower::Predictions::likeliest(const Pose2& at, double* unlikely) const {
  const Predicted* best = nullptr;
  for (const Predicted& one : *this) {
    const double here = one.unlikely + one.squared_distance(at);
    if (best != nullptr && !(here < *unlikely)) continue;
    best = &one;
    *unlikely = here;
  }
  return *best;
}

MapFollower::Placed MapFollower::fit_from(const PlaceMap& map, const Surroundings& around, const Pose2& start,
                                          const Predicted& predicted, const Predictions& predictions) {
  Placed out;
  PatchCosts costs;
  out.fit = fit_pose(map, around.points, start, {around.sigma_m, predicted.prior()});
  out.verdict = judge_patches(map, around, out.fit.pose, &costs);
  double unlikely = 0.0;
  out.predicted = &predictions.likeliest(out.fit.pose, &unlikely);
  out.cost = out.verdict.cost + unlikely;
  return out;
}

// The fit that the scan and one of the predictions together like best. Predictions that the first one's fit contradicts
// are tried, too. Where the place is uncertain along the road, other starts along it join in, and where the scan is not
// explained, wider residuals, which find what is near.
MapFollower::Placed MapFollower::place(const PlaceMap& map, const Surroundings& around,
                                       const Predictions& predictions) const {
  Placed best = fit_from(map, around, predictions.first().pose, predictions.first(), predictions);
  const auto offer = [&](const Pose2& start, const Predicted& predicted) {
    const Placed one = fit_from(map, around, start, predicted, predictions);
    if (one.cost < best.cost) best = one;
  };
  const Uncertain along(predictions.first().covariance);
  constexpr double kCertain_m = 0.12;  // about a cell of the map
  constexpr double kStep_m = 0.25;     // what a fit reaches to each side of a start
  constexpr int kStepsMost = 6;        // to 1.5 m: a place that is less certain is lost
  for (int k = 1; k <= kStepsMost && along.sigma_m > kCertain_m && (k - 1) * kStep_m < 2.0 * along.sigma_m; ++k) {
    for (const double sign : {1.0, -1.0}) {
      Pose2 start = predictions.first().pose;
      start.x_m += sign * k * kStep_m * along.direction.x();
      start.y_m += sign * k * kStep_m * along.direction.y();
      offer(start, predictions.first());
    }
  }
  for (const Predicted& one : predictions) {
    if (&one != &predictions.first() && !one.agrees(best.fit.pose)) offer(one.pose, one);
  }
  if (passes<gate::TRACKED>(best.verdict.fits)) return best;
  constexpr double kWide_m = 0.2;  // two cells: ten times the noise, so that what is near still pulls
  for (const Predicted& about : predictions) {
    for (const double turn_rad : {0.0, 0.1, -0.1}) {
      Pose2 start = about.pose;
      start.yaw_rad = wrapped(start.yaw_rad + turn_rad);
      offer(fit_pose(map, around.points, start, {kWide_m, about.prior(), 4, 6}).pose, about);
    }
  }
  return best;
}

// What the fit tells joins what was known. Along a road that holds little, odometry is better than the fit; without it
// the fit's place stays, as uncertain as it may slide: scans of the same walls err alike, and do not add up. Where the
// likeliest prediction did not expect the place, or another one that the scan does not exclude, the place may be wrong
// by all of the way between, until a later scan has looked along it.
void MapFollower::update(const PlaceMap& map, const Surroundings& around, const Predictions& predictions,
                         const Predicted& likeliest) {
  const Slide slid = slide_of(map, around, fit_, limit_of<gate::EXCLUDED_NEAR>(), kRefit);
  slide_m_ = slid.reach_m;
  Eigen::Matrix3d told = fit_.information / kAlike;
  const bool slides = passes<gate::SLIDES>(slid.reach_m);
  const Eigen::Vector3d d(slid.direction.x(), slid.direction.y(), 0.0);
  const double known_m2 = d.dot(covariance_ * d);
  if (slides) {
    told = less_along(told, slid.direction, 0.0);
    if (known_m2 < slid.reach_m * slid.reach_m && likeliest.is_odometry) {
      const double off_m = slid.direction.dot(fit_.pose.place() - likeliest.pose.place());
      fit_.pose.x_m -= off_m * slid.direction.x();
      fit_.pose.y_m -= off_m * slid.direction.y();
    }
  }
  covariance_ = (told + covariance_.inverse()).inverse().eval();
  const double left_m2 = d.dot(covariance_ * d), most_m2 = slid.reach_m * slid.reach_m;
  if (slides && left_m2 > most_m2) {
    // As if one scan of this precision had told it, however many there were.
    const double told_along = 1.0 / most_m2 - 1.0 / left_m2;
    covariance_ = (covariance_.inverse() + told_along * d * d.transpose()).inverse().eval();
  }
  // The map itself is no better than this.
  constexpr double kMap_m = 0.01, kMap_rad = 0.001;
  covariance_.diagonal() += Eigen::Vector3d(kMap_m * kMap_m, kMap_m * kMap_m, kMap_rad * kMap_rad);
  for (const Predicted& one : predictions) {
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

TrackingState MapFollower::judge(double step_m) {
  const bool sees = passes<gate::SAW>(verdict_.seen) && 2 * verdict_.seen >= verdict_.judged;
  TrackingState track = TrackingState::tracked;
  if (!sees) {
    track = TrackingState::blind;
  } else if (!passes<gate::BEARABLE>(verdict_.fits)) {
    track = TrackingState::contradicted;
  } else if (!passes<gate::TRACKED>(verdict_.fits)) {
    track = TrackingState::doubtful;
  }
  contradicted_ = track == TrackingState::contradicted ? contradicted_ + 1
                  : track == TrackingState::blind      ? contradicted_
                                                       : 0;
  doubtful_m_ = track == TrackingState::tracked ? 0.0 : doubtful_m_ + step_m;
  const double place_m2 = covariance_(0, 0) + covariance_(1, 1);
  const bool is_lost =
      !passes<gate::IN_A_ROW>(contradicted_) || !passes<gate::PATIENCE>(doubtful_m_) || !passes<gate::KNOWN>(place_m2);
  return is_lost ? TrackingState::lost : track;
}

TrackingState MapFollower::confirm(const PlaceMap& map, const Surroundings& around, const Pose2* odometry) {
  Predictions here;
  here.all[here.count++] = {{pose_, covariance_.inverse()}, covariance_};
  return follow_to(map, around, odometry, here);
}

TrackingState MapFollower::follow(const PlaceMap& map, const Surroundings& around, const Pose2* odometry) {
  return follow_to(map, around, odometry, predict(odometry));
}

TrackingState MapFollower::follow_to(const PlaceMap& map, const Surroundings& around, const Pose2* odometry,
                                     const Predictions& predictions) {
  const Pose2 before = pose_;
  const Placed placed = place(map, around, predictions);
  const Predicted& likeliest = *placed.predicted;
  fit_ = placed.fit;
  verdict_ = placed.verdict;
  const bool agrees = predictions.first().agrees(fit_.pose);
  covariance_ = likeliest.covariance;
  const TrackingState track = judge(between(before, likeliest.pose).place().norm());
  if (track == TrackingState::tracked || track == TrackingState::doubtful) {
    update(map, around, predictions, likeliest);
    pose_ = fit_.pose;
  } else {
    pose_ = likeliest.pose;
  }
  // The first fit corrects where base was said to stand, which tells nothing of how it moves.
  has_followed_ ? predictor_.follow(before, pose_, odometry, agrees) : predictor_.start(odometry);
  has_followed_ = true;
  const bool is_placed = track != TrackingState::tracked || passes<gate::PLACED>(Uncertain(covariance_).sigma_m);
  return is_placed ? track : TrackingState::loose;
}

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/conclude.hpp"

#include <cmath>

namespace pose_wall::motion {
namespace {

constexpr double kBentShare = 0.1;  // of a step, while scans are bent: the difference of near and far rock
// Slopes of a steady bend that spread by s over 20 m of map turn by 0.17 s a metre.
constexpr double kBendOfSpread = 0.17;

// The way along with the machine's own data.
struct Weighed {
  Eigen::Vector3d t;
  double variance_m2;
  std::uint32_t reasons = 0;
};

// The given way stands alone without evidence of the rock. Otherwise it is weighed in or refused.
Weighed weigh(const Road& road, const MachinePrior& prior, const Placed& placed) {
  const Alignment& a = placed.alignment;
  Weighed out = {a.pose.t, a.covariance(0, 0)};
  if (!prior.has_way()) return out;
  const Pose& last = road.course.pose;
  const double towards = (last.R * road.settings.forward_base).dot(a.axes.along);
  const double way_m = (a.pose.t - last.t).dot(a.axes.along);
  if (!placed.is(POSE_WALL_ALONG_MEASURED)) {
    out.t += (prior.way_m * towards - way_m) * a.axes.along;
    return out;
  }
  const WeighedWay way = weigh_in(prior, towards, way_m, out.variance_m2, road.settings.protection_sigmas);
  if (!way.agrees) out.reasons = POSE_WALL_MOTION_R_PRIOR;
  if (way.agrees) out.t += way.further_m * a.axes.along;
  out.variance_m2 = way.variance_m2;
  return out;
}

// The unknown way along, beyond sigma.
double slip_of(const MotionSettings& settings, const Frame& frame, const MachinePrior& prior, const Placed& placed,
               double along_m) {
  if (placed.is(POSE_WALL_ALONG_MEASURED)) return 0.0;
  if (prior.has_way()) return settings.protection_sigmas * prior.way_sigma_m;
  if (placed.is(POSE_WALL_ALONG_AMBIGUOUS)) return placed.curve.apart_m;
  return settings.speed_max_m_s * frame.dt_s + std::fabs(along_m);
}

// What the patches of rock say of this step.
void take_rock(const Course& last, const Alignment& a, double variance_m2, bool measured, double along_m,
               SixBySix* covariance) {
  SixBySix& C = *covariance;
  C = a.covariance;
  C(0, 0) = variance_m2;
  if (last.is_bent) C(0, 0) += kBentShare * kBentShare * along_m * along_m;
  if (measured) return;
  C.row(0).setZero();
  C.col(0).setZero();
}

// Where the road bends or dips, the slipped machine follows it, and the surfaces it is placed by are those of another
// place, which lie off by their slopes.
void add_slip(const ReliefMap& map, double slip_m, SixBySix* covariance) {
  const double off_m = map.unevenness() * slip_m, bend_rad = kBendOfSpread * off_m;
  for (const int k : {POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_UP}) (*covariance)(k, k) += off_m * off_m;
  for (int k = POSE_WALL_MOTION_ROLL; k < POSE_WALL_MOTION_DIRECTIONS; ++k) (*covariance)(k, k) += bend_rad * bend_rad;
}

// The first way that is found makes up for all that slipped.
void keep_slip(const Pieces& of_step, bool measured, Course* next) {
  if (measured) {
    next->slipped = next->since_known = Pieces{};
    return;
  }
  next->slipped.add(of_step);
  next->since_known.add(of_step);
}

}  // namespace

Concluded conclude(const Road& road, const Frame& frame, const MachinePrior& prior, const Placed& placed) {
  const Course& last = road.course;
  const MotionSettings& settings = road.settings;
  const Alignment& a = placed.alignment;
  const bool measured = placed.is(POSE_WALL_ALONG_MEASURED);
  const Weighed weighed = weigh(road, prior, placed);
  const Eigen::Vector3d move_m = weighed.t - last.pose.t;
  const double along_m = move_m.dot(a.axes.along);
  Concluded out = {last, {}, {}, weighed.reasons};
  Course& next = out.course;
  next.pose = {a.pose.R, weighed.t};
  next.axes = a.axes;
  next.rock_variance_m2 = placed.rock_variance_m2;
  next.travel.go(a.axes.in_road() * move_m, a.axes.in_road());
  MotionStep& step = out.step;
  step.s = frame.dt_s + last.lost_s;
  step.m = last.pose.R.transpose() * move_m;
  step.rad = turn_of(last.pose.R.transpose() * a.pose.R);
  step.is_along_known = measured || prior.has_way();
  step.slip_m = slip_of(settings, frame, prior, placed, along_m);
  take_rock(last, a, weighed.variance_m2, measured, along_m, &next.covariance);
  next.of_rock = next.covariance;
  if (!measured) add_slip(road.map, step.slip_m, &next.covariance);
  const auto further_on = [&](const SixBySix& C) { return turned(C, last.axes.in_road(), a.axes.in_road()); };
  step.variance = Travel::variance_of_step(further_on(last.of_rock), next.of_rock);
  Pieces of_step;
  of_step.add(step.slip_m, a.axes.along);
  const Pieces& slip = measured ? last.since_known : of_step;  // the first one found makes up for the others
  step.bounds = next.travel.of_step(further_on(last.covariance), next.covariance, slip, settings.protection_sigmas);
  step.bounds.widen(settings.speed_max_m_s * last.lost_s, settings.turn_max_rad_s * last.lost_s);
  next.lost_s = 0.0;
  // A place found again in the map undoes the slip since, unless guesses went into the map.
  if (measured && last.guesses) next.travel.slip(last.slipped, 0.0);
  keep_slip(of_step, measured, &next);
  next.guesses = !measured && (last.guesses || placed.is_guessed);
  ++next.frames;
  out.whole = next.bounds(settings.protection_sigmas);
  return out;
}

}  // namespace pose_wall::motion

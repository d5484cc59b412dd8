// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/conclude.hpp"

#include <cmath>

namespace pose_wall::motion {
namespace {

constexpr double kBentShare = 0.1;  // of a step, while scans are bent: the difference of near and far rock
// Slopes of a steady bend that spread by s over 20 m of map turn by 0.17 s a metre.
constexpr double kBendOfSpread = 0.17;

// The alignment with the machine's own data.
struct Weighed {
  Alignment alignment;
  std::uint32_t reasons = 0;
};

// The given way stands alone without evidence of the rock. Otherwise it is weighed in or refused.
Weighed weigh(const Road& road, const MachinePrior& prior, const Placed& placed) {
  Weighed out = {placed.alignment};
  if (!prior.has_way()) return out;
  Alignment& a = out.alignment;
  const Pose& last = road.course.pose;
  const double towards = (last.R * road.settings.forward_base).dot(a.axes.along);
  const double way_m = (a.pose.t - last.t).dot(a.axes.along);
  if (!placed.is(POSE_WALL_ALONG_MEASURED)) {
    a.pose.t += (prior.way_m * towards - way_m) * a.axes.along;
  } else if (!weigh_in(prior, towards, way_m, road.settings.protection_sigmas, &a)) {
    out.reasons = POSE_WALL_MOTION_R_PRIOR;
  }
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
SixBySix of_rock(const Course& last, const Alignment& a, bool measured, double along_m) {
  SixBySix out = a.covariance;
  if (last.is_bent) out(0, 0) += kBentShare * kBentShare * along_m * along_m;
  if (!measured) {
    out.row(0).setZero();
    out.col(0).setZero();
  }
  return out;
}

// Where the road bends or dips, the slipped machine follows it.
SixBySix with_bend(SixBySix covariance, const ReliefMap& map, double slip_m) {
  const double bend_rad = kBendOfSpread * map.unevenness() * slip_m;
  covariance(POSE_WALL_MOTION_PITCH, POSE_WALL_MOTION_PITCH) += bend_rad * bend_rad;
  covariance(POSE_WALL_MOTION_YAW, POSE_WALL_MOTION_YAW) += bend_rad * bend_rad;
  return covariance;
}

// The motion since the last frame, before the course takes it in.
MotionStep step_of(const Road& road, const Frame& frame, const MachinePrior& prior, const Placed& placed,
                   const Alignment& a) {
  const Course& last = road.course;
  MotionStep step;
  step.m = last.pose.R.transpose() * (a.pose.t - last.pose.t);
  step.rad = turn_of(last.pose.R.transpose() * a.pose.R);
  step.along_m = (a.pose.t - last.pose.t).dot(a.axes.along);
  step.slip_m = slip_of(road.settings, frame, prior, placed, step.along_m);
  step.is_along_known = placed.is(POSE_WALL_ALONG_MEASURED) || prior.has_way();
  step.s = frame.dt_s;
  return step;
}

}  // namespace

Concluded conclude(const Road& road, const Frame& frame, const MachinePrior& prior, const Placed& placed) {
  const Course& last = road.course;
  const MotionSettings& settings = road.settings;
  const bool measured = placed.is(POSE_WALL_ALONG_MEASURED);
  const Weighed weighed = weigh(road, prior, placed);
  const Alignment& a = weighed.alignment;
  Concluded out;
  out.reasons = weighed.reasons;
  MotionStep& step = out.step;
  step = step_of(road, frame, prior, placed, a);
  Course& next = out.course;
  next = last;
  next.pose = a.pose;
  next.axes = a.axes;
  next.of_rock = of_rock(last, a, measured, step.along_m);
  next.covariance = measured ? next.of_rock : with_bend(next.of_rock, road.map, step.slip_m);
  next.rock_variance_m2 = placed.rock_variance_m2;
  next.travel.go(step.along_m);
  step.variance = Travel::variance_of_step(last.of_rock, next.of_rock);
  const double slip_m = measured ? last.slipped_m : step.slip_m;  // the first one found makes up for the others
  step.bounds = Travel::of_step(last.covariance, next.covariance, slip_m, settings.protection_sigmas);
  if (last.lost_s > 0.0) {
    step.bounds.widen(settings.speed_max_m_s * last.lost_s, settings.turn_max_rad_s * last.lost_s);
    step.s += last.lost_s;
    next.lost_s = 0.0;
  }
  // A place found again in the map undoes the slip since, unless guesses went into the map.
  if (measured && last.guesses) next.travel.slip(last.slipped_m, 0.0);
  next.slipped_m = measured ? 0.0 : last.slipped_m + step.slip_m;
  next.guesses = !measured && (last.guesses || placed.is_guessed);
  ++next.frames;
  out.whole = next.bounds(settings.protection_sigmas);
  return out;
}

}  // namespace pose_wall::motion

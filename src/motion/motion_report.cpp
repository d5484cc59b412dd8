// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/motion_report.hpp"

#include <limits>

#include "base/math/finite.hpp"

namespace pose_wall::motion {

void report_nothing(pose_wall_motion_result* out) {
  const double none = not_a_number();
  out->along_state = POSE_WALL_ALONG_LOST;
  for (int k = 0; k < 3; ++k) out->position_m[k] = out->road_axis[k] = out->step_m[k] = out->step_rad[k] = none;
  for (double& q : out->quaternion) q = none;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    out->sigma[k] = out->step_sigma[k] = out->step_protection_level[k] = none;
    out->protection_level[k] = std::numeric_limits<double>::infinity();
  }
  out->along_m = out->step_s = none;
  out->contrast = out->patches = out->halves_m = out->second_m = out->second_gain = none;
}

void report(const Seen& seen, pose_wall_motion_result* out) {
  out->ground_points = seen.segments.ground;
  out->clusters = seen.segments.clusters;
  out->edge_points = seen.features.edges;
  out->plane_points = seen.features.planes;
}

void report(const Placed& placed, pose_wall_motion_result* out) {
  out->matched = placed.alignment.matched + placed.alignment.ground;
  out->wide_start = placed.wide ? 1U : 0U;
  if (placed.halves_m >= 0.0) out->halves_m = placed.halves_m;
  const Curve& curve = placed.curve;
  if (!curve.told) return;
  out->contrast = curve.contrast;
  out->patches = curve.patches;
  out->second_gain = curve.second_gain;
  if (curve.second_gain > 0.0) out->second_m = curve.second_m;
}

void report(const MotionStep& step, pose_wall_motion_result* out) {
  out->step_s = step.s;
  for (int k = 0; k < 3; ++k) {
    out->step_m[k] = step.m[k];
    out->step_rad[k] = step.rad[k];
  }
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    out->step_sigma[k] = step.bounds.sigma[k];
    out->step_protection_level[k] = step.bounds.level[k];
  }
}

void report(const Course& course, const Bounds& whole, const Pose& start, bool is_start, pose_wall_motion_result* out) {
  const Eigen::Vector3d position = start.R.transpose() * (course.pose.t - start.t);
  // The first frame stands at the start, without a rounding of the last bit.
  Eigen::Quaterniond q =
      is_start ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(orthonormal(start.R.transpose() * course.pose.R));
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  for (int k = 0; k < 3; ++k) out->position_m[k] = position[k];
  for (int k = 0; k < 4; ++k) out->quaternion[k] = q.coeffs()[k];
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    out->sigma[k] = whole.sigma[k];
    out->protection_level[k] = whole.level[k];
  }
  out->along_m = course.travel.along_m();
  report_axis(course.axes, start, out);
}

void report_axis(const RoadAxes& axes, const Pose& start, pose_wall_motion_result* out) {
  const Eigen::Vector3d axis = start.R.transpose() * axes.along;
  for (int k = 0; k < 3; ++k) out->road_axis[k] = axis[k];
}

}  // namespace pose_wall::motion

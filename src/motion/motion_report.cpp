// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/motion_report.hpp"

#include <limits>

#include "base/math/finite.hpp"

namespace pose_wall::motion {
namespace {

double told(bool is_told, double value) {
  return is_told ? value : not_a_number();
}

void report_pose(const Frame& frame, const Findings& found, const Pose& start, pose_wall_motion_result* out) {
  const bool has_pose = found.has_pose();
  const Course& course = found.concluded.course;
  const Eigen::Vector3d position = start.R.transpose() * (course.pose.t - start.t);
  const Eigen::Vector3d axis = start.R.transpose() * course.axes.along;
  // The first frame stands at the start, without a rounding of the last bit.
  Eigen::Quaterniond q = frame.is_first ? Eigen::Quaterniond::Identity()
                                        : Eigen::Quaterniond(orthonormal(start.R.transpose() * course.pose.R));
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  for (int k = 0; k < 3; ++k) {
    out->position_m[k] = told(has_pose, position[k]);
    out->road_axis[k] = axis[k];
  }
  for (int k = 0; k < 4; ++k) out->quaternion[k] = told(has_pose, q.coeffs()[k]);
  const Bounds& whole = found.concluded.whole;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    out->sigma[k] = told(has_pose, whole.sigma[k]);
    out->protection_level[k] = has_pose ? whole.level[k] : std::numeric_limits<double>::infinity();
  }
}

void report_step(bool stepped, const MotionStep& step, pose_wall_motion_result* out) {
  for (int k = 0; k < 3; ++k) {
    out->step_m[k] = told(stepped, step.m[k]);
    out->step_rad[k] = told(stepped, step.rad[k]);
  }
  out->step_s = told(stepped, step.s);
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    out->step_sigma[k] = told(stepped, step.bounds.sigma[k]);
    out->step_protection_level[k] = told(stepped, step.bounds.level[k]);
  }
}

void report_match(const Placed& placed, pose_wall_motion_result* out) {
  const Curve& curve = placed.curve;
  out->contrast = told(curve.told, curve.contrast);
  out->patches = told(curve.told, curve.patches);
  out->halves_m = told(placed.halves_m >= 0.0, placed.halves_m);
  out->second_m = told(curve.told && curve.second_gain > 0.0, curve.second_m);
  out->second_gain = told(curve.told, curve.second_gain);
  out->matched = placed.alignment.matched + placed.alignment.ground;
  out->wide_start = placed.wide ? 1U : 0U;
}

}  // namespace

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

void report(const Frame& frame, const Findings& found, const Pose& start, pose_wall_motion_result* out) {
  out->along_state = found.state;
  out->reasons = found.reasons;
  out->stamp_ns = frame.cloud.stamp_ns;
  report_pose(frame, found, start, out);
  report_step(found.has_pose() && !frame.is_first && found.has_stamp(), found.concluded.step, out);
  report_match(found.placed, out);
  out->points_in = static_cast<std::uint32_t>(static_cast<std::uint64_t>(frame.cloud.width) * frame.cloud.height);
  out->ground_points = found.seen.segments.ground;
  out->clusters = found.seen.segments.clusters;
  out->edge_points = found.seen.features.edges;
  out->plane_points = found.seen.features.planes;
}

}  // namespace pose_wall::motion

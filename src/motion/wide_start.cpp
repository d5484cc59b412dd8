// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/wide_start.hpp"

#include <cmath>

namespace pose_wall::motion {
namespace {

constexpr std::uint32_t kAsked = 250;  // observations that answer
constexpr double kShareLeast = 0.25;
constexpr int kStepsMost = 24;  // to each side

// One pass of the search: how far to each side, and in which steps.
struct Pass {
  double yaw_rad, yaw_step_rad, place_m, place_step_m;
};

int steps_of(double reach, double step) {
  const int steps = static_cast<int>(reach / step + 0.5);
  return steps < kStepsMost ? steps : kStepsMost;
}

Eigen::Vector3d normal_of(const Observation& o) {
  return {static_cast<double>(o.normal[0]), static_cast<double>(o.normal[1]), static_cast<double>(o.normal[2])};
}

}  // namespace

Eigen::Matrix3d upright(Span<const Observation> observations, const Eigen::Matrix3d& R_map_base,
                        const Eigen::Vector3d& sensor_base_m) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  // Wide, then narrow: points off the ground drop out.
  for (const double cosine_least : {0.8, 0.9, 0.97, 0.985}) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::uint32_t count = 0;
    for (const Observation& o : observations) {
      const Eigen::Vector3d n = R_map_base * normal_of(o);
      const Eigen::Vector3d arm(static_cast<double>(o.x), static_cast<double>(o.y), static_cast<double>(o.z));
      if (!(n.dot(up) > cosine_least) || !(up.dot(R_map_base * (arm - sensor_base_m)) < -0.3)) continue;
      sum += n;
      ++count;
    }
    if (count < 30) return Eigen::Matrix3d::Identity();
    up = sum / std::sqrt(sum.squaredNorm());
  }
  const Eigen::Vector3d axis = up.cross(Eigen::Vector3d::UnitZ());
  const double sine_of = std::sqrt(axis.squaredNorm());
  return sine_of > 1e-9 ? turn_by(axis * (arc_tangent2(sine_of, up.z()) / sine_of)) : Eigen::Matrix3d::Identity();
}

double squaring_yaw_rad(Span<const Observation> observations, const Eigen::Matrix3d& R_map_base) {
  double c = 0.0, s = 0.0;
  for (const Observation& o : observations) {
    const Eigen::Vector3d n = R_map_base * normal_of(o);
    if (!(std::fabs(n.z()) < 0.5)) continue;
    const double angle = 4.0 * arc_tangent2(n.y(), n.x());  // the same for all four sides of a square
    c += cosine(angle);
    s += sine(angle);
  }
  return -0.25 * arc_tangent2(s, c);
}

double share_on_map(const ReliefMap& map, Span<const Observation> observations, const Pose& pose,
                    std::uint32_t stride) {
  const LocalPose local(pose, map.corner());
  double on = 0.0, asked = 0.0;
  for (std::uint32_t i = 0; i < observations.size(); i += stride) {
    const Observation& o = observations[i];
    Surface at;
    if (o.ground != 0) continue;  // is met wherever the machine turns and goes
    asked += 1.0;
    if (map.find(local(Eigen::Vector3f(o.x, o.y, o.z)), o.facing, &at)) {
      on += 1.0 - static_cast<double>(std::fabs(at.above_m) / kLayer_m);
    }
  }
  return asked > 0.0 ? on / asked : 0.0;
}

namespace {

// The best of a grid about the pose; of places that fit alike the nearest.
double search(const ReliefMap& map, Span<Observation> observations, const Pass& pass, Pose* pose) {
  const std::uint32_t stride = observations.size() / kAsked + 1;
  const int yaws = steps_of(pass.yaw_rad, pass.yaw_step_rad), places = steps_of(pass.place_m, pass.place_step_m);
  const Pose start = *pose;
  double best = 0.0;
  for (int yaw = -yaws; yaw <= yaws; ++yaw) {
    Pose turned = start;
    turned.R = turn_by(Eigen::Vector3d(0.0, 0.0, pass.yaw_step_rad * yaw)) * start.R;
    face(turned.R, observations);
    for (int i = -places; i <= places; ++i) {
      for (int j = -places; j <= places; ++j) {
        Pose at = turned;
        at.t += Eigen::Vector3d(pass.place_step_m * i, pass.place_step_m * j, 0.0);
        const double far = 5e-4 * (i * i + j * j) + 1e-4 * yaw * yaw;
        const double share = share_on_map(map, observations, at, stride) - far;
        if (!(share > best)) continue;
        best = share;
        *pose = at;
      }
    }
  }
  face(pose->R, observations);
  return best;
}

}  // namespace

bool search_wide(const ReliefMap& map, Span<Observation> observations, const WideReach& reach, Pose* pose) {
  // A layer of 0.35 m spans 2 degrees at 10 m; the second pass is for things further away.
  search(map, observations, {reach.yaw_rad, 0.035, reach.place_m, 0.3}, pose);
  search(map, observations, {0.03, 0.01, 0.2, 0.1}, pose);
  return search(map, observations, {0.008, 0.004, 0.05, 0.05}, pose) > kShareLeast;
}

}  // namespace pose_wall::motion

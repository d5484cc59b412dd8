// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Plain data that flows between the stages. Frames: _base, _level (base turned by R_level_base, same origin).

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/point_set.hpp"
#include "base/estimation/plane.hpp"
#include "pose_wall.h"

namespace pose_wall {

// The machine's axes in base; left = Z x forward.
struct Axes {
  Eigen::Vector3d forward_base;
  Eigen::Vector3d left_base;
};

// lidar to base.
struct Extrinsic {
  Eigen::Matrix3d R_base_lidar;
  Eigen::Vector3d sensor_base_m;
};

enum Quadrant : std::uint32_t { kAhead = 0, kLeft = 1, kBehind = 2, kRight = 3, kQuadrants = 4 };

// What the reading loop counted; every point of the cloud is in exactly one of kept and dropped_*.
struct IngestCounts {
  std::uint32_t points_in = 0;
  std::uint32_t kept = 0;
  std::uint32_t dropped_not_finite = 0;
  std::uint32_t dropped_zero = 0;
  std::uint32_t dropped_near = 0;
  std::uint32_t dropped_far = 0;
  std::uint32_t dropped_body = 0;
  // Of the kept and of the too near ones, by the machine's side they lie on.
  std::uint32_t kept_by_quadrant[kQuadrants] = {};
  std::uint32_t near_by_quadrant[kQuadrants] = {};
};

// What a cloud leaves behind for the next one's leaf.
struct LeafMemory {
  static constexpr std::uint32_t kAnyFewer = 0xFFFFFFFFU;  // with it, whatever there are now is fewer

  std::uint32_t begin_with = 0;      // how often the leaf that is tried first has grown
  std::uint32_t voxels = kAnyFewer;  // how many there were with it when one growth less was last tried in vain
};

struct VoxelResult {
  IngestCounts counts;
  std::uint32_t returns = 0;  // points that hold one
  LeafMemory leaf;
  double leaf_m = 0.0;
  bool leaf_grown = false;
  std::uint64_t work = 0;
  bool fits = false;  // false: points fill the air, or points_max is far too small; there are no voxels then
  std::uint64_t fingerprint = 0;
  double scan_s = 0.0;  // that the machine's motion was taken out of; 0: of none
};

// What gates have said.
struct Verdict {
  std::uint32_t reasons = 0;  // pose_wall_reason bits that forbid or weaken it
  bool refused = false;       // a gate said no

  void refuse(std::uint32_t why) {
    refused = true;
    reasons |= why;
  }
  void add(const Verdict& other) {
    reasons |= other.reasons;
    refused = refused || other.refused;
  }
};

// A plane with all that its fit knows about itself.
struct PlaneFit : Verdict {
  Plane plane;  // floor: base frame, normal up. wall: levelled frame, normal towards the machine
  bool found = false;
  std::uint32_t inliers = 0;
  std::uint32_t iterations = 0;
  double rms_m = 0.0;
};

// What a protection level is made of: one figure for each pose_wall_part. The level is their sum.
struct ProtectionParts {
  double of[POSE_WALL_PARTS] = {};

  double& operator[](pose_wall_part part) { return of[part]; }
  double operator[](pose_wall_part part) const { return of[part]; }

  double sum() const {
    double sum = 0.0;
    for (const double part : of) sum += part;
    return sum;
  }
  void add(const ProtectionParts& other, double share = 1.0) {
    for (int part = 0; part < POSE_WALL_PARTS; ++part) of[part] += share * other.of[part];
  }
  // The level becomes at least so large; what is missing is this part's. NaN stays visible: it makes the level NaN.
  void reach(double least, pose_wall_part part) {
    const double missing = least - sum();
    if (!(missing <= 0.0)) of[part] += missing;
  }
};

// The planes that a frame stands by: what was refused is none.
struct Surfaces {
  Plane floor_base;
  Plane wall_level[2];  // left, right
  bool has_floor = false;
  bool has_wall[2] = {false, false};
};

// One of the seven quantities, as this frame measured it.
struct Measurement {
  bool measured = false;
  bool weak = false;  // measured, but never better than degraded
  double raw = 0.0;
  double sigma = 0.0;
  ProtectionParts protection;
  std::uint32_t reasons = 0;
};

struct Measurements {
  Measurement quantity[POSE_WALL_QUANTITIES];
  double left_right_yaw_difference_rad = 0.0;
  bool has_yaw_difference = false;
};

// What a frame says of itself, apart from its geometry.
struct FrameTiming {
  double dt_s = 0.0;  // since the last frame, 0 for the first
  bool first = false;
  bool still = false;  // the last frame's stamp again
  bool back = false;   // older than the last frame's
  bool leap = false;   // more than stamp_gap_max ahead
  std::uint32_t reasons = 0;
};

}  // namespace pose_wall

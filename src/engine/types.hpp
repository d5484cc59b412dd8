// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Plain data that all rooms share. Frames: _base, _level (base turned by R_level_base, same origin).

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

// Doubts say what else the scene may be. The level reaches to that, so a level within the alert limit answers them.
constexpr std::uint32_t kDoubts = POSE_WALL_R_FLOOR_AMBIGUOUS | POSE_WALL_R_WALL_AMBIGUOUS |
                                  POSE_WALL_R_WALL_SEEN_THROUGH | POSE_WALL_R_EXTRAPOLATED | POSE_WALL_R_CURVED;

// The verdict of gates.
struct Verdict {
  std::uint32_t reasons = 0;  // pose_wall_reason bits that forbid or doubt it
  bool refused = false;       // a gate refused it

  void refuse(std::uint32_t why) {
    refused = true;
    reasons |= why;
  }
  void add(const Verdict& other) {
    reasons |= other.reasons;
    refused = refused || other.refused;
  }
};

// A plane with the figures of its fit.
struct PlaneFit : Verdict {
  Plane plane;  // floor: base frame, normal up. wall: levelled frame, normal towards the machine
  bool found = false;
  std::uint32_t inliers = 0;
  std::uint32_t iterations = 0;
  double rms_m = 0.0;
};

// The parts of a protection level, one for each pose_wall_part. The level is their sum.
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
  // Raises the level to at least this and adds the difference to this part. NaN stays visible: it makes the level NaN.
  void reach(double least, pose_wall_part part) {
    const double missing = least - sum();
    if (!(missing <= 0.0)) of[part] += missing;
  }
};

// The accepted planes of a frame.
struct Surfaces {
  Plane floor_base;
  Plane wall_level[2];  // left, right
  bool has_floor = false;
  bool has_wall[2] = {false, false};
};

}  // namespace pose_wall

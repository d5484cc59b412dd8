// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Removes the machine's motion during a scan: puts each point where it would have been seen at the stamp.

#pragma once

#include <cstdint>

#include "base/simd/four_floats.hpp"
#include "pose_wall.h"

namespace pose_wall {

class Skew {
 public:
  // Without an odometry, or without times in the cloud, nothing is removed.
  Skew(const pose_wall_cloud& cloud, const pose_wall_odometry* odometry);

  bool is_there() const { return unit_s_ > 0.0; }
  double scan_s() const { return scan_s_; }
  // Time since the stamp; 0 for a time that is not finite.
  float seconds(const unsigned char* point) const;
  // To second order of the turn: 0.1 mm at 10 m in 0.1 s at 10 degrees a second.
  FourPlaces taken_out(const FourPlaces& base, FourFloats time_s) const;

 private:
  FourPlaces turned(const FourPlaces& p) const {
    return {turn_[1] * p.z - turn_[2] * p.y, turn_[2] * p.x - turn_[0] * p.z, turn_[0] * p.y - turn_[1] * p.x};
  }

  const pose_wall_cloud& cloud_;
  bool swap_;
  double zero_ = 0.0, unit_s_ = 0.0, scan_s_ = 0.0;
  float velocity_[3] = {}, turn_[3] = {};  // m/s, rad/s
};

}  // namespace pose_wall

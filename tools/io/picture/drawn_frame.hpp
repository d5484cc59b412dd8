// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The frame the picture is drawn in: levelled, origin at base, first axis along the road (or along the machine where
// there is no yaw), second to its left, third up. Metres.
#pragma once

#include <array>
#include <string_view>

#include "pose_wall.h"

namespace pose_wall::tools::picture {

struct Drawn {
  double along;
  double left;
  double up;
};

struct DrawnPlane {
  bool found;
  Drawn normal;
  double d_m;
  double extent_min_m;
  double extent_max_m;

  // Distance along `left` at which a wall stands, at this place and height.
  double left_at(double along_m, double up_m) const;
};

class DrawnFrame {
 public:
  DrawnFrame(const pose_wall_config& config, const pose_wall_result& result);

  Drawn from_base(double x_m, double y_m, double z_m) const;
  // A point of the machine: ahead of and left of the base origin, in base.
  Drawn from_machine(double forward_m, double left_m, double up_m) const;
  DrawnPlane wall(const pose_wall_plane& plane) const;

  // Height of the floor; -1.5 where none was found, so that a machine can be drawn.
  double floor_up_m() const { return floor_up_m_; }
  bool has_floor() const { return has_floor_; }
  bool has_yaw() const { return has_yaw_; }
  double yaw_rad() const { return yaw_rad_; }

 private:
  using Vector = std::array<double, 3>;

  Drawn from_level(const Vector& p_level) const;
  Vector to_level(const Vector& p_base) const;

  std::array<double, 9> R_level_base_;
  Vector forward_base_;
  Vector left_base_;
  Vector along_level_;
  bool has_yaw_;
  double yaw_rad_;
  bool has_floor_;
  double floor_up_m_;
};

}  // namespace pose_wall::tools::picture

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/picture/drawn_frame.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pose_wall::tools::picture {
namespace {

constexpr double kAssumedFloor_m = -1.5;

std::array<double, 3> axis_of(std::string_view name) {
  const double sign = name.substr(0, 1) == "-" ? -1.0 : 1.0;
  return name.substr(1) == "Y" ? std::array<double, 3>{0.0, sign, 0.0} : std::array<double, 3>{sign, 0.0, 0.0};
}

}  // namespace

double DrawnPlane::left_at(double along_m, double up_m) const {
  return -(d_m + normal.along * along_m + normal.up * up_m) / normal.left;
}

DrawnFrame::DrawnFrame(const pose_wall_config& config, const pose_wall_result& result) {
  std::copy(std::begin(result.R_level_base), std::end(result.R_level_base), R_level_base_.begin());
  char axis[POSE_WALL_TEXT_MAX] = "+X";
  pose_wall_config_get_text(&config, "forward_axis", axis, sizeof axis);
  forward_base_ = axis_of(axis);
  left_base_ = {-forward_base_[1], forward_base_[0], 0.0};

  const pose_wall_value& yaw = result.quantity[POSE_WALL_YAW];
  const double angle = std::isfinite(yaw.raw) ? yaw.raw : yaw.value;
  has_yaw_ = std::isfinite(angle);
  yaw_rad_ = has_yaw_ ? angle : 0.0;
  // The road lies yaw to the left of the machine's axis.
  const Vector forward = to_level(forward_base_);
  const double heading = std::atan2(forward[1], forward[0]) + yaw_rad_;
  along_level_ = {std::cos(heading), std::sin(heading), 0.0};

  has_floor_ = result.floor.found != 0;
  floor_up_m_ = has_floor_ ? -result.floor.d_m : kAssumedFloor_m;
}

DrawnFrame::Vector DrawnFrame::to_level(const Vector& p_base) const {
  Vector p_level{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) p_level[row] += R_level_base_[3 * row + column] * p_base[column];
  }
  return p_level;
}

Drawn DrawnFrame::from_level(const Vector& p_level) const {
  return {along_level_[0] * p_level[0] + along_level_[1] * p_level[1],
          along_level_[0] * p_level[1] - along_level_[1] * p_level[0], p_level[2]};
}

Drawn DrawnFrame::from_base(double x_m, double y_m, double z_m) const {
  return from_level(to_level({x_m, y_m, z_m}));
}

Drawn DrawnFrame::from_machine(double forward_m, double left_m, double up_m) const {
  return from_base(forward_m * forward_base_[0] + left_m * left_base_[0],
                   forward_m * forward_base_[1] + left_m * left_base_[1], up_m);
}

DrawnPlane DrawnFrame::wall(const pose_wall_plane& plane) const {
  const Drawn normal = from_level({plane.normal[0], plane.normal[1], plane.normal[2]});
  const bool drawable = plane.found != 0 && std::abs(normal.left) > 0.1;
  return {drawable, normal, plane.d_m, plane.extent_min_m, plane.extent_max_m};
}

}  // namespace pose_wall::tools::picture

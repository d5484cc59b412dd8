// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What a cloud is as a whole: whether its description fits its data, which common layout its points have, what its
// times count.

#pragma once

#include <cstdint>
#include <cstring>

#include "base/simd/four_floats.hpp"
#include "lidar/cloud_fields.hpp"
#include "pose_wall.h"

namespace pose_wall {

// POSE_WALL_OK when every point of the description lies inside its data and every field can be read.
std::int32_t check_cloud(const pose_wall_cloud& cloud);

// Four points whose x, y and z lie in a row (is_xyz32_in_a_row) from so many bytes behind these places.
inline FourPlaces plain_four(const unsigned char* const* at, std::size_t offset) {
  FourFloats points[kFour], rows[kFour];
  for (std::uint32_t i = 0; i < kFour; ++i) std::memcpy(&points[i], at[i] + offset, sizeof(*points));
  transpose(points[0], points[1], points[2], points[3], rows);
  return {rows[0], rows[1], rows[2]};
}
// Of four points side by side; x is that of the first one.
inline FourPlaces plain_four(const unsigned char* x, std::size_t point_step) {
  const unsigned char* const at[kFour] = {x, x + point_step, x + 2 * point_step, x + 3 * point_step};
  return plain_four(at, 0);
}

// The unit of a cloud's times, from their spread, since a scan takes 0.01 to 1 s. 0 if no unit makes a scan of them.
double time_unit_s(double spread);
// Of times from the least to the most, the one that means the stamp: zero if they may count from it, else the least.
// The first returns of a scan may be lost, and the times of the others do not begin with zero then.
double time_of_stamp(double least, double most, double unit_s);

// x, y and z are native floats: the common case, read without a switch per field.
bool is_plain_xyz32(const pose_wall_cloud& cloud);

// The same, and they lie one after the other with enough of the point behind them for a load of four.
bool is_xyz32_in_a_row(const pose_wall_cloud& cloud);

}  // namespace pose_wall

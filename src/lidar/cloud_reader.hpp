// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The one place where raw bytes of a cloud become numbers.

#pragma once

#include <cstdint>
#include <cstring>

#include "base/math/finite.hpp"
#include "base/simd/four_floats.hpp"
#include "pose_wall.h"

namespace pose_wall {

// POSE_WALL_OK when every point of the description lies inside its data and every field can be read.
std::int32_t check_cloud(const pose_wall_cloud& cloud);

// Bytes of a field's type; 0 for an unknown type.
std::uint32_t field_bytes(std::uint32_t type);

// Reads one field of a point as a number. The type is known and the field lies inside the point (check_cloud).
double read_field(const unsigned char* point, const pose_wall_field& field, bool swap_bytes);

// The same, quick for 32-bit counters, the usual type of times.
inline double read_number(const unsigned char* point, const pose_wall_field& field, bool swap_bytes) {
  if (swap_bytes || field.type != POSE_WALL_FIELD_UINT32) return read_field(point, field, swap_bytes);
  std::uint32_t value;
  std::memcpy(&value, point + field.offset, sizeof(value));
  return static_cast<double>(value);
}

// Doubles may be larger than any float: they are too far in either case.
inline float to_float(double value) {
  constexpr double kMost = 1e38;  // a float ends at 3.4e38
  if (value > kMost && is_finite(value)) return static_cast<float>(kMost);
  if (value < -kMost && is_finite(value)) return static_cast<float>(-kMost);
  return static_cast<float>(value);
}

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

// True where the cloud's byte order is not this machine's.
bool needs_swap(const pose_wall_cloud& cloud);

// x, y and z are native floats: the common case, read without a switch per field.
bool is_plain_xyz32(const pose_wall_cloud& cloud);

// The same, and they lie one after the other with enough of the point behind them for a load of four.
bool is_xyz32_in_a_row(const pose_wall_cloud& cloud);

// Number of rows with points: none if they have no width, whatever the height.
std::uint32_t rows_of(const pose_wall_cloud& cloud);

// The row's first byte; row < rows_of(cloud).
const unsigned char* row_of(const pose_wall_cloud& cloud, std::uint32_t row);

}  // namespace pose_wall

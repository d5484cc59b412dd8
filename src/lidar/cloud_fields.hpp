// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The one place where raw bytes of a cloud become numbers.

#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "base/math/finite.hpp"
#include "pose_wall.h"

namespace pose_wall {

// Bytes of a field's type; 0 for an unknown type.
inline std::uint32_t field_bytes(std::uint32_t type) {
  switch (type) {
    case POSE_WALL_FIELD_INT8:
    case POSE_WALL_FIELD_UINT8:
      return 1;
    case POSE_WALL_FIELD_INT16:
    case POSE_WALL_FIELD_UINT16:
      return 2;
    case POSE_WALL_FIELD_INT32:
    case POSE_WALL_FIELD_UINT32:
    case POSE_WALL_FIELD_FLOAT32:
      return 4;
    case POSE_WALL_FIELD_FLOAT64:
      return 8;
    default:
      return 0;
  }
}

namespace field {

template <typename T>
double load(const unsigned char* bytes, bool swap_bytes) {
  unsigned char ordered[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) ordered[i] = bytes[swap_bytes ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return static_cast<double>(value);
}

}  // namespace field

// Reads one field of a point as a number. The type is known and the field lies inside the point (check_cloud). Not
// inlined: the switch would stand in every reader, 12 KiB of the engine, and common layouts do without it.
[[gnu::noinline]] inline double read_field(const unsigned char* point, const pose_wall_field& field, bool swap_bytes) {
  const unsigned char* bytes = point + field.offset;
  switch (field.type) {
    case POSE_WALL_FIELD_INT8:
      return field::load<std::int8_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_UINT8:
      return field::load<std::uint8_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_INT16:
      return field::load<std::int16_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_UINT16:
      return field::load<std::uint16_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_INT32:
      return field::load<std::int32_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_UINT32:
      return field::load<std::uint32_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_FLOAT32:
      return field::load<float>(bytes, swap_bytes);
    default:
      return field::load<double>(bytes, swap_bytes);
  }
}

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

inline bool machine_is_big_endian() {
  const std::uint16_t probe = 1;
  unsigned char first;
  std::memcpy(&first, &probe, 1);
  return first == 0;
}

// True where the cloud's byte order is not this machine's.
inline bool needs_swap(const pose_wall_cloud& cloud) {
  return (cloud.big_endian != 0) != machine_is_big_endian();
}

// So many points, one behind the other; their fields are still to be set. Little-endian.
inline pose_wall_cloud cloud_in_a_row(const void* data, std::uint32_t points, std::uint32_t point_bytes,
                                      std::int64_t stamp_ns) {
  pose_wall_cloud cloud{};
  cloud.struct_size = sizeof(cloud);
  cloud.data = data;
  cloud.data_bytes = static_cast<std::uint64_t>(points) * point_bytes;
  cloud.width = points;
  cloud.height = 1;
  cloud.point_step = point_bytes;
  cloud.stamp_ns = stamp_ns;
  return cloud;
}

constexpr std::uint32_t kFields = 6;  // x, y, z, intensity, time, ring

// The fields of a cloud, or of what describes one by the same members, in the order of their bytes in a copy.
template <typename Cloud>
std::array<pose_wall_field*, kFields> fields_of(Cloud* cloud) {
  return {&cloud->x, &cloud->y, &cloud->z, &cloud->intensity, &cloud->time, &cloud->ring};
}

// A row's bytes, also where the description leaves them to width and step.
inline std::uint64_t row_step_of(const pose_wall_cloud& cloud) {
  return cloud.row_step != 0 ? cloud.row_step : static_cast<std::uint64_t>(cloud.width) * cloud.point_step;
}

// Number of rows with points: none if they have no width, whatever the height.
inline std::uint32_t rows_of(const pose_wall_cloud& cloud) {
  return cloud.width != 0 ? cloud.height : 0;
}

// The row's first byte; row < rows_of(cloud).
inline const unsigned char* row_of(const pose_wall_cloud& cloud, std::uint32_t row) {
  return static_cast<const unsigned char*>(cloud.data) + row * row_step_of(cloud);
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lidar/cloud_reader.hpp"

#include <cstdint>
#include <cstring>

namespace pose_wall {
namespace {

template <typename T>
double load(const unsigned char* bytes, bool swap_bytes) {
  unsigned char ordered[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) ordered[i] = bytes[swap_bytes ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return static_cast<double>(value);
}

bool is_floating(std::uint32_t type) {
  return type == POSE_WALL_FIELD_FLOAT32 || type == POSE_WALL_FIELD_FLOAT64;
}

bool fits_point(const pose_wall_field& field, std::uint32_t point_step) {
  return static_cast<std::uint64_t>(field.offset) + field_bytes(field.type) <= point_step;
}

std::uint64_t row_step_of(const pose_wall_cloud& cloud) {
  return cloud.row_step != 0 ? cloud.row_step : static_cast<std::uint64_t>(cloud.width) * cloud.point_step;
}

}  // namespace

std::uint32_t field_bytes(std::uint32_t type) {
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

double read_field(const unsigned char* point, const pose_wall_field& field, bool swap_bytes) {
  const unsigned char* bytes = point + field.offset;
  switch (field.type) {
    case POSE_WALL_FIELD_INT8:
      return load<std::int8_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_UINT8:
      return load<std::uint8_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_INT16:
      return load<std::int16_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_UINT16:
      return load<std::uint16_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_INT32:
      return load<std::int32_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_UINT32:
      return load<std::uint32_t>(bytes, swap_bytes);
    case POSE_WALL_FIELD_FLOAT32:
      return load<float>(bytes, swap_bytes);
    default:
      return load<double>(bytes, swap_bytes);
  }
}

double time_unit_s(double spread) {
  // Units of drivers: s, ms, us, ns. A scan takes 10 ms to 1 s, so no two of them fit one cloud.
  constexpr double kUnits_s[] = {1.0, 1e-3, 1e-6, 1e-9};
  for (const double unit_s : kUnits_s) {
    const double scan_s = spread * unit_s;
    if (scan_s >= 0.01 && scan_s <= 1.0) return unit_s;
  }
  return 0.0;
}

double time_of_stamp(double least, double most, double unit_s) {
  constexpr double kScanMost_s = 1.0;  // as in time_unit_s()
  return least >= 0.0 && most * unit_s <= kScanMost_s ? 0.0 : least;
}

bool needs_swap(const pose_wall_cloud& cloud) {
  const std::uint16_t probe = 1;
  unsigned char first;
  std::memcpy(&first, &probe, 1);
  const bool machine_is_big = first == 0;
  return (cloud.big_endian != 0) != machine_is_big;
}

bool is_plain_xyz32(const pose_wall_cloud& cloud) {
  return cloud.x.type == POSE_WALL_FIELD_FLOAT32 && cloud.y.type == POSE_WALL_FIELD_FLOAT32 &&
         cloud.z.type == POSE_WALL_FIELD_FLOAT32 && !needs_swap(cloud);
}

bool is_xyz32_in_a_row(const pose_wall_cloud& cloud) {
  constexpr std::uint32_t kBytes = sizeof(float), kOfFour = 4 * kBytes;  // one load reads x, y, z and the next bytes
  return is_plain_xyz32(cloud) && cloud.y.offset - cloud.x.offset == kBytes &&
         cloud.z.offset - cloud.y.offset == kBytes && cloud.point_step - cloud.x.offset >= kOfFour;
}

std::uint32_t rows_of(const pose_wall_cloud& cloud) {
  return cloud.width != 0 ? cloud.height : 0;
}

const unsigned char* row_of(const pose_wall_cloud& cloud, std::uint32_t row) {
  return static_cast<const unsigned char*>(cloud.data) + row * row_step_of(cloud);
}

std::int32_t check_cloud(const pose_wall_cloud& cloud) {
  const pose_wall_field* coordinates[] = {&cloud.x, &cloud.y, &cloud.z};
  for (const pose_wall_field* field : coordinates) {
    if (!is_floating(field->type)) return POSE_WALL_E_CLOUD_FIELD;
    if (!fits_point(*field, cloud.point_step)) return POSE_WALL_E_CLOUD_STEP;
  }
  const pose_wall_field* optional[] = {&cloud.intensity, &cloud.time, &cloud.ring};
  for (const pose_wall_field* field : optional) {
    if (field->type == POSE_WALL_FIELD_NONE) continue;
    if (field_bytes(field->type) == 0) return POSE_WALL_E_CLOUD_FIELD;
    if (!fits_point(*field, cloud.point_step)) return POSE_WALL_E_CLOUD_STEP;
  }
  if (cloud.big_endian > 1) return POSE_WALL_E_CLOUD_FIELD;
  const std::uint64_t packed_row = static_cast<std::uint64_t>(cloud.width) * cloud.point_step;
  const std::uint64_t row_step = row_step_of(cloud);
  if (row_step < packed_row) return POSE_WALL_E_CLOUD_STEP;
  if (cloud.width == 0 || cloud.height == 0) return POSE_WALL_OK;
  constexpr std::uint64_t kPointsMax = 1ULL << 26;  // sums of their weights still fit everywhere
  if (static_cast<std::uint64_t>(cloud.width) * cloud.height > kPointsMax) return POSE_WALL_E_CLOUD_SIZE;
  if (cloud.data == nullptr) return POSE_WALL_E_NULL;
  // The last row may end with its last point. (height - 1) * row_step < 2^64: both factors are below 2^32 or the
  // packed row already is larger than any data.
  if (packed_row > cloud.data_bytes) return POSE_WALL_E_CLOUD_SIZE;
  const std::uint64_t rows_before = cloud.height - 1U;
  if (rows_before != 0 && row_step > (cloud.data_bytes - packed_row) / rows_before) return POSE_WALL_E_CLOUD_SIZE;
  // No object is larger; with pointers of 32 bits a walk over such a cloud would begin at its start again.
  constexpr std::uint64_t kObjectBytesMax = PTRDIFF_MAX;
  return packed_row + rows_before * row_step <= kObjectBytesMax ? POSE_WALL_OK : POSE_WALL_E_CLOUD_SIZE;
}

}  // namespace pose_wall

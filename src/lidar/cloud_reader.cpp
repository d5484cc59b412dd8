// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lidar/cloud_reader.hpp"

#include <cstdint>

namespace pose_wall {
namespace {

bool is_floating(std::uint32_t type) {
  return type == POSE_WALL_FIELD_FLOAT32 || type == POSE_WALL_FIELD_FLOAT64;
}

bool fits_point(const pose_wall_field& field, std::uint32_t point_step) {
  return static_cast<std::uint64_t>(field.offset) + field_bytes(field.type) <= point_step;
}

}  // namespace

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

bool is_plain_xyz32(const pose_wall_cloud& cloud) {
  return cloud.x.type == POSE_WALL_FIELD_FLOAT32 && cloud.y.type == POSE_WALL_FIELD_FLOAT32 &&
         cloud.z.type == POSE_WALL_FIELD_FLOAT32 && !needs_swap(cloud);
}

bool is_xyz32_in_a_row(const pose_wall_cloud& cloud) {
  constexpr std::uint32_t kBytes = sizeof(float), kOfFour = 4 * kBytes;  // one load reads x, y, z and the next bytes
  return is_plain_xyz32(cloud) && cloud.y.offset - cloud.x.offset == kBytes &&
         cloud.z.offset - cloud.y.offset == kBytes && cloud.point_step - cloud.x.offset >= kOfFour;
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

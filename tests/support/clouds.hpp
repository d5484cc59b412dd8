// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points, and the many ways in which a driver may lay them out.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::test {

using Points = std::vector<std::array<float, 3>>;

inline pose_wall_cloud cloud_of(const Points& points, std::int64_t stamp_ns) {
  pose_wall_cloud cloud;
  pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size()), sizeof(points[0]), stamp_ns);
  return cloud;
}

inline void shuffle(Points* points, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::shuffle(points->begin(), points->end(), random);
}

struct CloudLayout {
  bool float64 = false;
  bool big_endian = false;
  std::uint32_t offset = 0;       // of x; y and z follow, each `gap` behind the one before
  std::uint32_t gap = 0;          // 0: packed
  std::uint32_t point_extra = 0;  // bytes behind z
  std::uint32_t rows = 1;
  std::uint32_t row_extra = 0;  // bytes behind each row's last point
};

// Bytes and description; the padding holds 0xEE.
struct EncodedCloud {
  std::vector<unsigned char> bytes;
  pose_wall_cloud cloud{};
};

inline void store(double value, const CloudLayout& layout, unsigned char* to) {
  unsigned char raw[8];
  const std::size_t size = layout.float64 ? 8 : 4;
  const auto single = static_cast<float>(value);
  if (layout.float64) {
    std::memcpy(raw, &value, 8);
  } else {
    std::memcpy(raw, &single, 4);
  }
  // The machines these tests run on are little-endian.
  if (layout.big_endian) std::reverse(raw, raw + size);
  std::memcpy(to, raw, size);
}

// Rows must divide the number of points; what is left over is dropped.
inline EncodedCloud encode(const Points& points, const CloudLayout& layout, std::int64_t stamp_ns) {
  const std::uint32_t size = layout.float64 ? 8 : 4;
  const std::uint32_t gap = layout.gap != 0 ? layout.gap : size;
  EncodedCloud out;
  pose_wall_cloud& c = out.cloud;
  c.struct_size = sizeof c;
  c.big_endian = layout.big_endian ? 1 : 0;
  c.width = static_cast<std::uint32_t>(points.size()) / layout.rows;
  c.height = layout.rows;
  c.point_step = layout.offset + 2 * gap + size + layout.point_extra;
  c.row_step = c.width * c.point_step + layout.row_extra;
  c.stamp_ns = stamp_ns;
  const std::uint32_t type = layout.float64 ? POSE_WALL_FIELD_FLOAT64 : POSE_WALL_FIELD_FLOAT32;
  c.x = {layout.offset, type};
  c.y = {layout.offset + gap, type};
  c.z = {layout.offset + 2 * gap, type};
  out.bytes.assign(std::size_t{c.row_step} * c.height, 0xEE);
  for (std::size_t i = 0; i < std::size_t{c.width} * c.height; ++i) {
    unsigned char* point = out.bytes.data() + i / c.width * c.row_step + i % c.width * c.point_step;
    for (std::uint32_t k = 0; k < 3; ++k) {
      store(static_cast<double>(points[i][k]), layout, point + layout.offset + k * gap);
    }
  }
  c.data = out.bytes.data();
  c.data_bytes = out.bytes.size();
  return out;
}

}  // namespace pose_wall::test

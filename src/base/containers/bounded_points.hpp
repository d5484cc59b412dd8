// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/point_set.hpp"

namespace pose_wall {

// Points with a bounding box for each block of successive ones. In a list in spatial order a block is small, so a
// search near a plane skips most blocks unread.
struct BoundedPoints : PointSet {
  // Measured on an OS1-64 (bench/README.md): boxes of 32 points left 78.9 M instructions a frame, of 16 points 79.4 M.
  static constexpr std::uint32_t kBlock = 32;

  // Of each block's box the centre and half its edges. Rows go on for a four, as those of points do.
  Span<float> centre_x, centre_y, centre_z, half_x, half_y, half_z;

  void lay_out(Arena& arena, std::uint32_t capacity);
  std::uint32_t blocks() const { return (count + kBlock - 1) / kBlock; }

  // Call it after the last change of the points.
  void bound();
};

}  // namespace pose_wall

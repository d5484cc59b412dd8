// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the cloud's room hands on, beside the points.

#pragma once

#include <cstdint>

namespace pose_wall {

enum Quadrant : std::uint32_t { kAhead = 0, kLeft = 1, kBehind = 2, kRight = 3, kQuadrants = 4 };

// What the reading loop counted; every point of the cloud is in exactly one of kept and dropped_*.
struct IngestCounts {
  std::uint32_t points_in = 0;
  std::uint32_t kept = 0;
  std::uint32_t dropped_not_finite = 0;
  std::uint32_t dropped_zero = 0;
  std::uint32_t dropped_near = 0;
  std::uint32_t dropped_far = 0;
  std::uint32_t dropped_body = 0;
  // Of the kept and of the too near ones, by the machine's side they lie on.
  std::uint32_t kept_by_quadrant[kQuadrants] = {};
  std::uint32_t near_by_quadrant[kQuadrants] = {};
};

// What a cloud leaves behind for the next one's leaf.
struct LeafMemory {
  static constexpr std::uint32_t kAnyFewer = 0xFFFFFFFFU;  // with it, whatever there are now is fewer

  std::uint32_t begin_with = 0;      // how often the leaf that is tried first has grown
  std::uint32_t voxels = kAnyFewer;  // how many there were with it when one growth less was last tried in vain
};

struct VoxelResult {
  IngestCounts counts;
  std::uint32_t returns = 0;  // points that hold one
  LeafMemory leaf;
  double leaf_m = 0.0;
  std::uint64_t work = 0;
  bool fits = false;  // false: points fill the air, or points_max is far too small; there are no voxels then
  std::uint64_t fingerprint = 0;
  double scan_s = 0.0;  // that the machine's motion was taken out of; 0: of none
};

}  // namespace pose_wall

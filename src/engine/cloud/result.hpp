// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The results of the cloud's room, beside the points.

#pragma once

#include <cstdint>

namespace pose_wall {

enum Quadrant : std::uint32_t { kAhead = 0, kLeft = 1, kBehind = 2, kRight = 3, kQuadrants = 4 };

// Counts of the reading loop; every point of the cloud is in exactly one of kept and dropped_*.
struct IngestCounts {
  std::uint32_t points_in = 0;
  std::uint32_t kept = 0;
  std::uint32_t dropped_not_finite = 0;
  std::uint32_t dropped_zero = 0;
  std::uint32_t dropped_near = 0;
  std::uint32_t dropped_far = 0;
  std::uint32_t dropped_body = 0;
  // The kept ones and the too near ones, by the side of the machine.
  std::uint32_t kept_by_quadrant[kQuadrants] = {};
  std::uint32_t near_by_quadrant[kQuadrants] = {};
  std::uint64_t kept_us = 0;  // sum of the kept ones' times since the scan began; 0 without skew to take out
};

// Of a scan whose motion was removed; 0: of none.
struct ScanTime {
  double whole_s = 0.0, mean_s = 0.0;  // of its kept points
};

// Memory of a cloud for the next one's leaf.
struct LeafMemory {
  static constexpr std::uint32_t kAnyFewer = 0xFFFFFFFFU;  // with it, whatever there are now is fewer

  std::uint32_t begin_with = 0;      // growths of the leaf to try first
  std::uint32_t voxels = kAnyFewer;  // their number with it when one growth less was last tried in vain
};

struct VoxelResult {
  IngestCounts counts;
  std::uint32_t returns = 0;  // points with a return
  LeafMemory leaf;
  double leaf_m = 0.0;
  std::uint64_t work = 0;
  bool fits = false;  // false: points fill the air, or points_max is far too small; there are no voxels then
  ScanTime scan;
};

}  // namespace pose_wall

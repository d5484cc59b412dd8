// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What no engine can do without: read every point, move it into base, drop what is too near or too far, and put what is
// left into a hash of voxels. Nothing else; a frame's cost is told as a multiple of it.

#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "lab/sim/simulator.hpp"

namespace pose_wall::bench {

class LeastPass {
 public:
  LeastPass() : keys_(kSlots) {}

  // Returns the number of voxels.
  std::uint32_t run(const tools::sim::Frame& frame) {
    constexpr float kRangeMin_m = 0.4F, kRangeMax_m = 15.0F, kCellsPerMetre = 20.0F;
    // Any turn and shift: what they are does not change the work.
    constexpr float kR[9] = {0.999F, -0.01F, 0.04F, 0.01F, 0.9995F, -0.02F, -0.04F, 0.02F, 0.999F};
    constexpr float kShift_m[3] = {0.1F, -0.2F, 0.3F};
    for (std::uint64_t& key : keys_) key = 0;
    std::uint32_t cells = 0;
    const float* p = frame.xyz_intensity.data();
    for (std::size_t i = 0; i < frame.count(); ++i, p += 4) {
      const float range2 = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
      if (!(range2 >= kRangeMin_m * kRangeMin_m && range2 <= kRangeMax_m * kRangeMax_m)) continue;
      std::uint64_t key = 0;
      for (int k = 0; k < 3; ++k) {
        const float base_m = kR[3 * k] * p[0] + kR[3 * k + 1] * p[1] + kR[3 * k + 2] * p[2] + kShift_m[k];
        const auto cell = static_cast<std::int32_t>(std::floor(base_m * kCellsPerMetre)) + (1 << 20);
        key = key << 21U | static_cast<std::uint64_t>(cell);
      }
      cells += insert(key) ? 1U : 0U;
    }
    return cells;
  }

 private:
  static constexpr std::uint32_t kSlotBits = 18;
  static constexpr std::uint32_t kSlots = 1U << kSlotBits;

  bool insert(std::uint64_t key) {
    std::uint64_t slot = key * 0x9E3779B97F4A7C15ULL >> (64U - kSlotBits);
    while (keys_[slot] != 0 && keys_[slot] != key) slot = (slot + 1) & (kSlots - 1);
    const bool is_new = keys_[slot] == 0;
    keys_[slot] = key;
    return is_new;
  }

  std::vector<std::uint64_t> keys_;  // 0: free
};

}  // namespace pose_wall::bench

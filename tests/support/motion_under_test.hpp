// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A motion on a block of its own, through the C ABI alone.

#pragma once

#include <stdexcept>

#include "pose_wall_motion.h"
#include "support/aligned_block.hpp"

namespace pose_wall::test {

inline pose_wall_motion_settings motion_settings() {
  pose_wall_motion_settings settings;
  pose_wall_motion_settings_init(&settings);
  return settings;
}

inline pose_wall_motion_result blank_motion_result() {
  pose_wall_motion_result result{};
  result.struct_size = sizeof result;
  return result;
}

class MotionUnderTest {
 public:
  explicit MotionUnderTest(const pose_wall_config& config, Dirt dirt = Dirt::kRandom,
                           const pose_wall_motion_settings& settings = motion_settings())
      : block_(pose_wall_motion_memory_needed(), dirt) {
    expect(pose_wall_motion_open(&config, &settings, block_.data(), block_.size(), &motion_));
  }

  pose_wall_motion_result process(const pose_wall_cloud& cloud) {
    pose_wall_motion_result result = blank_motion_result();
    expect(pose_wall_motion_process(motion_, &cloud, &result));
    return result;
  }
  void reset() { expect(pose_wall_motion_reset(motion_)); }
  pose_wall_motion* get() { return motion_; }
  AlignedBlock& block() { return block_; }

 private:
  static void expect(std::int32_t status) {
    if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
  }

  AlignedBlock block_;
  pose_wall_motion* motion_ = nullptr;
};

}  // namespace pose_wall::test

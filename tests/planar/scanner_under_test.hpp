// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A planar scanner in a block of its own, full of garbage.

#pragma once

#include <stdexcept>

#include "pose_wall_planar_scan.h"
#include "support/aligned_block.hpp"

namespace pose_wall::test {

inline void expect_ok(std::int32_t status) {
  if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_planar_status_text(status));
}

inline pose_wall_planar_scanner_settings scan_settings() {
  pose_wall_planar_scanner_settings settings;
  expect_ok(pose_wall_planar_scanner_settings_init(&settings));
  return settings;
}

// The sensor at the origin of base, this high above a level floor of certain tilt that is plane far enough.
inline pose_wall_planar_floor level_floor(double height_m = 1.5) {
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof(floor);
  floor.measured = 1;
  floor.normal[2] = 1.0;
  floor.height_m = height_m;
  floor.reach_m = 100.0;
  return floor;
}

inline std::uint64_t bytes_of(const pose_wall_planar_scanner_settings& settings) {
  std::uint64_t bytes = 0;
  expect_ok(pose_wall_planar_scanner_memory_needed(&settings, &bytes));
  return bytes;
}

class ScannerUnderTest {
 public:
  explicit ScannerUnderTest(const pose_wall_config& config,
                            const pose_wall_planar_scanner_settings& settings = scan_settings(),
                            Dirt dirt = Dirt::kRandom)
      : block_(bytes_of(settings), dirt) {
    scan_.struct_size = sizeof(scan_);
    view_.struct_size = sizeof(view_);
    expect_ok(pose_wall_planar_scanner_open(&config, &settings, block_.data(), block_.size(), &scanner_));
  }

  void process(const pose_wall_cloud& cloud, const pose_wall_planar_floor* floor) {
    expect_ok(pose_wall_planar_scanner_process(scanner_, &cloud, floor, &scan_, &view_));
  }

  pose_wall_planar_scanner* get() { return scanner_; }
  const pose_wall_planar_scan& scan() const { return scan_; }
  const pose_wall_planar_scan_view& view() const { return view_; }

  std::uint32_t beam_at(double angle_rad) const {
    const double steps = (angle_rad - scan_.angle_min_rad) / scan_.angle_step_rad;
    return static_cast<std::uint32_t>(steps + 0.5);
  }
  double angle_of(std::uint32_t beam) const { return scan_.angle_min_rad + beam * scan_.angle_step_rad; }

 private:
  AlignedBlock block_;
  pose_wall_planar_scanner* scanner_ = nullptr;
  pose_wall_planar_scan scan_{};
  pose_wall_planar_scan_view view_{};
};

}  // namespace pose_wall::test

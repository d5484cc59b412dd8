// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A cloud of the machine's sensor as a planar scan: the engine measures the floor, and the scanner takes the band of
// the machine's height.

#pragma once

#include <vector>

#include "lab/drive/machine.hpp"
#include "study/planar/part_block.hpp"

namespace pose_wall::tools {

// Of a simulated frame, as long as that lives and unchanged; a frame without returns has points that are none.
pose_wall_cloud cloud_of(const sim::Frame& frame, std::int64_t stamp_ns);

class DriveScanner {
 public:
  // Throws PlanarError.
  explicit DriveScanner(const sim::SensorModel& model);

  // Its arrays live until the next call. Where the engine has no floor that the scanner takes, the machine's own plane
  // stands for it. Throws PlanarError.
  const pose_wall_planar_scan& scan(const pose_wall_cloud& cloud);
  std::size_t floors() const { return floors_; }  // that the engine was asked for
  std::size_t own_planes() const { return own_planes_; }

 private:
  pose_wall_planar_floor floor_of(const pose_wall_cloud& cloud);

  api::Config config_;
  api::Engine engine_;
  PartBlock block_;
  pose_wall_planar_scanner* scanner_ = nullptr;
  pose_wall_planar_scan scan_{};
  std::size_t frames_ = 0, floors_ = 0, own_planes_ = 0;
  std::int64_t floor_ns_ = 0;
};

}  // namespace pose_wall::tools

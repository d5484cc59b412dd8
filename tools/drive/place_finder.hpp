// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Localisation in the map of a saved trail.

#pragma once

#include <string>

#include "planar/part_block.hpp"
#include "pose_wall_planar_localise.h"

namespace pose_wall::tools {

class PlaceFinder {
 public:
  // `trail` as pose_wall_planar_slam_save wrote it. Throws PlanarError.
  explicit PlaceFinder(const std::string& trail);

  const pose_wall_planar_localise_result& find(const pose_wall_planar_scan& scan,
                                               const pose_wall_planar_pose& odometry);
  const pose_wall_planar_localise_result& last() const { return result_; }

 private:
  PartBlock block_;
  pose_wall_planar_localise* localise_ = nullptr;
  pose_wall_planar_localise_result result_{};
};

// The larger standard deviation of the position; infinity without a pose.
double position_sigma_m(const pose_wall_planar_localise_result& where);

}  // namespace pose_wall::tools

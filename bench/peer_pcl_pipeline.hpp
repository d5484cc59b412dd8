// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The same pipeline from PCL's parts, as an engineer would put it together from its tutorials.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "peer_pcl_parts.hpp"

namespace pose_wall::bench {

struct PclReading {
  std::array<double, POSE_WALL_QUANTITIES> value;            // NaN where it found nothing
  std::array<std::int64_t, POSE_WALL_STAGES> stage_ns = {};  // processor time
};

// Points in the lidar frame, four floats each.
PclReading measure_with_pcl(const std::vector<float>& xyz_intensity_lidar, const PclSettings& settings,
                            PclMethod method);

}  // namespace pose_wall::bench

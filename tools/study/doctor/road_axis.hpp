// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which way the road runs through base: the engine's word on several directions, one against the other.

#pragma once

#include <limits>

#include "pose_wall.hpp"
#include "study/doctor/recording.hpp"

namespace pose_wall::tools::doctor {

struct RoadAxis {
  bool is_found = false;
  bool is_ambiguous = false;      // across is about as good: a room, a crossing
  double azimuth_base_rad = 0.0;  // of one of its two directions, the one nearer to +X or +Y
  double score = 0.0;             // 0 nothing, 1 both walls measured in every frame
  double rival_score = 0.0;       // of the best direction across
  double azimuth_spread_rad = 0.0, azimuth_sigma_rad = 0.0;
  // Medians of the walls' distances from the base origin, looking along the direction above; NaN: not seen.
  double left_m = std::numeric_limits<double>::quiet_NaN(), right_m = left_m;
  double distance_spread_m = 0.0, distance_sigma_m = 0.0;
  char line = 'X';            // of base, along which the road lies, X or Y
  double off_line_rad = 0.0;  // from that line to the road, about +Z
};

// `config` levels the floor; its forward_axis does not matter.
RoadAxis look_along_road(const api::Config& config, const std::vector<KeptFrame>& frames, std::size_t frames_max);

}  // namespace pose_wall::tools::doctor

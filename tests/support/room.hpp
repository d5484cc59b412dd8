// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A straight road as a small LiDAR sees it: every quantity is measured, in few enough points to do it thousands of
// times.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::test {

// Floor and both walls as a grid of points: enough for a result that is not all zeros.
inline Points road_grid() {
  Points points;
  for (int i = -80; i <= 80; ++i) {
    for (int j = 0; j < 25; ++j) {
      const float along = 0.1F * static_cast<float>(i), up = 0.1F * static_cast<float>(j) - 1.4F;
      points.push_back({along, 2.5F, up});
      points.push_back({along, -2.5F, up});
      points.push_back({along, 0.2F * static_cast<float>(j - 12), -1.4F});
    }
  }
  return points;
}

// Walls 2.5 m to both sides, floor 1.4 m below and roof 1.8 m above a sensor of 32 lines with 720 columns, its ranges
// off by up to 1 cm; another seed is another frame of the same road. The sensor may stand left of the middle.
inline Points room_points(std::uint32_t seed, double left_of_middle_m = 0.0) {
  constexpr int kLines = 32, kColumns = 720;
  std::mt19937 random(seed);
  Points points;
  for (int column = 0; column < kColumns; ++column) {
    const double azimuth = 2.0 * M_PI * column / kColumns;
    for (int line = 0; line < kLines; ++line) {
      const double elevation = (-31.0 + 2.0 * line) * M_PI / 180.0;
      const double x = std::cos(elevation) * std::cos(azimuth), y = std::cos(elevation) * std::sin(azimuth);
      const double z = std::sin(elevation);
      const double to_wall = (y > 0.0 ? 2.5 - left_of_middle_m : 2.5 + left_of_middle_m) / std::fabs(y);
      const double to_level = (z < 0.0 ? 1.4 : 1.8) / std::fabs(z);
      const double range = std::min(to_wall, to_level) + 1e-5 * (static_cast<double>(random() % 2001) - 1000.0);
      if (!(range < 30.0)) continue;
      points.push_back({static_cast<float>(range * x), static_cast<float>(range * y), static_cast<float>(range * z)});
    }
  }
  return points;
}

// The same with steel sets along both walls: strips 10 cm wide that stand 15 cm out of them, every metre.
inline Points ribbed_room_points(std::uint32_t seed) {
  constexpr float kFront = 2.35F / 2.5F, kNearWall_m = 2.45F, kHalfWidth_m = 0.05F;
  Points points = room_points(seed);
  for (auto& p : points) {
    if (!(std::fabs(p[1]) > kNearWall_m)) continue;
    const float at_front_m = p[0] * kFront;
    if (!(std::fabs(at_front_m - std::round(at_front_m)) <= kHalfWidth_m)) continue;
    for (float& c : p) c *= kFront;
  }
  return points;
}

inline pose_wall_config small_config() {
  pose_wall_config config = sparse_config();
  set(&config, "points_max", "20000");
  return config;
}

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Walls near by, by sensors whose light does not leave their origin. The nearer a wall, the further such an offset
// moves a ring on it. The same road is tried with all offsets at zero: what is valid there has to be valid with them.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::judge {

constexpr std::array<double, 5> kNearWalls_m = {1.0, 1.6, 2.0, 2.3, 3.0};      // from the sensor to the left wall
constexpr std::array<double, 5> kSensorHeights_m = {0.8, 1.1, 1.4, 1.7, 2.0};  // over the floor

struct NearWall {
  int sensor = 0;  // row of kSensorTable with a table of beams
  bool rough = false;
  double wall_m = 2.0, height_m = 1.4;
};

// Each sensor with a table of beams, flat and rough, each wall, each height.
std::vector<NearWall> every_near_wall();
std::vector<NearWall> near_walls_of(int sensor);

struct Lost {
  std::string text() const;

  NearWall where;
  std::vector<std::uint32_t> quantities;  // valid without offsets alone
  std::uint32_t reasons = 0;              // of the first of them
};

struct NearWalls {
  // A row for each sensor and surface, a column for each wall: on how many heights all seven values are valid with the
  // offsets, and without.
  std::string text() const;

  struct Tried {
    NearWall where;
    std::array<std::array<bool, POSE_WALL_QUANTITIES>, 2> valid;  // with offsets, without
  };
  std::vector<Tried> tried;
  std::vector<Lost> lost;
};

NearWalls try_near_walls(const std::vector<NearWall>& walls);

}  // namespace pose_wall::judge

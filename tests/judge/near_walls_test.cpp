// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: light that leaves a sensor a centimetre above or below its origin, or before its axis, costs no value where
// walls are near. Each value that is valid on the same road without these offsets is valid with them. `pose_wall_judge
// --near-walls` tries all sensors on all these roads; here the dense ones are tried on fewer.

#include "judge/near_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "judge/scanner.hpp"

namespace pose_wall::judge {
namespace {

void expect_nothing_lost(const std::vector<NearWall>& walls) {
  const NearWalls found = try_near_walls(walls);
  std::size_t valid = 0;
  for (const NearWalls::Tried& each : found.tried) {
    valid += static_cast<std::size_t>(std::count(each.valid[1].begin(), each.valid[1].end(), true));
  }
  EXPECT_GT(valid, walls.size() * POSE_WALL_QUANTITIES * 8 / 10) << "without offsets";
  // The two clouds of a rough road differ, so a rival may show in one and not in the other: one road of twenty.
  const auto rough = static_cast<std::size_t>(
      std::count_if(found.lost.begin(), found.lost.end(), [](const Lost& it) { return it.where.rough; }));
  EXPECT_EQ(found.lost.size() - rough, 0U) << "flat: " << found.text();
  EXPECT_LE(rough, walls.size() / 20) << found.text();
}

class NearWallsBySensor : public testing::TestWithParam<int> {};

std::string name_of(const testing::TestParamInfo<int>& row) {
  return sensor_at(row.param).name;
}

std::vector<int> rows_with_beams() {
  std::vector<int> rows;
  for (int row = 0; row < kAllSensors; ++row) {
    if (sensor_at(row).beams != nullptr) rows.push_back(row);
  }
  return rows;
}

INSTANTIATE_TEST_SUITE_P(Sensors, NearWallsBySensor, testing::ValuesIn(rows_with_beams()), name_of);

TEST_P(NearWallsBySensor, OffsetsOfTheLightCostNoValue) {
  constexpr int kFewRings = 16;
  std::vector<NearWall> walls = near_walls_of(GetParam());
  if (sensor_at(GetParam()).rings > kFewRings) {
    // The middle height, and the sensors' usual rock: a dense frame takes three times as long.
    const auto unusual = [](const NearWall& it) { return !it.rough || it.height_m != kSensorHeights_m[2]; };
    walls.erase(std::remove_if(walls.begin(), walls.end(), unusual), walls.end());
  }
  expect_nothing_lost(walls);
}

}  // namespace
}  // namespace pose_wall::judge

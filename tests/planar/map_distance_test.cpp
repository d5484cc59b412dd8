// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <gtest/gtest.h>

#include "opened_map.hpp"

namespace {

using pose_wall::Random;
using pose_wall::planar::GridMap;
using pose_wall::planar::kTileSide;
using namespace pose_wall::planar::test;

// A record with things drawn into it.
pose_wall_planar_tile drawn_tile(const OpenedMap& map, std::int32_t column, std::int32_t row, std::uint32_t things,
                                 Random* random) {
  pose_wall_planar_tile tile{};
  tile.struct_size = sizeof(tile);
  tile.column = column;
  tile.row = row;
  tile.cell_m = map.inner().settings().cell_m;
  tile.scans = 1;
  for (auto& cell : tile.cells) cell = static_cast<std::uint8_t>(random->below(3) == 0 ? 0 : 50);
  for (std::uint32_t k = 0; k < things; ++k) tile.cells[random->below(POSE_WALL_PLANAR_TILE_CELLS)] = 110;
  tile.crc32 = pose_wall::planar::crc_of(tile);
  return tile;
}

void put(const OpenedMap& map, const pose_wall_planar_tile& tile) {
  ASSERT_EQ(pose_wall_planar_map_put_tile(map.get(), &tile), POSE_WALL_OK);
}

TEST(MapDistance, IsThatOfASearchThroughAllThingsForEveryCapAndDensity) {
  Random random(7);
  for (const double cap_cells : {1.0, 2.0, 17.0, 40.0, 64.0, 65.0, 120.0}) {
    for (const std::uint32_t things : {0U, 1U, 5U, 300U}) {
      auto settings = map_settings();
      settings.cell_m = 0.05;
      settings.distance_cap_m = cap_cells * settings.cell_m;
      const OpenedMap map(settings);
      ASSERT_EQ(map.inner().distances().cap(), static_cast<std::int32_t>(cap_cells));
      // With a hole between them, so that the nearest thing lies beyond a tile that is not there.
      const std::int32_t places[][2] = {{0, 0}, {-1, 0}, {0, -1}, {-1, -1}, {1, 1}, {2, 0}, {-3, 1}};
      for (const auto& place : places) put(map, drawn_tile(map, place[0], place[1], things, &random));
      ASSERT_EQ(map.box().tiles_stale, 0U);
      expect_true_distances(map.inner(), things > 5 ? 7 : 3);
    }
  }
}

// Things come and go one by one: by beams of one scan each.
TEST(MapDistance, FollowsThingsThatComeAndGo) {
  Random random(11);
  auto settings = map_settings();
  settings.distance_cap_m = 1.0;
  const OpenedMap map(settings);
  GridMap& inner = map.inner();
  for (int round = 0; round < 60; ++round) {
    const float range = 0.3F + 0.01F * static_cast<float>(random.below(400));
    const double angle = 0.01 * random.below(628);
    const auto beam = pose_wall::planar::test::one_beam(range, angle);
    map.insert(beam->scan, {0.0, 0.0, 0.0});
    if (round % 10 == 9) expect_true_distances(inner, 5);
  }
  const auto before = map.box().things;
  EXPECT_GT(before, 20U);
  for (int round = 0; round < 6; ++round) {  // all things are seen through
    std::vector<float> open(2000, std::numeric_limits<float>::infinity());
    const pose_wall::planar::test::DrawnScan scan(std::move(open), 6.0);
    map.insert(scan.scan, {0.0, 0.0, 0.0});
    ASSERT_EQ(map.box().tiles_stale, 0U);
    expect_true_distances(inner, 5);
  }
  EXPECT_LT(map.box().things, before / 10);
}

TEST(MapDistance, QueriesAreExactBeforeAllIsRenewed) {
  Random random(13);
  auto settings = map_settings();
  settings.renewals = 0;
  const OpenedMap map(settings);
  for (std::int32_t k = 0; k < 4; ++k) put(map, drawn_tile(map, k % 2 - 1, k / 2 - 1, 40, &random));
  EXPECT_GT(map.box().tiles_stale, 0U);
  expect_true_distances(map.inner(), 3);
  std::uint32_t stale = map.box().tiles_stale;
  while (stale > 0) {  // each call renews as many as it is allowed
    const std::uint32_t before = stale;
    ASSERT_EQ(pose_wall_planar_map_renew(map.get(), 1, &stale), POSE_WALL_OK);
    ASSERT_EQ(stale, before - 1);
  }
  expect_true_distances(map.inner(), 3);
}

TEST(MapDistance, AnEvictedTileTakesItsThingsOutOfItsNeighbours) {
  Random random(17);
  auto settings = map_settings();
  settings.tiles = 5;
  const OpenedMap map(settings);
  const auto forget = [](void*, const pose_wall_planar_tile*) -> std::int32_t { return 0; };
  ASSERT_EQ(pose_wall_planar_map_on_save(map.get(), forget, nullptr), POSE_WALL_OK);
  for (int round = 0; round < 30; ++round) {
    const auto column = static_cast<std::int32_t>(random.below(4)) - 2;
    const auto row = static_cast<std::int32_t>(random.below(3)) - 1;
    put(map, drawn_tile(map, column, row, random.below(80), &random));
    ASSERT_EQ(map.box().tiles_stale, 0U);
    expect_true_distances(map.inner(), 5);
  }
  EXPECT_EQ(map.box().tiles, 5U);
}

TEST(MapDistance, WithoutACapThereAreNoDistancesAndAThirdOfTheMemory) {
  auto settings = map_settings();
  std::uint64_t with = 0, without = 0;
  ASSERT_EQ(pose_wall_planar_map_memory_needed(&settings, &with), POSE_WALL_OK);
  settings.distance_cap_m = 0.0;
  ASSERT_EQ(pose_wall_planar_map_memory_needed(&settings, &without), POSE_WALL_OK);
  EXPECT_LT(without, with / 2);
  const OpenedMap map(settings);
  const auto beam = pose_wall::planar::test::one_beam(3.0F);
  EXPECT_EQ(map.insert(beam->scan, {0.0, 0.0, 0.0}).things_new, 1U);
  EXPECT_TRUE(std::isnan(map.cell(0.0, 0.0).distance_m));
}

TEST(MapDistance, ADistanceIsInMetresFromMiddleToMiddle) {
  const OpenedMap map;
  const auto beam = pose_wall::planar::test::one_beam(1.02F);
  map.insert(beam->scan, {0.0, 0.01, 0.0});
  EXPECT_NEAR(map.cell(1.02, 0.01).distance_m, 0.0, 1e-12);
  EXPECT_NEAR(map.cell(0.52, 0.01).distance_m, 0.5, 1e-9);
  EXPECT_NEAR(map.cell(1.02 + 0.3, 0.01 + 0.4).distance_m, 0.5, 1e-9);
  EXPECT_NEAR(map.cell(10.0, 10.0).distance_m, 2.0, 1e-9);  // where no tile is
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Full maps, callbacks that refuse or come back, far places, and arguments that are none.

#include <gtest/gtest.h>

#include <map>

#include "opened_map.hpp"

namespace {

using pose_wall::kPi;
using pose_wall::Random;
using namespace pose_wall::planar::test;

// Keeps what it is given, until it refuses.
struct Shelf {
  std::vector<pose_wall_planar_tile> tiles;
  std::uint32_t calls = 0, room = 1000000;
  const pose_wall_planar_map* calls_back = nullptr;
  std::vector<std::int32_t> answers;
};

std::int32_t keep(void* context, const pose_wall_planar_tile* tile) {
  Shelf& shelf = *static_cast<Shelf*>(context);
  ++shelf.calls;
  if (shelf.calls_back != nullptr) {
    auto* const map = const_cast<pose_wall_planar_map*>(shelf.calls_back);
    pose_wall_planar_cell cell{};
    cell.struct_size = sizeof(cell);
    shelf.answers.push_back(pose_wall_planar_map_cell(map, 0.0, 0.0, &cell));
    shelf.answers.push_back(pose_wall_planar_map_put_tile(map, tile));
    shelf.answers.push_back(pose_wall_planar_map_clear(map));
  }
  if (shelf.tiles.size() >= shelf.room) return 1;
  EXPECT_EQ(tile->crc32, pose_wall::planar::crc_of(*tile));
  shelf.tiles.push_back(*tile);
  return 0;
}

void put_on(const OpenedMap& map, Shelf* shelf) {
  ASSERT_EQ(pose_wall_planar_map_on_save(map.get(), keep, shelf), POSE_WALL_OK);
}

std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::uint8_t>> cells_of(const OpenedMap& map) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::uint8_t>> cells;
  pose_wall_planar_tile tile{};
  tile.struct_size = sizeof(tile);
  for (std::uint32_t k = 0; k < map.box().tiles; ++k) {
    EXPECT_EQ(pose_wall_planar_map_get_tile(map.get(), k, &tile), POSE_WALL_OK);
    cells[{tile.row, tile.column}].assign(std::begin(tile.cells), std::end(tile.cells));
  }
  return cells;
}

TEST(MapLimits, AMapOfOneTileKeepsItAndSaysWhatItCouldNotStore) {
  auto settings = map_settings();
  settings.tiles = 1;
  const OpenedMap map(settings);
  const auto report = map.insert(one_beam(5.0F)->scan, {0.01, 0.01, 0.0});
  EXPECT_EQ(report.tiles, 1U);
  EXPECT_EQ(report.saves_refused, 1U);
  EXPECT_EQ(report.beams_not_stored, 1U);
  EXPECT_EQ(report.things_new, 1U);  // the thing's tile came first
  EXPECT_EQ(map.state(5.01, 0.01), std::uint32_t{POSE_WALL_PLANAR_CELL_THING});
  EXPECT_TRUE(std::isnan(map.cell(1.0, 0.01).probability));  // nothing of the rest
  expect_true_distances(map.inner());
}

TEST(MapLimits, AMapOfOneTileGivesItAwayForTheNextScan) {
  auto settings = map_settings();
  settings.tiles = 1;
  const OpenedMap map(settings);
  Shelf shelf;
  put_on(map, &shelf);
  map.insert(one_beam(1.0F)->scan, {0.01, 0.01, 0.0});
  const auto report = map.insert(one_beam(1.0F)->scan, {10.01, 0.01, 0.0});
  EXPECT_EQ(report.tiles_saved, 1U);
  EXPECT_EQ(report.tiles, 1U);
  ASSERT_EQ(shelf.tiles.size(), 1U);
  EXPECT_EQ(shelf.tiles[0].column, 0);
  EXPECT_EQ(shelf.tiles[0].scans, 1U);
  EXPECT_EQ(report.saves_refused, 0U);
  EXPECT_TRUE(std::isnan(map.cell(0.5, 0.01).probability));
  expect_true_distances(map.inner());
}

TEST(MapLimits, NothingIsLostWhateverTheCapacity) {
  Random random(1);
  const auto road = rough_road(60.0, 5.0, 0.2, 6);
  std::vector<std::unique_ptr<DrawnScan>> scans;
  std::vector<pose_wall_planar_pose> poses;
  for (double x = 1.0; x < 59.0; x += 0.5) {
    poses.push_back({x - 30.0, 0.1, 0.0});  // across the origin, so that coordinates change sign
    scans.push_back(drawn_scan(road, {x, 0.1, 0.0}, 360, 0.01, &random, 8.0));
  }
  auto settings = map_settings();
  settings.least_probability = 0.03;  // sums that are cut off at these depend on how evidence was split
  settings.most_probability = 0.98;
  settings.tiles = 512;
  const OpenedMap whole(settings);
  for (std::size_t k = 0; k < scans.size(); ++k) whole.insert(scans[k]->scan, poses[k]);
  for (const std::uint32_t eviction : {0U, 1U}) {
    settings.tiles = 28;
    settings.eviction = eviction;
    const OpenedMap map(settings);
    Shelf shelf;
    put_on(map, &shelf);
    for (std::size_t k = 0; k < scans.size(); ++k) {
      const auto report = map.insert(scans[k]->scan, poses[k]);
      ASSERT_EQ(report.beams_not_stored, 0U);
      ASSERT_LE(report.tiles, 28U);
    }
    EXPECT_GT(shelf.tiles.size(), 20U);
    expect_true_distances(map.inner(), 11);
    // The saved tiles and the held ones are the map of the large one.
    settings.tiles = 512;
    const OpenedMap again(settings);
    for (const auto& tile : shelf.tiles) ASSERT_EQ(pose_wall_planar_map_put_tile(again.get(), &tile), POSE_WALL_OK);
    pose_wall_planar_tile tile{};
    tile.struct_size = sizeof(tile);
    for (std::uint32_t k = 0; k < map.box().tiles; ++k) {
      ASSERT_EQ(pose_wall_planar_map_get_tile(map.get(), k, &tile), POSE_WALL_OK);
      ASSERT_EQ(pose_wall_planar_map_put_tile(again.get(), &tile), POSE_WALL_OK);
    }
    EXPECT_EQ(cells_of(again).size(), cells_of(whole).size());
    EXPECT_EQ(again.box().cells_seen, whole.box().cells_seen);
    expect_true_distances(again.inner(), 11);
  }
}

TEST(MapLimits, TheOldestGoesOrTheFarthest) {
  for (const std::uint32_t eviction : {0U, 1U}) {
    auto settings = map_settings();
    settings.tiles = 3;
    settings.eviction = eviction;
    const OpenedMap map(settings);
    Shelf shelf;
    put_on(map, &shelf);
    for (const double x : {100.0, 0.0, -20.0, 10.0}) map.insert(one_beam(0.5F)->scan, {x + 0.01, 0.01, 0.0});
    map.insert(one_beam(0.5F)->scan, {0.01, 0.01, 0.0});  // seen again: no longer the oldest
    map.insert(one_beam(0.5F)->scan, {5.01, 0.01, 0.0});
    ASSERT_EQ(shelf.tiles.size(), 2U);
    EXPECT_EQ(shelf.tiles[0].column, 31);  // 100 m
    EXPECT_EQ(shelf.tiles[1].column, -7);  // -20 m: both rules
    map.insert(one_beam(0.5F)->scan, {-3.01, 0.01, 0.0});
    EXPECT_EQ(shelf.tiles[2].column, 3) << eviction;      // 10 m: oldest and farthest
    map.insert(one_beam(0.5F)->scan, {4.9, 0.01, 0.0});   // in the tile at 5 m
    map.insert(one_beam(0.5F)->scan, {14.0, 0.01, 0.0});  // the oldest is that at 0, the farthest that at -3
    EXPECT_EQ(shelf.tiles[3].column, eviction == 0 ? 0 : -1);
  }
}

TEST(MapLimits, ARefusedSaveKeepsTheTileAsksOnceAndSaysSo) {
  auto settings = map_settings();
  settings.tiles = 4;
  const OpenedMap map(settings);
  Shelf shelf;
  shelf.room = 1;
  put_on(map, &shelf);
  std::vector<float> open(16, std::numeric_limits<float>::infinity());
  const DrawnScan scan(std::move(open), 1.0);
  map.insert(scan.scan, {0.01, 0.01, 0.0});  // fills four tiles
  ASSERT_EQ(map.box().tiles, 4U);
  const auto before = cells_of(map);
  const auto first = map.insert(one_beam(0.5F)->scan, {50.0, 0.01, 0.0});
  EXPECT_EQ(first.tiles_saved, 1U);
  EXPECT_EQ(first.saves_refused, 0U);
  const std::uint32_t calls = shelf.calls;
  std::vector<float> wide(100, std::numeric_limits<float>::infinity());
  const DrawnScan far(std::move(wide), 20.0);
  const auto second = map.insert(far.scan, {500.0, 0.01, 0.0});
  EXPECT_EQ(second.saves_refused, 1U);
  EXPECT_EQ(second.beams_not_stored, 100U);
  EXPECT_EQ(second.tiles, 4U);
  EXPECT_EQ(shelf.calls, calls + 1);
  std::uint32_t kept = 0;
  for (const auto& tile : cells_of(map)) kept += before.count(tile.first) != 0 ? 1U : 0U;
  EXPECT_EQ(kept, 3U);
  // put_tile is refused likewise, and changes nothing.
  const auto bytes = map.saved();
  pose_wall_planar_tile tile = shelf.tiles[0];
  EXPECT_EQ(pose_wall_planar_map_put_tile(map.get(), &tile), POSE_WALL_E_BUFFER_SMALL);
  EXPECT_EQ(map.saved(), bytes);
  expect_true_distances(map.inner(), 3);
}

TEST(MapLimits, ACallFromTheCallbackIsRefusedAndHarmsNothing) {
  auto settings = map_settings();
  settings.tiles = 1;
  const OpenedMap map(settings);
  Shelf shelf;
  shelf.calls_back = map.get();
  put_on(map, &shelf);
  map.insert(one_beam(0.5F)->scan, {0.01, 0.01, 0.0});
  map.insert(one_beam(0.5F)->scan, {9.01, 0.01, 0.0});
  ASSERT_EQ(shelf.answers.size(), 3U);
  for (const std::int32_t answer : shelf.answers) EXPECT_EQ(answer, POSE_WALL_E_BUSY);
  EXPECT_EQ(map.box().tiles, 1U);
}

TEST(MapLimits, FarPlacesAreAsGoodAsNearOnes) {
  const double reach = POSE_WALL_PLANAR_MAP_REACH_M;
  for (const double cell_m : {0.02, 0.05, 0.5}) {
    auto settings = map_settings();
    settings.cell_m = cell_m;
    settings.distance_cap_m = 20 * cell_m;
    settings.beam_max_m = 200.0;
    settings.tiles = 512;
    for (const double x : {-reach, reach, 0.0}) {
      for (const double y : {-reach, reach}) {
        const OpenedMap map(settings);
        Random random(2);
        std::vector<float> ranges(90);
        for (auto& range : ranges) range = 1.0F + 0.01F * static_cast<float>(random.below(2000));
        const DrawnScan scan(std::move(ranges), 300.0);
        map.insert(scan.scan, {x, y, 1.0});
        EXPECT_GT(map.box().things, 20U);
        expect_true_distances(map.inner(), 17);
        const auto bytes = map.saved();
        EXPECT_EQ(map.load(bytes), POSE_WALL_OK);
        EXPECT_EQ(map.saved(), bytes);
      }
    }
  }
}

TEST(MapLimits, PosesAndPlacesThatAreNoneAreRefusedWithoutAChange) {
  const OpenedMap map;
  map.insert(one_beam(2.0F)->scan, {0.01, 0.01, 0.0});
  const auto before = map.saved();
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  pose_wall_planar_map_report report{};
  report.struct_size = sizeof(report);
  report.tiles = 77;
  const auto beam = one_beam(2.0F);
  for (const double bad : {nan, infinite, -infinite, 100000.1, -1e300}) {
    for (int member = 0; member < 3; ++member) {
      pose_wall_planar_pose pose{0.0, 0.0, 0.0};
      (member == 0 ? pose.x_m : member == 1 ? pose.y_m : pose.yaw_rad) = bad;
      EXPECT_EQ(pose_wall_planar_map_insert(map.get(), &beam->scan, &pose, &report), POSE_WALL_PLANAR_E_POSE) << bad;
      pose_wall_planar_ray ray{};
      ray.struct_size = sizeof(ray);
      EXPECT_EQ(pose_wall_planar_map_ray(map.get(), &pose, 0.0, 1.0, 0, &ray), POSE_WALL_PLANAR_E_POSE);
    }
    pose_wall_planar_cell cell{};
    cell.struct_size = sizeof(cell);
    EXPECT_EQ(pose_wall_planar_map_cell(map.get(), bad, 0.0, &cell), POSE_WALL_PLANAR_E_POSE);
    EXPECT_EQ(pose_wall_planar_map_cell(map.get(), 0.0, bad, &cell), POSE_WALL_PLANAR_E_POSE);
  }
  EXPECT_EQ(report.tiles, 77U);
  beam->scan.sigma_m = nan;
  const pose_wall_planar_pose pose{0.0, 0.0, 0.0};
  EXPECT_EQ(pose_wall_planar_map_insert(map.get(), &beam->scan, &pose, &report), POSE_WALL_PLANAR_E_SCAN);
  report.struct_size = 4;
  EXPECT_EQ(pose_wall_planar_map_insert(map.get(), &one_beam(2.0F)->scan, &pose, &report), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(map.saved(), before);
}

TEST(MapLimits, BlocksAndPointersThatAreNoneAreRefused) {
  const auto settings = map_settings();
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_planar_map_memory_needed(&settings, &bytes), POSE_WALL_OK);
  std::vector<unsigned char> room(bytes + 128, 0xA5);
  unsigned char* aligned = room.data();
  while (reinterpret_cast<std::uintptr_t>(aligned) % POSE_WALL_BLOCK_ALIGNMENT != 0) ++aligned;
  pose_wall_planar_map* map = nullptr;
  EXPECT_EQ(pose_wall_planar_map_open(&settings, nullptr, bytes, &map), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_map_open(&settings, aligned + 8, bytes, &map), POSE_WALL_E_BLOCK_ALIGN);
  EXPECT_EQ(pose_wall_planar_map_open(&settings, aligned, bytes - 1, &map), POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(map, nullptr);
  auto* const garbage = reinterpret_cast<pose_wall_planar_map*>(aligned);
  EXPECT_EQ(pose_wall_planar_map_clear(garbage), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_planar_map_clear(nullptr), POSE_WALL_E_NULL);
  ASSERT_EQ(pose_wall_planar_map_open(&settings, aligned, bytes, &map), POSE_WALL_OK);
  std::uint32_t stale = 9;
  EXPECT_EQ(pose_wall_planar_map_renew(map, 100, &stale), POSE_WALL_OK);
  EXPECT_EQ(stale, 0U);
  // Its last byte is its own, and nothing behind it.
  for (unsigned char* at = aligned + bytes; at < room.data() + room.size(); ++at) EXPECT_EQ(*at, 0xA5);
}

// Random scans, poses and calls: never a mark left, a wrong distance, or a tile too many.
TEST(MapLimits, AnyMixOfCallsKeepsTheMapWhole) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    auto settings = map_settings();
    settings.tiles = 1 + random.below(20);
    settings.eviction = random.below(2);
    settings.renewals = random.below(3) == 0 ? 1 : 64;
    settings.cell_m = 0.02 * (1 + random.below(10));
    settings.distance_cap_m = (1 + random.below(100)) * settings.cell_m;
    const OpenedMap map(settings);
    Shelf shelf;
    shelf.room = random.below(40);
    if (random.below(4) != 0) put_on(map, &shelf);
    for (int round = 0; round < 25; ++round) {
      std::vector<float> ranges(1 + random.below(300));
      for (auto& range : ranges) {
        range = random.below(8) == 0 ? std::numeric_limits<float>::infinity()
                                     : 0.001F * static_cast<float>(random.below(9000)) - 0.1F;
      }
      const DrawnScan scan(std::move(ranges), 8.0);
      const double x = 0.1 * random.below(100) - 5.0, y = 0.1 * random.below(60) - 3.0;
      const auto report = map.insert(scan.scan, {x, y, 0.01 * random.below(1000)});
      ASSERT_LE(report.tiles, settings.tiles);
      ASSERT_EQ(report.beams_not_stored != 0, report.saves_refused != 0);
      if (random.below(5) == 0 && !shelf.tiles.empty()) {
        const std::int32_t status = pose_wall_planar_map_put_tile(map.get(), &shelf.tiles.back());
        ASSERT_TRUE(status == POSE_WALL_OK || status == POSE_WALL_E_BUFFER_SMALL);
      }
      if (round % 8 == 7) expect_true_distances(map.inner(), 13);
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace

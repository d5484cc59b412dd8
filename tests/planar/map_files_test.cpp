// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Maps saved and loaded, and what is left of them after damage. Rays and grids of what was loaded.

#include <gtest/gtest.h>

#include <string>

#include "base/math/crc32.hpp"
#include "opened_map.hpp"

namespace {

using pose_wall::kPi;
using pose_wall::Random;
using namespace pose_wall::planar::test;

void drive(const OpenedMap& map, double from_x, double to_x) {
  Random random(44);
  const auto road = rough_road(16.0, 5.0, 0.2, 8);
  for (double x = from_x; x < to_x; x += 0.25) {
    map.insert(drawn_scan(road, {x, 0.0, 0.0}, 720, 0.01, &random, 12.0)->scan, {x, 0.0, 0.0});
  }
}

TEST(MapFiles, AMapComesBackAsItWas) {
  const OpenedMap map;
  drive(map, 2.0, 14.0);
  const auto bytes = map.saved();
  const OpenedMap other;
  other.insert(one_beam(3.0F)->scan, {900.0, 0.0, 0.0});  // is forgotten
  ASSERT_EQ(other.load(bytes), POSE_WALL_OK);
  EXPECT_EQ(other.saved(), bytes);
  EXPECT_EQ(other.box().things, map.box().things);
  EXPECT_EQ(other.box().tiles_stale, 0U);
  expect_true_distances(other.inner(), 3);
  // And goes on as the first would.
  drive(map, 4.0, 5.0);
  drive(other, 4.0, 5.0);
  EXPECT_EQ(other.saved().size(), map.saved().size());
  EXPECT_EQ(other.saved(), map.saved());
}

TEST(MapFiles, TheBytesAreWrittenDownOnce) {
  const OpenedMap map;
  map.insert(one_beam(0.52F)->scan, {0.01, 0.01, 0.0});
  const auto bytes = map.saved();
  ASSERT_EQ(bytes.size(), 48U + 4120U);
  const unsigned char head[] = {'P', 'W', 'P', 'L', 'M',  'A',  'P', '\n', 1, 0, 0, 0,
                                1,   0,   0,   0,   0x48, 0x10, 0,   0,    0, 0, 0, 0};
  EXPECT_EQ(std::memcmp(bytes.data(), head, sizeof(head)), 0);
  EXPECT_EQ(bytes[40 + 24 + 10], 78);  // the thing: 64 + 14 steps of 1/16
  EXPECT_EQ(bytes[40 + 24 + 3], 58);   // free by one beam: 64 - 6
}

TEST(MapFiles, TheSumIsThatOfTheStandard) {
  pose_wall::BulkCrc32 fast;
  pose_wall::Crc32 plain;
  for (const char sign : std::string("123456789")) fast.add_byte(static_cast<std::uint8_t>(sign));
  EXPECT_EQ(fast.value(), 0xCBF43926U);  // the check value of CRC-32
  for (const char sign : std::string("123456789")) plain.add_byte(static_cast<std::uint8_t>(sign));
  plain.add_word(0x01020304U);
  fast.add_number(0x01020304U, 4);
  EXPECT_EQ(fast.value(), plain.value());
}

TEST(MapFiles, AnyBitThatFlipsAndAnyCutIsRefusedWithoutAChange) {
  const OpenedMap map;
  map.insert(one_beam(4.0F)->scan, {0.01, 0.01, 0.0});
  const auto good = map.saved();
  const OpenedMap other;
  other.insert(one_beam(2.0F)->scan, {7.0, 1.0, 1.0});
  const auto before = other.saved();
  Random random(3);
  for (std::uint32_t k = 0; k < 3000; ++k) {
    auto bad = good;
    const std::uint32_t bit =
        k < 8 * 64 ? k : random.below(static_cast<std::uint32_t>(8 * bad.size()));  // the head in full
    bad[bit / 8] = static_cast<unsigned char>(bad[bit / 8] ^ (1U << bit % 8));
    ASSERT_EQ(other.load(bad), POSE_WALL_PLANAR_E_MAP_FILE) << bit;
  }
  for (std::size_t size = 1; size < good.size(); size += size < 100 ? 1 : 57) {
    ASSERT_EQ(other.load({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}),
              POSE_WALL_PLANAR_E_MAP_FILE);
  }
  auto longer = good;
  longer.push_back(0);
  EXPECT_EQ(other.load(longer), POSE_WALL_PLANAR_E_MAP_FILE);
  EXPECT_EQ(other.saved(), before);
  EXPECT_EQ(other.load(good), POSE_WALL_OK);
}

// Damage whose CRC is right: written by somebody, not by this library.
TEST(MapFiles, AWrongTileWithARightSumIsRefused) {
  const OpenedMap map;
  map.insert(one_beam(4.0F)->scan, {0.01, 0.01, 0.0});
  const auto good = map.saved();
  ASSERT_EQ(map.box().tiles, 2U);
  const auto with = [&](auto change) {
    auto bad = good;
    change(bad);
    pose_wall::Crc32 crc;
    for (std::size_t k = 0; k < bad.size() - 8; ++k) crc.add_byte(bad[k]);
    for (std::size_t k = 0; k < 4; ++k) {
      bad[bad.size() - 8 + k] = static_cast<unsigned char>(crc.value() >> (8 * k) & 0xFFU);
    }
    return map.load(bad);
  };
  constexpr std::size_t kFirst = 40, kSecond = 40 + 4120;
  EXPECT_EQ(with([](auto&) {}), POSE_WALL_OK);
  EXPECT_EQ(with([](auto& b) { b[8] = 2; }), POSE_WALL_PLANAR_E_MAP_FILE);                     // version
  EXPECT_EQ(with([](auto& b) { b[24] = 1; }), POSE_WALL_PLANAR_E_MAP_FILE);                    // cell size
  EXPECT_EQ(with([](auto& b) { b[kSecond] = 0; }), POSE_WALL_PLANAR_E_MAP_FILE);               // the same tile twice
  EXPECT_EQ(with([](auto& b) { b[kFirst + 4] = 1; }), POSE_WALL_PLANAR_E_MAP_FILE);            // out of order
  EXPECT_EQ(with([](auto& b) { b[kSecond + 3] = 0x10; }), POSE_WALL_PLANAR_E_MAP_FILE);        // out of reach
  EXPECT_EQ(with([](auto& b) { b[kSecond + 24 + 99] = 0x80; }), POSE_WALL_PLANAR_E_MAP_FILE);  // a cell with the mark
  EXPECT_EQ(map.saved(), good);
  auto settings = map_settings();
  settings.tiles = 1;
  const OpenedMap small(settings);
  EXPECT_EQ(small.load(good), POSE_WALL_E_BUFFER_SMALL);
  settings.tiles = 2;
  settings.cell_m = 0.1;
  EXPECT_EQ(OpenedMap(settings).load(good), POSE_WALL_PLANAR_E_MAP_FILE);
}

TEST(MapFiles, ATileWithAWrongSumIsRefused) {
  const OpenedMap map;
  map.insert(one_beam(2.0F)->scan, {0.01, 0.01, 0.0});
  pose_wall_planar_tile tile{};
  tile.struct_size = sizeof(tile);
  ASSERT_EQ(pose_wall_planar_map_get_tile(map.get(), 0, &tile), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_planar_map_get_tile(map.get(), 1, &tile), POSE_WALL_E_INDEX);
  const OpenedMap other;
  const auto empty = other.saved();
  const auto with = [&](auto change) {
    pose_wall_planar_tile bad = tile;
    change(bad);
    return pose_wall_planar_map_put_tile(other.get(), &bad);
  };
  EXPECT_EQ(with([](auto& t) { t.cells[77] ^= 1; }), POSE_WALL_PLANAR_E_MAP_FILE);
  EXPECT_EQ(with([](auto& t) { t.column = 1; }), POSE_WALL_PLANAR_E_MAP_FILE);
  EXPECT_EQ(with([](auto& t) { t.stamp_ns = 1; }), POSE_WALL_PLANAR_E_MAP_FILE);
  EXPECT_EQ(with([](auto& t) { t.struct_size = 8; }), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(with([](auto& t) { t.cell_m = std::nan(""), t.crc32 = pose_wall::planar::crc_of(t); }),
            POSE_WALL_PLANAR_E_MAP_FILE);
  EXPECT_EQ(with([](auto& t) { t.row = 2000000000, t.crc32 = pose_wall::planar::crc_of(t); }),
            POSE_WALL_PLANAR_E_MAP_FILE);
  EXPECT_EQ(other.saved(), empty);
  EXPECT_EQ(with([](auto&) {}), POSE_WALL_OK);
  EXPECT_EQ(other.saved(), map.saved());
  // Put back onto itself the evidence counts twice, as the header says.
  EXPECT_EQ(with([](auto&) {}), POSE_WALL_OK);
  EXPECT_GT(other.cell(2.01, 0.01).probability, map.cell(2.01, 0.01).probability);
}

TEST(MapFiles, RaysMeetWhatTheBeamsMet) {
  const OpenedMap map;
  drive(map, 2.0, 14.0);
  const auto road = rough_road(16.0, 5.0, 0.2, 8);
  pose_wall_planar_ray ray{};
  ray.struct_size = sizeof(ray);
  double sum = 0.0;
  int rays = 0;
  for (double angle = 0.0; angle < 6.28; angle += 0.05) {
    const double truth = range_to(road, 8.0, 0.1, angle + 0.3);
    const pose_wall_planar_pose pose{8.0, 0.1, 0.3};
    ASSERT_EQ(pose_wall_planar_map_ray(map.get(), &pose, angle, 20.0, 1, &ray), POSE_WALL_OK);
    if (truth > 5.0) continue;
    EXPECT_EQ(ray.end, std::uint32_t{POSE_WALL_PLANAR_RAY_THING}) << angle;
    EXPECT_NEAR(ray.range_m, truth, 0.3) << angle;
    sum += ray.range_m - truth;
    ++rays;
  }
  EXPECT_GT(rays, 80);
  EXPECT_NEAR(sum / rays, 0.0, 0.03);
  const pose_wall_planar_pose outside{-50.0, 0.0, 0.0};
  ASSERT_EQ(pose_wall_planar_map_ray(map.get(), &outside, 0.0, 10.0, 0, &ray), POSE_WALL_OK);
  EXPECT_EQ(ray.end, std::uint32_t{POSE_WALL_PLANAR_RAY_UNKNOWN});
  EXPECT_NEAR(ray.range_m, 0.0, 0.05);
  ASSERT_EQ(pose_wall_planar_map_ray(map.get(), &outside, 0.0, 10.0, 1, &ray), POSE_WALL_OK);
  EXPECT_EQ(ray.end, std::uint32_t{POSE_WALL_PLANAR_RAY_OPEN});
  EXPECT_EQ(ray.range_m, 10.0);
  for (const double range_m : {-0.1, 1000.1, std::nan("")}) {
    EXPECT_EQ(pose_wall_planar_map_ray(map.get(), &outside, 0.0, range_m, 0, &ray), POSE_WALL_E_VALUE_RANGE);
  }
}

TEST(MapFiles, RaysAlongAnAxisEndWhereTheThingIs) {
  const OpenedMap map;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int k = 0; k < 2; ++k) map.insert(one_beam(1.025F)->scan, {0.025, 0.025, quarter * kPi / 2.0});
  }
  for (int quarter = 0; quarter < 4; ++quarter) {
    pose_wall_planar_ray ray{};
    ray.struct_size = sizeof(ray);
    const pose_wall_planar_pose pose{0.025, 0.025, 0.0};
    ASSERT_EQ(pose_wall_planar_map_ray(map.get(), &pose, quarter * kPi / 2.0, 5.0, 1, &ray), POSE_WALL_OK);
    EXPECT_EQ(ray.end, std::uint32_t{POSE_WALL_PLANAR_RAY_THING});
    EXPECT_NEAR(ray.range_m, 1.0, 0.0501);
    ASSERT_EQ(pose_wall_planar_map_ray(map.get(), &pose, quarter * kPi / 2.0, 0.9, 0, &ray), POSE_WALL_OK);
    EXPECT_EQ(ray.end, std::uint32_t{POSE_WALL_PLANAR_RAY_OPEN});
  }
}

TEST(MapFiles, AGridHasTheCellsOfTheMapAndUnknownElsewhere) {
  const OpenedMap map;
  drive(map, 4.0, 8.0);
  constexpr std::uint32_t kWidth = 300, kHeight = 170;
  std::vector<std::int8_t> cells(kWidth * kHeight + 1, 99);
  pose_wall_planar_grid grid{};
  grid.struct_size = sizeof(grid);
  ASSERT_EQ(pose_wall_planar_map_grid(map.get(), -1.23, -4.01, kWidth, kHeight, cells.data(), cells.size(), &grid),
            POSE_WALL_OK);
  EXPECT_EQ(cells.back(), 99);
  EXPECT_NEAR(grid.origin_x_m, -1.25, 1e-9);
  EXPECT_NEAR(grid.origin_y_m, -4.05, 1e-9);
  EXPECT_EQ(grid.cells, cells.data());
  std::uint32_t unknown = 0;
  for (std::uint32_t row = 0; row < kHeight; ++row) {
    for (std::uint32_t column = 0; column < kWidth; ++column) {
      const auto cell = map.cell(grid.origin_x_m + (column + 0.5) * grid.resolution_m,
                                 grid.origin_y_m + (row + 0.5) * grid.resolution_m);
      const int value = cells[row * kWidth + column];
      unknown += value == POSE_WALL_PLANAR_UNKNOWN ? 1U : 0U;
      if (std::isnan(cell.probability)) {
        ASSERT_EQ(value, POSE_WALL_PLANAR_UNKNOWN);
      } else {
        ASSERT_NEAR(value, 100.0 * cell.probability, 0.5001);
      }
    }
  }
  EXPECT_GT(unknown, 1000U);
  EXPECT_LT(unknown, kWidth * kHeight);
  const auto with = [&](std::uint32_t width, std::uint32_t height, std::uint64_t capacity) {
    return pose_wall_planar_map_grid(map.get(), 0.0, 0.0, width, height, cells.data(), capacity, &grid);
  };
  EXPECT_EQ(with(0, 1, 100), POSE_WALL_PLANAR_E_GRID);
  EXPECT_EQ(with(1, 0, 100), POSE_WALL_PLANAR_E_GRID);
  EXPECT_EQ(with(40000, 1, 50000), POSE_WALL_PLANAR_E_GRID);
  EXPECT_EQ(with(10, 10, 99), POSE_WALL_E_BUFFER_SMALL);
}

TEST(MapFiles, TheBoxIsThatOfAllCellsSeen) {
  const OpenedMap map;
  EXPECT_TRUE(std::isnan(map.box().x_min_m));
  map.insert(one_beam(3.04F)->scan, {-2.03, 0.01, 0.0});
  EXPECT_NEAR(map.box().x_min_m, -2.05, 1e-9);
  EXPECT_NEAR(map.box().x_max_m, 1.05, 1e-9);
  EXPECT_NEAR(map.box().y_min_m, 0.0, 1e-9);
  EXPECT_NEAR(map.box().y_max_m, 0.05, 1e-9);
  EXPECT_EQ(map.box().things, 1U);
  ASSERT_EQ(pose_wall_planar_map_clear(map.get()), POSE_WALL_OK);
  EXPECT_EQ(map.box().cells_seen, 0U);
  EXPECT_EQ(map.box().tiles, 0U);
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/footprint.hpp"

#include <gtest/gtest.h>

#include <random>

#include "drawn_roads.hpp"
#include "planar/route/bit_grid.hpp"
#include "route_truth.hpp"
#include "trials/trial_task.hpp"

namespace {

using pose_wall::planar::Pose2;
using pose_wall::planar::route::along_arc;
using namespace pose_wall::test;

pose_wall_planar_plan_settings usual_plan() {
  pose_wall_planar_plan_settings settings;
  EXPECT_EQ(pose_wall_planar_plan_settings_init(&settings), POSE_WALL_OK);
  return settings;
}

// A field of 12 m with single cells of rock by chance.
DrawnGrid sprinkled(std::uint32_t seed, int cells) {
  std::mt19937 random(seed);
  DrawnGrid grid(12.0, 0);
  for (int k = 0; k < cells; ++k) grid.cells[random() % grid.cells.size()] = 100;
  return grid;
}

// Free at many poses along the arc.
bool is_way_free(const DrawnGrid& grid, const Rectangle& r, const Pose2& from, double along, double turn) {
  const int steps = 20 + static_cast<int>(std::abs(along) / 0.01 + std::abs(turn) / 0.004);
  for (int k = 0; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    const Pose2 at = along_arc(from, part * along, part * turn);
    if (!is_rectangle_free(grid.view(), 50, r, at.x_m, at.y_m, at.yaw_rad)) return false;
  }
  return true;
}

TEST(PlanFootprint, ASweepIsFreeOnlyIfAllPosesOfItAreAndBlockedOnlyIfTheyNearlyAre) {
  const pose_wall_planar_plan_settings settings = usual_plan();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int free = 0, blocked = 0;
  for (int k = 0; k < 700; ++k) {
    const DrawnGrid grid = sprinkled(static_cast<std::uint32_t>(k), 20);
    GridSweeps checker(grid, settings);
    const Pose2 from{4.0 + 4.0 * part(random), 4.0 + 4.0 * part(random), 6.3 * part(random)};
    const double along = k % 3 == 0 ? 0.0 : 3.0 * (part(random) - 0.5),
                 turn = k % 3 == 1 ? 0.0 : 2.0 * (part(random) - 0.5);
    const bool is_free = checker.sweeps.is_arc_free(from, along, turn);
    const Rectangle body = rectangle_of(settings);
    (is_free ? free : blocked) += 1;
    if (is_free) {
      EXPECT_TRUE(is_way_free(grid, body.grown(-1e-6), from, along, turn)) << k;
    } else {
      EXPECT_FALSE(is_way_free(grid, body.grown(0.006), from, along, turn)) << k;
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(blocked, 50);
}

TEST(PlanFootprint, OutsideTheGridNothingIsFree) {
  const DrawnGrid grid(12.0, 0);
  GridSweeps checker(grid, usual_plan());
  EXPECT_TRUE(checker.sweeps.is_pose_free({6.0, 6.0, 0.3}));
  EXPECT_TRUE(checker.sweeps.is_pose_free({2.36, 6.0, 0.0}));
  EXPECT_FALSE(checker.sweeps.is_pose_free({2.34, 6.0, 0.0}));
  EXPECT_FALSE(checker.sweeps.is_pose_free({1e12, 6.0, 0.0}));
  EXPECT_FALSE(checker.sweeps.is_straight_free({6.0, 6.0, 0.0}, 4.0));
  EXPECT_FALSE(checker.sweeps.is_straight_free({6.0, 6.0, 0.0}, 1e9));
  EXPECT_FALSE(checker.sweeps.is_turn_free({6.0, 1.5, 0.0}, 1.0));
  EXPECT_FALSE(checker.sweeps.is_arc_free({6.0, 6.0, 0.0}, 0.0, 1e9));
}

TEST(PlanFootprint, AQuarterArcEndsWhereGeometrySays) {
  const Pose2 end = along_arc({1.0, 2.0, 0.0}, 0.5 * pose_wall::kPi * 3.0, 0.5 * pose_wall::kPi);
  EXPECT_NEAR(end.x_m, 4.0, 1e-12);
  EXPECT_NEAR(end.y_m, 5.0, 1e-12);
  const Pose2 back = along_arc({1.0, 2.0, 0.0}, -2.0, 0.0);
  EXPECT_NEAR(back.x_m, -1.0, 1e-12);
}

TEST(PlanBitGrid, BitsAreTheCellsForAnyWidthAndThreshold) {
  std::mt19937 random(9);
  for (const std::uint32_t width : {1U, 7U, 8U, 63U, 64U, 65U, 130U, 200U}) {
    std::vector<std::int8_t> cells(width * 3);
    for (std::int8_t& cell : cells) cell = static_cast<std::int8_t>(static_cast<int>(random() % 256) - 128);
    const pose_wall_planar_grid view{sizeof(view), width, 3, 0, 0.05, 0.0, 0.0, cells.data()};
    std::vector<std::uint64_t> block(64);
    pose_wall::planar::route::BitGrid grid;
    pose_wall::Arena arena(block.data());
    grid.lay_out(arena, 256, 4);
    ASSERT_LE(arena.bytes(), block.size() * 8);
    for (const std::uint32_t threshold : {1U, 50U, 100U}) {
      ASSERT_TRUE(grid.read(view, threshold));
      for (std::uint32_t k = 0; k < cells.size(); ++k) {
        EXPECT_EQ(grid.is_blocked(static_cast<int>(k / width), static_cast<int>(k % width)),
                  !pose_wall::test::is_driven_on(cells[k], threshold))
            << width << " " << threshold << " " << k;
      }
    }
  }
}

TEST(PlanBitGrid, ClearanceIsThatOfTheNearestBlockedCellOrEdge) {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const DrawnGrid drawn = sprinkled(static_cast<std::uint32_t>(round), 20 + 10 * round);
    GridSweeps checker(drawn, usual_plan());
    for (int k = 0; k < 20; ++k) {
      const int column = static_cast<int>(random() % 241), row = static_cast<int>(random() % 241);
      double truth = std::min({40, column, row, 240 - column, 240 - row});
      for (int r = 0; r < 240; ++r) {
        for (int c = 0; c < 240; ++c) {
          if (drawn.cells[static_cast<std::size_t>(r * 240 + c)] == 0) continue;
          const double dx = std::max({c - column, column - c - 1, 0}), dy = std::max({r - row, row - r - 1, 0});
          truth = std::min(truth, std::hypot(dx, dy));
        }
      }
      EXPECT_NEAR(checker.grid.clearance(column, row, 40), truth, 1e-9) << round << " " << column << " " << row;
    }
  }
}

}  // namespace

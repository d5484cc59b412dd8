// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>
#include <vector>

#include "../../support/aligned_block.hpp"
#include "../bytes_needed.hpp"
#include "../drawn_roads.hpp"
#include "planar/route/planner.hpp"
#include "pose_wall_planar_plan.h"

namespace pose_wall::test {

// An opened planner in a block of garbage.
struct TrialPlanner {
  AlignedBlock block;
  pose_wall_planar_planner* planner = nullptr;
  std::vector<pose_wall_planar_path_pose> poses;

  explicit TrialPlanner(const pose_wall_planar_plan_settings& settings)
      : block(bytes_needed(settings), Dirt::kRandom), poses(20000) {
    if (pose_wall_planar_plan_open(&settings, block.data(), block.size(), &planner) != POSE_WALL_OK) {
      throw std::runtime_error("the planner does not open");
    }
  }

  pose_wall_planar_plan_result plan(const DrawnGrid& grid, const pose_wall_planar_pose& start,
                                    const pose_wall_planar_pose& goal) {
    pose_wall_planar_plan_result result{};
    result.struct_size = sizeof(result);
    const pose_wall_planar_grid view = grid.view();
    if (pose_wall_planar_plan(planner, &view, &start, &goal, poses.data(), static_cast<std::uint32_t>(poses.size()),
                              &result) != POSE_WALL_OK) {
      throw std::runtime_error("the planner refuses");
    }
    return result;
  }
};

// The library's own sweeps over a grid, for checks and for planners to compare with.
struct GridSweeps {
  std::vector<unsigned char> block;
  planar::route::BitGrid grid;
  planar::route::Sweeps sweeps;

  GridSweeps(const DrawnGrid& drawn, const pose_wall_planar_plan_settings& s) {
    const auto lay_out = [&](void* at) {
      Arena arena(at);
      grid.lay_out(arena, drawn.width, drawn.height);
      sweeps.lay_out(arena, drawn.height);
      return arena.bytes();
    };
    block.resize(lay_out(nullptr) + 64);
    lay_out(block.data() + (64 - reinterpret_cast<std::uintptr_t>(block.data()) % 64));
    grid.read(drawn.view(), s.occupied_from);
    sweeps.open(&grid, {s.front_m + s.margin_m, s.rear_m + s.margin_m, s.left_m + s.margin_m, s.right_m + s.margin_m});
  }
};

// Two free poses on the grid's places, far from each other.
inline bool draw_ends(const DrawnGrid& grid, const pose_wall_planar_plan_settings& settings, std::uint32_t seed,
                      pose_wall_planar_pose* start, pose_wall_planar_pose* goal) {
  GridSweeps checker(grid, settings);
  std::mt19937 random(seed + 977);
  std::uniform_real_distribution<double> yaw(-3.14159, 3.14159);
  const std::size_t places = grid.places_xy.size() / 2;
  const auto draw = [&](pose_wall_planar_pose* pose) {
    for (int k = 0; k < 200; ++k) {
      const std::size_t i = random() % places;
      *pose = {grid.places_xy[2 * i], grid.places_xy[2 * i + 1], yaw(random)};
      if (checker.sweeps.is_pose_free({pose->x_m, pose->y_m, pose->yaw_rad})) return true;
    }
    return false;
  };
  for (int k = 0; k < 100; ++k) {
    if (!draw(start) || !draw(goal)) return false;
    if (std::hypot(start->x_m - goal->x_m, start->y_m - goal->y_m) > 50.0) return true;
  }
  return false;
}

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/choose/across.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "base/simd/four_floats.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// Number of points of the band beside the machine, in cells of a plane across it, at any place along the machine.
struct PointsBeside {
  std::uint16_t in_cell[WallGrid::kRowsMax][WallGrid::kColumns] = {};
  std::uint32_t beyond = 0;
};

void count_points(const WallScene& scene, const WallGrid::Rows& rows, PointsBeside* points) {
  const auto left_x = static_cast<float>(scene.left_level.x()), left_y = static_cast<float>(scene.left_level.y());
  const auto count = [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourInts cell = rows.cells_of(left_x * x + left_y * y, z);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] == 0) continue;
      if (cell[lane] < 0) {
        ++points->beyond;
        continue;
      }
      const auto c = static_cast<std::uint32_t>(cell[lane]);
      std::uint16_t* const there = &points->in_cell[c / WallGrid::kColumns][c % WallGrid::kColumns];
      if (*there < 0xFFFF) ++*there;
    }
  };
  for_each_four_points(scene.band_level, count);
}

// A plane that crosses a run of cells with points: the number of its columns for each cell, and some at the ends.
struct Crossing {
  double columns_each, columns_at_ends;
};

Crossing crossing_of(const Settings& s, double row_m) {
  const double cosine_least = cosine(radians(s.yaw_max_deg + kRefineSlack_deg));
  const double lean_cosine = cosine(radians(s.wall_lean_max_deg));
  const double sine = std::sqrt(1.0 - cosine_least * cosine_least);
  const double lean_sine = std::sqrt(1.0 - lean_cosine * lean_cosine);
  // Depth of the points of one row, by the plane's lean and by the width of an inlier.
  const double depth_m = (row_m * lean_sine + 2.0 * s.wall_ransac_thresh) / lean_cosine;
  // An end within a column touches one more.
  return {1.0 / cosine_least, 2.0 + depth_m * sine / (cosine_least * WallGrid::kColumn_m)};
}

constexpr double kCellsPerPoint = 0.5;  // a cell is solid by two points at least

// Largest number of solid cells in one row of a plane.
double most_cells(const std::uint16_t (&points)[WallGrid::kColumns], const Crossing& crossing) {
  double cells = 0.0;
  std::uint32_t run = 0, in_run = 0;
  for (std::uint32_t c = 0; c <= WallGrid::kColumns; ++c) {
    const std::uint32_t here = c < WallGrid::kColumns ? points[c] : 0;
    if (here > 0) {
      ++run;
      in_run += here;
    } else if (run > 0) {
      const double by_place = run * crossing.columns_each + crossing.columns_at_ends;
      const double by_points = kCellsPerPoint * in_run;
      cells += by_place < by_points ? by_place : by_points;
      run = in_run = 0;
    }
  }
  return cells;
}

}  // namespace

double most_area_across_m2(const WallScene& scene) {
  const WallGrid::Rows rows = WallGrid::rows_of(scene);
  const Crossing crossing = crossing_of(scene.settings, rows.height_m);
  PointsBeside points;
  count_points(scene, rows, &points);
  double cells = kCellsPerPoint * points.beyond;
  for (std::uint32_t row = 0; row < rows.count; ++row) cells += most_cells(points.in_cell[row], crossing);
  return cells * WallGrid::kColumn_m * rows.height_m;
}

bool may_stand_across(double pair_m2, const WallChoice& choice, const Settings& s) {
  if (!choice.any() || pair_m2 > limit_of<gate::ACROSS>(s) * choice.score_m2) return true;
  POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_WALLS));
  POSE_WALL_NOTE(passes<gate::ACROSS>(pair_m2 / choice.score_m2, s));
  return false;
}

bool is_behind_to_be_drawn(double ahead_m2, double most_behind_m2, const WallChoice& choice, const Settings& s) {
  constexpr double kMissedAtMost = 0.15;  // the same bits, 1 M instructions fewer on a Mid-360 (bench/README.md)
  return may_stand_across(ahead_m2 + kMissedAtMost * choice.score_m2 + most_behind_m2, choice, s);
}

void refuse_where_across(const WallScene& scene, Random* random, ProposeScratch* scratch, WallChoice* choice) {
  const Settings& s = scene.settings;
  if (scratch->work->stops()) return;
  const double most_m2 = choice->any() ? most_area_across_m2(scene) : 0.0;
  if (!may_stand_across(2.0 * most_m2, *choice, s)) return;
  const Eigen::Vector3d f = scene.forward_level, l = scene.left_level;
  const SideView ends[2] = {{l, f}, {l, -f}};
  WallCandidates ahead, behind;
  draw_walls(scene, ends[0], nullptr, random, &scratch->search[0]);
  weigh_walls(scene, ends[0], &scratch->search[0], scratch, &ahead);
  if (scratch->work->stops()) return;
  // Even with the most that could be behind, the planes ahead may show too little.
  const WallCandidate* const best = ahead.strongest();
  if (!is_behind_to_be_drawn(best != nullptr ? best->evidence.score_m2 : 0.0, most_m2, *choice, s)) return;
  draw_walls(scene, ends[1], nullptr, random, &scratch->search[1]);
  exchange_directions(scratch->search);
  const WallCandidates weighed = ahead;
  weigh_walls(scene, ends[0], &scratch->search[0], scratch, &ahead, &weighed);
  weigh_walls(scene, ends[1], &scratch->search[1], scratch, &behind);
  refuse_if_across(ahead, behind, s, choice);
}

}  // namespace pose_wall

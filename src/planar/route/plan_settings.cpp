// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/planner.hpp"

namespace pose_wall::planar::route {
namespace {

struct NumberRow {
  double pose_wall_planar_plan_settings::*member;
  double least, most;
  pose_wall_planar_fault fault;
};
struct CountRow {
  std::uint32_t pose_wall_planar_plan_settings::*member;
  std::uint32_t least, most;
  pose_wall_planar_fault fault;
};

#define ROW(member, least, most, text)                      \
  {                                                         \
    &pose_wall_planar_plan_settings::member, least, most, { \
#member, #member " must be from " text                \
    }                                                       \
  }

constexpr CountRow kCounts[] = {
    ROW(width_max, 8, 8192, "8 to 8192"),
    ROW(height_max, 8, 8192, "8 to 8192"),
    ROW(places_max, 1000, 1000000, "1000 to 1000000"),
    ROW(open_max, 1000, 10000000, "1000 to 10000000"),
    ROW(expansions_max, 1, 100000000, "1 to 100000000"),
    ROW(hurry_after, 0, 100000000, "0 to 100000000"),
    ROW(occupied_from, 1, 100, "1 to 100"),
};
constexpr NumberRow kNumbers[] = {
    ROW(resolution_m, 0.01, 1.0, "0.01 to 1"),
    ROW(front_m, 0.1, 20.0, "0.1 to 20"),
    ROW(rear_m, 0.1, 20.0, "0.1 to 20"),
    ROW(left_m, 0.1, 20.0, "0.1 to 20"),
    ROW(right_m, 0.1, 20.0, "0.1 to 20"),
    ROW(margin_m, 0.0, 2.0, "0 to 2"),
    ROW(turn_cost_m_rad, 0.01, 100.0, "0.01 to 100"),
    ROW(reverse_cost, 1.0, 100.0, "1 to 100"),
    ROW(cusp_cost_m, 0.0, 100.0, "0 to 100"),
    ROW(weight, 1.0, 10.0, "1 to 10"),
    ROW(radius_min_m, 0.1, 100.0, "0.1 to 100"),
    ROW(radius_max_m, 0.1, 1000.0, "radius_min_m to 1000"),
    ROW(pose_step_m, 0.05, 10.0, "0.05 to 10"),
};
#undef ROW

constexpr pose_wall_planar_fault kRadius = {"radius_max_m", "radius_max_m must be from radius_min_m to 1000"};
constexpr pose_wall_planar_fault kLattice = {
    "lattice_m", "lattice_m must be from 2 to 50 cells and at most an eighth of the machine's length"};
constexpr pose_wall_planar_fault kReach = {"resolution_m", "the machine must be at most 4000 cells long and wide"};

}  // namespace

const pose_wall_planar_fault* fault_of(const pose_wall_planar_plan_settings& settings) {
  for (const CountRow& row : kCounts) {
    const std::uint32_t value = settings.*row.member;
    if (!(value >= row.least && value <= row.most)) return &row.fault;
  }
  for (const NumberRow& row : kNumbers) {
    const double value = settings.*row.member;
    if (!(value >= row.least && value <= row.most)) return &row.fault;
  }
  if (!(settings.radius_max_m >= settings.radius_min_m)) return &kRadius;
  const double steps = settings.lattice_m / settings.resolution_m;
  const bool is_lattice =
      steps >= 2.0 - 1e-9 && steps <= 50.0 && settings.lattice_m <= (settings.front_m + settings.rear_m) / 8.0;
  if (!is_lattice) return &kLattice;
  constexpr double kReachMost_cells = 4000.0;  // rows of a mask: its columns are 16-bit words
  const double wide_m = settings.left_m + settings.right_m, long_m = settings.front_m + settings.rear_m;
  const bool is_small = (wide_m + long_m + 4.0 * settings.margin_m) / settings.resolution_m <= kReachMost_cells;
  return is_small ? nullptr : &kReach;
}

}  // namespace pose_wall::planar::route

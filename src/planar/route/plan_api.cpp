// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The extern "C" file of the route planner: checks arguments, translates, calls.

#include "base/math/finite.hpp"
#include "part/shell.hpp"
#include "planar/route/planner.hpp"
#include "pose_wall_planar_plan.h"

namespace pose_wall::planar::route {
namespace {

using HeldPlanner = Held<Planner, 0x6E616C506D614C50ULL>;

Pose2 taken(const pose_wall_planar_pose& pose) {
  return {pose.x_m, pose.y_m, wrapped(pose.yaw_rad)};
}

constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_plan_settings, __VA_ARGS__)
#include "pose_wall_planar_plan_settings.def"
};

struct PlanTable : SettingsTable<pose_wall_planar_plan_settings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows() { return rows_of(kRows); }
  SettingFault broken_rule() const;
};

SettingFault PlanTable::broken_rule() const {
  if (!(radius_max_m >= radius_min_m)) return {"radius_max_m", "radius_max_m must be from radius_min_m to 1000"};
  const double steps = lattice_m / resolution_m;
  const bool is_lattice = steps >= 2.0 - 1e-9 && steps <= 50.0 && lattice_m <= (front_m + rear_m) / 8.0;
  if (!is_lattice) {
    return {"lattice_m", "lattice_m must be from 2 to 50 cells and at most an eighth of the machine's length"};
  }
  constexpr double kReachMost_cells = 4000.0;  // rows of a mask: its columns are 16-bit words
  const double wide_m = left_m + right_m, long_m = front_m + rear_m;
  const bool is_small = (wide_m + long_m + 4.0 * margin_m) / resolution_m <= kReachMost_cells;
  if (!is_small) return {"resolution_m", "the machine must be at most 4000 cells long and wide"};
  return {};
}

constexpr const char* kOutcomes[][2] = {
    {"found", "A route was found."},
    {"start_blocked", "The machine with its margin does not fit at the start."},
    {"goal_blocked", "The machine with its margin does not fit at the goal."},
    {"not_connected", "No free cells lead from the start to the goal."},
    {"too_narrow", "The widest way is narrower than the machine with its margin."},
    {"too_tight", "The way is wide enough, but the machine was not found to get round."},
    {"list_full", "The lists of the search were full before a route was found."},
    {"work_limit", "The limit of expansions was reached before a route was found."},
    {"room_small", "A route was found, but the caller's room is too small for its poses."}};
constexpr std::uint32_t kOutcomeCount = sizeof(kOutcomes) / sizeof(kOutcomes[0]);  // rows of the table

}  // namespace

extern "C" {

POSE_WALL_SETTINGS_CALLS(pose_wall_planar_plan, PlanTable, pose_wall_planar_fault)
POSE_WALL_BLOCK_CALLS(pose_wall_planar_plan, HeldPlanner, PlanTable, pose_wall_planar_planner)

POSE_WALL_EXPORT int32_t pose_wall_planar_plan(pose_wall_planar_planner* planner, const pose_wall_planar_grid* grid,
                                               const pose_wall_planar_pose* start, const pose_wall_planar_pose* goal,
                                               pose_wall_planar_path_pose* poses, uint32_t capacity,
                                               pose_wall_planar_plan_result* result) {
  if (start == nullptr || goal == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  if (poses == nullptr && capacity > 0) return POSE_WALL_E_NULL;
  return with_part<HeldPlanner>(planner, [&](Planner& own) -> std::int32_t {
    if (const std::int32_t size = check_struct(*result); size != POSE_WALL_OK) return size;
    if (const std::int32_t status = check_grid(grid); status != POSE_WALL_OK) return status;
    if (!is_pose(*start) || !is_pose(*goal)) return POSE_WALL_PLANAR_E_POSE;
    if (!own.read(*grid)) return POSE_WALL_PLANAR_E_GRID;
    own.plan(taken(*start), taken(*goal), Span<pose_wall_planar_path_pose>(poses, capacity), result);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT const char* pose_wall_planar_plan_outcome_name(uint32_t outcome) {
  return outcome < kOutcomeCount ? kOutcomes[outcome][0] : "unknown";
}
POSE_WALL_EXPORT const char* pose_wall_planar_plan_outcome_text(uint32_t outcome) {
  return outcome < kOutcomeCount ? kOutcomes[outcome][1] : "unknown outcome";
}

POSE_WALL_EXPORT double pose_wall_planar_plan_clearance(const pose_wall_planar_planner* planner, double x_m,
                                                        double y_m) {
  double clearance_m = not_a_number();
  if (!is_place(x_m, y_m)) return clearance_m;
  (void)with_part<HeldPlanner>(planner, [&](const Planner& own) { clearance_m = own.clearance_m({x_m, y_m}); });
  return clearance_m;
}

}  // extern "C"

}  // namespace pose_wall::planar::route

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The extern "C" file of the route planner: checks arguments, translates, calls.

#include "base/math/finite.hpp"
#include "part/export.hpp"
#include "part/shell.hpp"
#include "part/struct_sizes.hpp"
#include "planar/route/planner.hpp"
#include "pose_wall_planar_plan.h"

namespace {

using pose_wall::planar::is_pose;
using pose_wall::planar::route::Planner;
using HeldPlanner = pose_wall::Held<Planner, 0x6E616C506D614C50ULL>;

HeldPlanner* held_of(pose_wall_planar_planner* planner) {
  return reinterpret_cast<HeldPlanner*>(planner);
}
const HeldPlanner* held_of(const pose_wall_planar_planner* planner) {
  return reinterpret_cast<const HeldPlanner*>(planner);
}

pose_wall::planar::Pose2 taken(const pose_wall_planar_pose& pose) {
  return {pose.x_m, pose.y_m, pose_wall::planar::wrapped(pose.yaw_rad)};
}

constexpr pose_wall::SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_plan_settings, __VA_ARGS__)
#include "pose_wall_planar_plan_settings.def"
};

struct PlanTable : pose_wall::SettingsTable<pose_wall_planar_plan_settings> {
  using SettingsTable::SettingsTable;
  static pose_wall::SettingRows rows() { return pose_wall::rows_of(kRows); }
  pose_wall::SettingFault broken_rule() const;
};

pose_wall::SettingFault PlanTable::broken_rule() const {
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

POSE_WALL_EXPORT int32_t pose_wall_planar_plan_settings_init(pose_wall_planar_plan_settings* settings) {
  return pose_wall::init_settings<PlanTable>(settings);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_plan_settings_check(const pose_wall_planar_plan_settings* settings,
                                                              pose_wall_planar_fault* fault) {
  return pose_wall::check_settings<PlanTable>(settings, fault);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_plan_memory_needed(const pose_wall_planar_plan_settings* settings,
                                                             uint64_t* bytes) {
  return pose_wall::part_memory_needed<HeldPlanner, PlanTable>(settings, bytes);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_plan_open(const pose_wall_planar_plan_settings* settings, void* block,
                                                    uint64_t block_bytes, pose_wall_planar_planner** planner) {
  return pose_wall::open_part<HeldPlanner, PlanTable>(settings, block, block_bytes, planner,
                                                      [](auto& body, const auto&) { body.open(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_plan(pose_wall_planar_planner* planner, const pose_wall_planar_grid* grid,
                                               const pose_wall_planar_pose* start, const pose_wall_planar_pose* goal,
                                               pose_wall_planar_path_pose* poses, uint32_t capacity,
                                               pose_wall_planar_plan_result* result) {
  if (planner == nullptr || start == nullptr || goal == nullptr || result == nullptr) return POSE_WALL_E_NULL;
  if (poses == nullptr && capacity > 0) return POSE_WALL_E_NULL;
  const pose_wall::Inside<HeldPlanner> inside(held_of(planner));
  std::int32_t status = inside.status();
  if (status == POSE_WALL_OK) status = pose_wall::check_struct(*result);
  if (status == POSE_WALL_OK) status = pose_wall::planar::route::check_grid(grid);
  if (status == POSE_WALL_OK && !(is_pose(*start) && is_pose(*goal))) status = POSE_WALL_PLANAR_E_POSE;
  if (status != POSE_WALL_OK) return status;
  if (!inside->body().read(*grid)) return POSE_WALL_PLANAR_E_GRID;
  const pose_wall::Span<pose_wall_planar_path_pose> room(poses, capacity);
  inside->body().plan(taken(*start), taken(*goal), room, result);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT const char* pose_wall_planar_plan_outcome_name(uint32_t outcome) {
  return outcome < kOutcomeCount ? kOutcomes[outcome][0] : "unknown";
}
POSE_WALL_EXPORT const char* pose_wall_planar_plan_outcome_text(uint32_t outcome) {
  return outcome < kOutcomeCount ? kOutcomes[outcome][1] : "unknown outcome";
}

POSE_WALL_EXPORT double pose_wall_planar_plan_clearance(const pose_wall_planar_planner* planner, double x_m,
                                                        double y_m) {
  if (planner == nullptr || !pose_wall::planar::is_place(x_m, y_m)) return pose_wall::not_a_number();
  const pose_wall::Inside<HeldPlanner> inside(held_of(planner));
  return inside.status() == POSE_WALL_OK ? inside->body().clearance_m({x_m, y_m}) : pose_wall::not_a_number();
}

}  // extern "C"

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Routes through a map, planned by pose_wall_planar.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pose_wall_planar_plan.h"
#include "study/planar/map_picture.hpp"
#include "study/planar/part_block.hpp"
#include "study/planar/setting_words.hpp"

namespace pose_wall::tools {

// Without those that follow from the grid.
const SettingRows& plan_setting_rows();
// Throws std::invalid_argument that names every word whose name is none of them.
void require_plan_settings(const std::vector<std::string>& words);

// The defaults, with sizes and resolution for this grid and the settings that `words` holds; these are taken out of it.
// Throws std::invalid_argument that names every refused setting.
pose_wall_planar_plan_settings take_plan_settings(const pose_wall_planar_grid& grid, std::vector<std::string>* words);

struct PlannedRoute {
  pose_wall_planar_plan_result result{};
  std::vector<pose_wall_planar_path_pose> poses;  // empty: there is none
  double processor_ms = 0.0;

  bool is_found() const { return result.outcome == POSE_WALL_PLANAR_PLAN_FOUND; }
};

class RoutePlanner {
 public:
  // Throws PlanarError.
  explicit RoutePlanner(const pose_wall_planar_plan_settings& settings);

  // That there is no route is a result. Throws PlanarError for poses that are not finite.
  PlannedRoute plan(const pose_wall_planar_grid& grid, const pose_wall_planar_pose& from,
                    const pose_wall_planar_pose& to);
  // To the nearest thing of the last grid, for the tracker; as pose_wall_planar_plan_clearance.
  double clearance_m(double x_m, double y_m) const { return pose_wall_planar_plan_clearance(planner_, x_m, y_m); }
  const pose_wall_planar_planner* planner() const { return planner_; }
  std::uint64_t block_bytes() const { return block_.bytes(); }

 private:
  PartBlock block_;
  pose_wall_planar_planner* planner_ = nullptr;
};

// A cell that a machine does not fit beside.
struct BlockingCell {
  MapPlace middle;
  bool is_unknown = false;
};
// The first that the machine with its margin covers at this pose, things before unknown cells; none: it fits, or only
// the edge of the map is in its way.
std::optional<BlockingCell> blocking_cell(const pose_wall_planar_grid& grid,
                                          const pose_wall_planar_plan_settings& settings,
                                          const pose_wall_planar_pose& at);

// Why there is no route, in sentences.
std::string no_route_text(const pose_wall_planar_plan_result& result);
// That the machine does not fit at the place that `word` gives: what is in its way and how far it reaches, or where the
// map ends.
std::string blocked_place_text(const pose_wall_planar_grid& grid, const pose_wall_planar_plan_settings& settings,
                               const pose_wall_planar_pose& at, const std::string& word);

// pose, x_m, y_m, yaw_rad, curvature_1_m, along_m, drive, stop, cusp, turn: one row a pose.
std::string route_as_csv(const PlannedRoute& route);

// The machine's rectangle.
std::vector<MapPlace> machine_outline(const pose_wall_planar_plan_settings& settings);

// Draws the route, and the machine along it.
void draw_route(const PlannedRoute& route, const pose_wall_planar_plan_settings& settings, MapScene* scene);

}  // namespace pose_wall::tools

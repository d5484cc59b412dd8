// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/planned_route.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "io/csv/csv_table.hpp"
#include "io/language/language.hpp"
#include "io/planar_files/map_files.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/thread_clock.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint32_t kSideLeast = 8, kSideMost = 8192;  // of pose_wall_planar_plan_settings

const char* turn_word(std::uint32_t flags) {
  if ((flags & POSE_WALL_PLANAR_PATH_TURN_LEFT) != 0) return "left";
  return (flags & POSE_WALL_PLANAR_PATH_TURN_RIGHT) != 0 ? "right" : "";
}

}  // namespace

const SettingRows& plan_setting_rows() {
  static const SettingRows rows = without({"width_max", "height_max", "resolution_m"}, {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_plan_settings, __VA_ARGS__)
#include "pose_wall_planar_plan_settings.def"
                                                                                       });
  return rows;
}

void require_plan_settings(const std::vector<std::string>& words) {
  const std::vector<std::string> names = names_of(plan_setting_rows());
  std::vector<std::string> faults;
  for (const std::string& word : words) {
    const std::string name = named_value(word).name;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      faults.push_back(unknown_setting_text(name, names));
    }
  }
  refuse_settings(faults);
}

pose_wall_planar_plan_settings take_plan_settings(const pose_wall_planar_grid& grid, std::vector<std::string>* words) {
  if (std::max(grid.width, grid.height) > kSideMost) {
    throw std::invalid_argument(
        say("the map has {} x {} cells; the planner takes up to {} a side. Make it with larger "
            "cells: pose_wall map --cell",
            grid.width, grid.height, kSideMost));
  }
  pose_wall_planar_plan_settings settings{};
  require_ok(pose_wall_planar_plan_settings_init(&settings), translatable("the settings of the route"));
  settings.width_max = std::max(grid.width, kSideLeast);
  settings.height_max = std::max(grid.height, kSideLeast);
  settings.resolution_m = grid.resolution_m;
  settings.lattice_m = std::max(settings.lattice_m, 2.0 * grid.resolution_m);
  take_settings(plan_setting_rows(), pose_wall_planar_plan_settings_check, words, &settings);
  pose_wall_planar_fault fault{};
  if (pose_wall_planar_plan_settings_check(&settings, &fault) != POSE_WALL_OK) {
    throw std::invalid_argument(fault.rule != nullptr ? fault.rule : tr("the value is refused"));
  }
  return settings;
}

RoutePlanner::RoutePlanner(const pose_wall_planar_plan_settings& settings)
    : block_([&settings] {
        std::uint64_t bytes = 0;
        require_ok(pose_wall_planar_plan_memory_needed(&settings, &bytes), translatable("the settings of the route"));
        return bytes;
      }()) {
  require_ok(pose_wall_planar_plan_open(&settings, block_.data(), block_.bytes(), &planner_),
             translatable("the settings of the route"));
}

PlannedRoute RoutePlanner::plan(const pose_wall_planar_grid& grid, const pose_wall_planar_pose& from,
                                const pose_wall_planar_pose& to) {
  PlannedRoute route;
  route.result.struct_size = sizeof route.result;
  route.poses.resize(1024);
  for (int tries = 0; tries < 2; ++tries) {
    const double started_ms = thread_ms();
    require_ok(pose_wall_planar_plan(planner_, &grid, &from, &to, route.poses.data(),
                                     static_cast<std::uint32_t>(route.poses.size()), &route.result),
               translatable("the route"));
    route.processor_ms = thread_ms() - started_ms;
    if (route.result.outcome != POSE_WALL_PLANAR_PLAN_ROOM_SMALL) break;
    route.poses.resize(route.result.poses);
  }
  route.poses.resize(route.is_found() ? route.result.poses : 0);
  return route;
}

std::optional<BlockingCell> blocking_cell(const pose_wall_planar_grid& grid,
                                          const pose_wall_planar_plan_settings& settings,
                                          const pose_wall_planar_pose& at) {
  // A cell is covered where its middle is nearer than half its diagonal.
  const double beside_m = settings.margin_m + 0.7072 * grid.resolution_m;
  std::optional<BlockingCell> found;
  for (std::uint32_t row = 0; row < grid.height; ++row) {
    for (std::uint32_t column = 0; column < grid.width; ++column) {
      const std::int8_t cell = grid.cells[std::size_t{row} * grid.width + column];
      const bool is_unknown = cell < 0;
      if (!is_unknown && cell < static_cast<int>(settings.occupied_from)) continue;
      const MapPlace middle{grid.origin_x_m + (column + 0.5) * grid.resolution_m,
                            grid.origin_y_m + (row + 0.5) * grid.resolution_m};
      const pose_wall_planar_pose in_machine = seen_from(at, {middle.x_m, middle.y_m, 0.0});
      const bool is_covered =
          in_machine.x_m < settings.front_m + beside_m && in_machine.x_m > -settings.rear_m - beside_m &&
          in_machine.y_m < settings.left_m + beside_m && in_machine.y_m > -settings.right_m - beside_m;
      if (!is_covered) continue;
      if (!is_unknown) return BlockingCell{middle, false};
      if (!found) found = BlockingCell{middle, true};
    }
  }
  return found;
}

std::string blocked_place_text(const pose_wall_planar_grid& grid, const pose_wall_planar_plan_settings& settings,
                               const pose_wall_planar_pose& at, const std::string& word) {
  const std::string extent = extent_text(grid);
  if (!is_inside(grid, at.x_m, at.y_m)) return say("{} lies outside the map. {}", word, extent);
  const std::optional<BlockingCell> cell = blocking_cell(grid, settings, at);
  std::string in_its_way;
  if (!cell) {
    in_its_way = say("the edge of the map is in its way. {}", extent);
  } else if (cell->is_unknown) {
    in_its_way = say("an unknown cell at x {:.2f} m, y {:.2f} m is in its way.", cell->middle.x_m, cell->middle.y_m);
  } else {
    in_its_way = say("a thing at x {:.2f} m, y {:.2f} m is in its way.", cell->middle.x_m, cell->middle.y_m);
  }
  return say(
      "The machine does not fit at {}: {} From its turning centre it reaches {:.2f} m ahead, {:.2f} m back, "
      "{:.2f} m left and {:.2f} m right, and it needs {:.2f} m more all round "
      "(--set front_m, rear_m, left_m, right_m, margin_m).",
      word, in_its_way, settings.front_m, settings.rear_m, settings.left_m, settings.right_m, settings.margin_m);
}

std::string no_route_text(const pose_wall_planar_plan_result& result) {
  switch (result.outcome) {
    case POSE_WALL_PLANAR_PLAN_START_BLOCKED:
      return tr(
          "The machine does not fit at the start: with its margin it stands on cells that are occupied or unknown.");
    case POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED:
      return tr(
          "The machine does not fit at the goal: with its margin it would stand on cells that are occupied or "
          "unknown.");
    case POSE_WALL_PLANAR_PLAN_NOT_CONNECTED:
      return tr("No free cells lead from the start to the goal: a wall or unknown ground lies between them.");
    case POSE_WALL_PLANAR_PLAN_TOO_NARROW:
      return say("The widest way is too narrow: at x {:.2f} m, y {:.2f} m it is {:.2f} m wide.", result.place.x_m,
                 result.place.y_m, result.width_m);
    case POSE_WALL_PLANAR_PLAN_TOO_TIGHT:
      return say(
          "The machine cannot turn through: the search got as far as x {:.2f} m, y {:.2f} m. A corner is too "
          "tight for its length.",
          result.place.x_m, result.place.y_m);
    case POSE_WALL_PLANAR_PLAN_LIST_FULL:
      return say("The search ran out of room after {} places.", result.places);
    case POSE_WALL_PLANAR_PLAN_WORK_LIMIT:
      return say("The search ended at its limit of {} expansions.", result.expansions);
    default:
      return pose_wall_planar_plan_outcome_text(result.outcome);
  }
}

std::string route_as_csv(const PlannedRoute& route) {
  std::string csv =
      csv_line({"pose", "x_m", "y_m", "yaw_rad", "curvature_1_m", "along_m", "drive", "stop", "cusp", "turn"});
  std::size_t number = 0;
  for (const pose_wall_planar_path_pose& at : route.poses) {
    csv += csv_line({std::to_string(number++), csv_number(at.pose.x_m), csv_number(at.pose.y_m),
                     csv_number(at.pose.yaw_rad), csv_number(at.curvature_1_m), csv_number(at.along_m),
                     std::to_string(at.drive), (at.flags & POSE_WALL_PLANAR_PATH_STOP) != 0 ? "1" : "0",
                     (at.flags & POSE_WALL_PLANAR_PATH_CUSP) != 0 ? "1" : "0", turn_word(at.flags)});
  }
  return csv;
}

std::vector<MapPlace> machine_outline(const pose_wall_planar_plan_settings& settings) {
  return {{settings.front_m, settings.left_m},
          {settings.front_m, -settings.right_m},
          {-settings.rear_m, -settings.right_m},
          {-settings.rear_m, settings.left_m}};
}

void draw_route(const PlannedRoute& route, const pose_wall_planar_plan_settings& settings, MapScene* scene) {
  constexpr std::size_t kOutlinesMost = 40;
  const std::vector<MapPlace> outline = machine_outline(settings);
  const double length_m = route.poses.empty() ? 0.0 : route.poses.back().along_m;
  const double step_m = std::max(2.0, length_m / static_cast<double>(kOutlinesMost));
  double drawn_m = 0.0;
  for (std::size_t k = 1; k < route.poses.size(); ++k) {
    const pose_wall_planar_path_pose& at = route.poses[k];
    const std::string_view colour = at.drive < 0 ? kReverseColour : kPathColour;
    const bool goes_on = !scene->lines.empty() && scene->lines.back().colour == colour;
    const MapPlace here{at.pose.x_m, at.pose.y_m};
    if (!goes_on) scene->lines.push_back({{{route.poses[k - 1].pose.x_m, route.poses[k - 1].pose.y_m}}, colour, 2.4});
    scene->lines.back().places.push_back(here);
    if (at.along_m - drawn_m >= step_m) {
      scene->machines.push_back({at.pose, outline, "#9fc6ad", ""});
      drawn_m = at.along_m;
    }
    if ((at.flags & POSE_WALL_PLANAR_PATH_CUSP) != 0) scene->dots.push_back({here, kReverseColour, ""});
  }
  scene->legend.push_back({kPathColour, tr("route, forwards")});
  scene->legend.push_back({kReverseColour, tr("route, backwards")});
}

}  // namespace pose_wall::tools

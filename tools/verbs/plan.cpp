// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall plan: a map in, a route through it out.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "angles.hpp"
#include "language/language.hpp"
#include "planar/map_files.hpp"
#include "planar/map_picture.hpp"
#include "planar/planned_route.hpp"
#include "results/row_output.hpp"
#include "terminal/text_table.hpp"
#include "verbs/complaint.hpp"
#include "verbs/one_of.hpp"
#include "verbs/output_file.hpp"
#include "verbs/pose_word.hpp"
#include "verbs/verbs.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kShown_m = 8.0;  // of the map, about the route

struct PlanOptions {
  std::string map;
  std::string from, to;
  std::string output;   // file; empty: none
  std::string picture;  // file; empty: none
  std::vector<std::string> settings;
  bool free_specks = false;
  bool quiet = false;
};

std::string route_table(const PlannedRoute& route, const RoutePlanner& planner) {
  const pose_wall_planar_plan_result& result = route.result;
  TextTable table({tr("route"), ""});
  table.add_row({tr("length"), fmt::format("{:.2f} m", result.length_m)});
  table.add_row({tr("turns in all"), fmt::format("{:.0f}°", result.turning_rad * kDegPerRad)});
  table.add_row({tr("turns on the spot"), std::to_string(result.spot_turns)});
  table.add_row({tr("changes of direction"), std::to_string(result.cusps)});
  table.add_row({tr("cost"), fmt::format("{:.2f} m", result.cost_m)});
  table.add_row({tr("at most so many times the cheapest"), fmt::format("{:.3f}", result.bound)});
  table.add_row({tr("poses"), std::to_string(result.poses)});
  table.add_row({tr("places searched"), std::to_string(result.expansions)});
  table.add_row({tr("processor time"), fmt::format("{:.1f} ms", route.processor_ms)});
  table.add_row({tr("memory"), fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(planner.block_bytes()))});
  return table.text();
}

// Of a start or goal where the machine does not fit.
std::optional<BlockingCell> blocking_of(const MapFile& map, const pose_wall_planar_plan_settings& settings,
                                        const PlannedRoute& route, const pose_wall_planar_pose& from,
                                        const pose_wall_planar_pose& to) {
  if (route.result.outcome == POSE_WALL_PLAN_START_BLOCKED) return blocking_cell(map.grid(), settings, from);
  if (route.result.outcome == POSE_WALL_PLAN_GOAL_BLOCKED) return blocking_cell(map.grid(), settings, to);
  return std::nullopt;
}

bool is_blocked(const PlannedRoute& route) {
  return route.result.outcome == POSE_WALL_PLAN_START_BLOCKED || route.result.outcome == POSE_WALL_PLAN_GOAL_BLOCKED;
}

MapScene scene_of(const PlanOptions& options, const MapFile& map, const PlannedRoute& route,
                  const pose_wall_planar_plan_settings& settings, const pose_wall_planar_pose& from,
                  const pose_wall_planar_pose& to) {
  MapScene scene;
  scene.grid = map.grid();
  scene.title = std::filesystem::path(options.map).filename().string();
  scene.subtitle = route.is_found() ? say("route of {:.1f} m, {} changes of direction, {} turns on the spot",
                                          route.result.length_m, route.result.cusps, route.result.spot_turns)
                                    : say("no route: {}", pose_wall_planar_plan_outcome_name(route.result.outcome));
  scene.margin_m = kShown_m;
  draw_route(route, settings, &scene);
  scene.machines.push_back({from, machine_outline(settings), kTrailColour, tr("start")});
  scene.machines.push_back({to, machine_outline(settings), kClosureColour, tr("goal")});
  if (const std::optional<BlockingCell> cell = blocking_of(map, settings, route, from, to)) {
    scene.dots.push_back({cell->middle, kBadColour, tr("here")});
  }
  if (std::isfinite(route.result.place.x_m) && !route.is_found()) {
    scene.dots.push_back({{route.result.place.x_m, route.result.place.y_m}, kBadColour, tr("here")});
  }
  return scene;
}

// What the user may change, after a blank; empty: nothing.
std::string advice_text(const pose_wall_planar_plan_result& result) {
  switch (result.outcome) {
    case POSE_WALL_PLAN_START_BLOCKED:
      return std::string(" ") + tr("Another --from, or a smaller --set margin_m.");
    case POSE_WALL_PLAN_GOAL_BLOCKED:
      return std::string(" ") + tr("Another --to, or a smaller --set margin_m.");
    case POSE_WALL_PLAN_LIST_FULL:
      return std::string(" ") + tr("--set places_max and open_max give it more.");
    case POSE_WALL_PLAN_WORK_LIMIT:
      return std::string(" ") + tr("--set expansions_max gives it more.");
    default:
      return "";
  }
}

int plan_route(PlanOptions options) {
  require_plan_settings(options.settings);
  const pose_wall_planar_pose from = pose_of_word(options.from, "--from");
  const pose_wall_planar_pose to = pose_of_word(options.to, "--to");
  MapFile map = read_map_files(options.map);
  const std::size_t specks = options.free_specks ? free_specks(&map) : 0;
  const pose_wall_planar_plan_settings settings = take_plan_settings(map.grid(), &options.settings);
  std::vector<std::filesystem::path> read = {options.map};
  std::optional<OutputFile> output, picture;
  if (!options.output.empty()) {
    output.emplace(options.output, read);
    read.emplace_back(options.output);
  }
  if (!options.picture.empty()) picture.emplace(options.picture, read, "--picture");
  if (!options.quiet && !map.note.empty()) fmt::print(stderr, "{}: {}\n", options.map, map.note);

  if (!options.quiet && options.free_specks) fmt::print(stderr, "{}", say("{} specks count as free\n", specks));

  RoutePlanner planner(settings);
  const PlannedRoute route = planner.plan(map.grid(), from, to);
  if (picture) picture->write(map_picture(scene_of(options, map, route, settings, from, to)));
  if (!route.is_found()) {
    std::string text = no_route_text(route.result) + advice_text(route.result);
    if (is_blocked(route)) text += " " + blocking_text(blocking_of(map, settings, route, from, to));
    fmt::print(stderr, "{}", say("pose_wall plan: no route. {}\n", text));
    return kExitNotUsable;
  }
  if (output) output->write(route_as_csv(route));
  if (!options.quiet) fmt::print("{}", route_table(route, planner));
  return kExitDone;
}

}  // namespace

void add_plan(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* verb = app.add_subcommand("plan", tr("Plan a route through a map for a machine on tracks"));
  verb->add_option("MAP", options->map, tr("The map's YAML file, as pose_wall map, Nav2 and map_server write it"))
      ->required()
      ->check(existing_file());
  verb->add_option("--from", options->from, tr("Start: x,y,yaw of the machine's turning centre; m, m, degrees"))
      ->required()
      ->type_name("X,Y,YAW");
  verb->add_option("--to", options->to, tr("Goal, likewise"))->required()->type_name("X,Y,YAW");
  verb->add_option("-o,--output", options->output, tr("File for the route's poses (CSV)"));
  verb->add_option("--picture", options->picture, tr("File for a picture of the map and the route (SVG)"))
      ->check(svg_file());
  verb->add_option("-s,--set", options->settings, tr("KEY=VALUE of the planner; may be repeated"))
      ->allow_extra_args(false);
  verb->add_flag("--free-specks", options->free_specks,
                 tr("Count unknown cells in the open as free: people that walked by leave such specks"));
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
  verb->footer(
      tr("Examples:\n"
         "  pose_wall plan map/map.yaml --from 0,0,0 --to 12.5,-3,180 -o route.csv --picture route.svg\n"
         "  pose_wall plan map/map.yaml --from 0,0,0 --to 20,0,0 -s front_m=1.8 -s rear_m=2.7 -s margin_m=0.2\n"
         "Yaw counts from x to y.\n"
         "The machine is a rectangle: front_m, rear_m (2.25), left_m, right_m (0.6), with margin_m (0.1) round it.\n"
         "It drives forwards and backwards, in curves, and turns on the spot. Unknown cells are not driven on.\n"
         "Further settings: lattice_m, turn_cost_m_rad, reverse_cost, cusp_cost_m, weight, radius_min_m,\n"
         "radius_max_m, pose_step_m, places_max, open_max, expansions_max, hurry_after, occupied_from.\n"
         "drive of a pose is 1 forwards, -1 backwards, 0 a turn on the spot that leads to it.\n"
         "Exit status: 0 done, 1 the map could not be read or a file not written, 2 bad usage, 3 there is no route\n"
         "(stderr has the reason, the picture the place)."));
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("plan", [&] { return plan_route(*options); }); });
}

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall plan: a map in, a route through it out.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/options/one_of.hpp"
#include "apps/options/pose_word.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/outputs/output_file.hpp"
#include "io/planar_files/map_files.hpp"
#include "io/planar_files/planar_input.hpp"
#include "io/terminal/text_table.hpp"
#include "study/planar/map_picture.hpp"
#include "study/planar/planned_route.hpp"
#include "study/results/row_output.hpp"

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

// "start blocked".
std::string outcome_words(std::uint32_t outcome) {
  std::string words = pose_wall_planar_plan_outcome_name(outcome);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

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
  if (route.result.outcome == POSE_WALL_PLANAR_PLAN_START_BLOCKED) return blocking_cell(map.grid(), settings, from);
  if (route.result.outcome == POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED) return blocking_cell(map.grid(), settings, to);
  return std::nullopt;
}

std::string why_none(const PlanOptions& options, const MapFile& map, const pose_wall_planar_plan_settings& settings,
                     const PlannedRoute& route, const pose_wall_planar_pose& from, const pose_wall_planar_pose& to) {
  if (route.result.outcome == POSE_WALL_PLANAR_PLAN_START_BLOCKED) {
    return blocked_place_text(map.grid(), settings, from, "--from " + options.from);
  }
  if (route.result.outcome == POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED) {
    return blocked_place_text(map.grid(), settings, to, "--to " + options.to);
  }
  std::string text = no_route_text(route.result);
  if (route.result.outcome == POSE_WALL_PLANAR_PLAN_LIST_FULL) {
    text += std::string(" ") + tr("--set places_max and open_max give it more.");
  } else if (route.result.outcome == POSE_WALL_PLANAR_PLAN_WORK_LIMIT) {
    text += std::string(" ") + tr("--set expansions_max gives it more.");
  }
  return text;
}

MapScene scene_of(const PlanOptions& options, const MapFile& map, const PlannedRoute& route,
                  const pose_wall_planar_plan_settings& settings, const pose_wall_planar_pose& from,
                  const pose_wall_planar_pose& to) {
  MapScene scene;
  scene.grid = map.grid();
  scene.title = std::filesystem::path(options.map).filename().string();
  scene.subtitle = route.is_found() ? say("route of {:.1f} m, {} changes of direction, {} turns on the spot",
                                          route.result.length_m, route.result.cusps, route.result.spot_turns)
                                    : say("no route: {}", outcome_words(route.result.outcome));
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

int plan_route(PlanOptions options) {
  require_plan_settings(options.settings);
  const pose_wall_planar_pose from = pose_of_word(options.from, "--from");
  const pose_wall_planar_pose to = pose_of_word(options.to, "--to");
  const std::filesystem::path cells = cells_file_of(options.map);
  MapFile map = read_map_files(cells);
  const std::size_t specks = options.free_specks ? free_specks(&map) : 0;
  const pose_wall_planar_plan_settings settings = take_plan_settings(map.grid(), &options.settings);
  std::vector<std::filesystem::path> read = {cells};
  std::optional<OutputFile> output, picture;
  if (!options.output.empty()) {
    output.emplace(options.output, read);
    read.emplace_back(options.output);
  }
  if (!options.picture.empty()) picture.emplace(options.picture, read, "--picture");
  if (!options.quiet && !map.note.empty()) fmt::print(stderr, "{}: {}\n", cells.string(), map.note);

  if (!options.quiet && options.free_specks) fmt::print(stderr, "{}", say("{} specks count as free\n", specks));

  RoutePlanner planner(settings);
  const PlannedRoute route = planner.plan(map.grid(), from, to);
  if (picture) picture->write(map_picture(scene_of(options, map, route, settings, from, to)));
  if (!route.is_found()) {
    fmt::print(stderr, "{}", say("pose_wall plan: no route. {}\n", why_none(options, map, settings, route, from, to)));
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
  verb->add_option("MAP", options->map,
                   tr("Folder of pose_wall map -o (its map.yaml is read), or a map's YAML file, as Nav2 and map_server "
                      "write it, too"))
      ->required();
  verb->add_option("--from,--start", options->from,
                   tr("Start: x,y,yaw of the machine's turning centre in the map's frame; m, m, degrees"))
      ->required()
      ->type_name("X,Y,YAW");
  verb->add_option("--to,--goal", options->to, tr("Goal, likewise"))->required()->type_name("X,Y,YAW");
  verb->add_option("-o,--output", options->output, tr("File for the route's poses (CSV)"));
  verb->add_option("--picture", options->picture, tr("File for a picture of the map and the route (SVG)"))
      ->check(svg_file());
  verb->add_option("-s,--set", options->settings, tr("KEY=VALUE of machine and planner, below; may be repeated"))
      ->allow_extra_args(false);
  verb->add_flag("--free-specks", options->free_specks,
                 tr("Count unknown cells in the open as free: people that walked by leave such specks"));
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
  const std::string text =
      tr("Examples:\n"
         "  pose_wall plan map --from 0,0,0 --to 12.5,-3,180 -o route.csv --picture route.svg\n"
         "  pose_wall plan map/map.yaml --from 0,0,0 --to 20,0,0 -s front_m=1.8 -s rear_m=2.7 -s margin_m=0.2\n"
         "Places are of the machine's turning centre, midway between its tracks, in the frame of the map. In a map of\n"
         "`map` 0,0,0 is where base stood at the first scan: x ahead of it, y to its left. Yaw counts from x to y: 90\n"
         "looks along y. Pictures have x and y at their edges.\n"
         "The machine is a rectangle from its turning centre to front_m, rear_m, left_m, right_m, with\n"
         "margin_m round it.\n"
         "It drives forwards and backwards, in curves, and turns on the spot. Unknown cells are not driven on.\n"
         "drive of a pose is 1 forwards, -1 backwards, 0 a turn on the spot that leads to it.\n"
         "Exit status: 0 done, 1 the map could not be read or a file not written, 2 bad usage, 3 there is no route\n"
         "(stderr has the reason, the picture the place).");
  verb->footer(text + settings_help(plan_setting_rows()));
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("plan", [&] { return plan_route(*options); }); });
}

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/way_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/drive/machine.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::int8_t kSurelyThing = 100;
// A route keeps so much further from what held the machine: a cell of the stop, which is 0.1 m.
constexpr double kFurther_m = 0.1;
// On the way out it comes no nearer. Half a cell of the stop and one of the map are lost to their corners.
constexpr double kRounding_m = -0.1;

void occupy(MapFile* map, const MapPlace& at, double radius_m) {
  const double cell_m = map->resolution_m;
  const auto within = [cell_m](double from_m, std::uint32_t cells) {
    return static_cast<std::uint32_t>(std::clamp(from_m / cell_m, 0.0, static_cast<double>(cells)));
  };
  const double x_m = at.x_m - map->origin_x_m, y_m = at.y_m - map->origin_y_m;
  const std::uint32_t last_row = within(y_m + radius_m + cell_m, map->height);
  const std::uint32_t last_column = within(x_m + radius_m + cell_m, map->width);
  for (std::uint32_t row = within(y_m - radius_m, map->height); row < last_row; ++row) {
    for (std::uint32_t column = within(x_m - radius_m, map->width); column < last_column; ++column) {
      const double off_m = std::hypot((column + 0.5) * cell_m - x_m, (row + 0.5) * cell_m - y_m);
      if (off_m <= radius_m) map->cells[std::size_t{row} * map->width + column] = kSurelyThing;
    }
  }
}

}  // namespace

// Round the machine, falling. The stop lets no turn pass rock much nearer than the last but one, and a machine that it
// holds askew in a narrow road may get away to no side. The last is for the way out of a place where it is held.
const std::vector<double>& WayFinder::margins_m() {
  static const std::vector<double> margins = [] {
    constexpr double kOut_m = 0.1;
    const double most_m = stop_needs_most_m(), least_m = stop_needs_least_m();
    return std::vector<double>{kMargin_m, most_m, 0.5 * (most_m + least_m), least_m, kOut_m};
  }();
  return margins;
}

void WayFinder::hold(const HeldFor& thing) {
  things_.erase(std::remove_if(things_.begin(), things_.end(), [](const HeldFor& held) { return held.may_leave; }),
                things_.end());
  things_.push_back(thing);
}

// The map and what holds the machine, each as large as makes a machine with this margin keep `beyond_m` further off.
MapFile WayFinder::map_with(double margin_m, double beyond_m) const {
  const double least_m = beyond_m > 0.0 ? map_.resolution_m : 0.0;  // where the margin does it, a thing is still there
  MapFile map = map_;
  for (const HeldFor& thing : things_) occupy(&map, thing.at, std::max(least_m, thing.off_m + beyond_m - margin_m));
  return map;
}

// The cheapest.
PlannedRoute WayFinder::plan(std::size_t margin, double beyond_m, const pose_wall_planar_pose& from,
                             const std::vector<pose_wall_planar_pose>& goals) {
  const double margin_m = margins_m().at(margin);
  std::optional<RoutePlanner>& planner = planners_.at(margin);
  if (!planner) planner.emplace(drive_plan_settings(map_.grid(), margin_m));
  const MapFile map = map_with(margin_m, beyond_m);
  PlannedRoute best;
  for (const pose_wall_planar_pose& goal : goals) {
    PlannedRoute route = planner->plan(map.grid(), from, goal);
    const bool is_first = &goal == &goals.front();
    if (is_first || (route.is_found() && !(best.result.cost_m <= route.result.cost_m))) best = std::move(route);
  }
  if (best.is_found()) last_ = &*planner;
  return best;
}

PlannedRoute WayFinder::to_goal(const pose_wall_planar_pose& from, const std::vector<pose_wall_planar_pose>& goals) {
  const std::size_t least = margins_m().size() - 2;
  PlannedRoute narrowest = plan(least, kFurther_m, from, goals);
  // Where the least margin has no route, no other has.
  for (std::size_t k = 0; k < least && narrowest.is_found(); ++k) {
    PlannedRoute route = plan(k, kFurther_m, from, goals);
    if (route.is_found()) return route;
  }
  if (narrowest.is_found()) last_ = &*planners_.at(least);
  return narrowest;
}

PlannedRoute WayFinder::out(const pose_wall_planar_pose& from, const pose_wall_planar_pose& to) {
  return plan(margins_m().size() - 1, kRounding_m, from, {to});
}

}  // namespace pose_wall::tools

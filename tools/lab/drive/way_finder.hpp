// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Routes of the drive: through the map, and round what the stop holds the machine for.

#pragma once

#include <optional>
#include <vector>

#include "io/planar_files/map_files.hpp"
#include "study/planar/planned_route.hpp"

namespace pose_wall::tools {

// What holds the machine.
struct HeldFor {
  MapPlace at;
  double off_m = 0.0;     // from the footprint, when it held the machine
  bool may_leave = true;  // a person, a place that is not seen; false: a thing that stands
};

class WayFinder {
 public:
  // The map must outlive it.
  explicit WayFinder(const MapFile& map) : map_(map), planners_(margins_m().size()) {}

  // Routes that follow keep further from it than the machine is now. Of what may leave, only the last one counts.
  void hold(const HeldFor& thing);

  // To any of the goals, with the widest margin that has a route. Throws PlanarError.
  PlannedRoute to_goal(const pose_wall_planar_pose& from, const std::vector<pose_wall_planar_pose>& goals);
  // Out of a place where it is held: however near to the map's things, but not nearer to what holds it.
  PlannedRoute out(const pose_wall_planar_pose& from, const pose_wall_planar_pose& to);

  // Of the last route that was found.
  RoutePlanner* planner() const { return last_; }

 private:
  static const std::vector<double>& margins_m();
  PlannedRoute plan(std::size_t margin, double beyond_m, const pose_wall_planar_pose& from,
                    const std::vector<pose_wall_planar_pose>& goals);
  MapFile map_with(double margin_m, double beyond_m) const;

  const MapFile& map_;
  std::vector<std::optional<RoutePlanner>> planners_;  // by margin; one takes tens of MB
  RoutePlanner* last_ = nullptr;
  std::vector<HeldFor> things_;
};

}  // namespace pose_wall::tools

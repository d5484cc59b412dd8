// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A mine's network of roads in the plane: its centre lines, its walls of rough rock, and what a ray meets. Everything
// follows from the plan and the seed; the walls are short pieces of lines, and they are the truth.
//
//   const sim::Network network(plan, seed);
//   const sim::PlaneHit hit = network.cast(origin, direction, 30.0);
//   const sim::Route route = network.graph().tour(0, 500.0, seed);
#pragma once

#include <cstdint>
#include <memory>

#include "lab/sim/network_graph.hpp"
#include "lab/sim/network_plan.hpp"
#include "lab/sim/network_segments.hpp"
#include "lab/sim/surface.hpp"

namespace pose_wall::tools::sim {

class Network {
 public:
  // Throws std::invalid_argument for a plan outside its limits.
  Network(const NetworkPlan& plan, std::uint64_t seed);

  const NetworkPlan& plan() const { return plan_; }
  const NetworkGraph& graph() const { return graph_; }
  // Rock, and closed outlines of steel sets and props.
  const std::vector<WallSegment>& walls() const { return walls_.segments(); }
  const SegmentGrid& wall_grid() const { return walls_; }

  // What is met first, rock or thing.
  PlaneHit cast(const Place& origin, const Place& direction, double range_max_m) const {
    return walls_.cast(origin, direction, range_max_m);
  }
  // In the open: neither in the rock nor in a thing.
  bool is_open(const Place& p) const;
  // To the nearest rock or thing; infinity beyond reach_m.
  double clearance_m(const Place& p, double reach_m) const { return walls_.distance_m(p, reach_m); }

  // Floor and roof, in 3D: z is up, the floor's mean is at 0.
  const Surface& floor() const { return floor_; }
  const Surface& roof() const { return roof_; }
  // Without what is shorter than a machine.
  double floor_height_m(const Place& p) const;

 private:
  NetworkPlan plan_;
  NetworkGraph graph_;
  SegmentGrid walls_;
  std::unique_ptr<NoiseTile> tile_;
  Surface floor_, roof_;
};

}  // namespace pose_wall::tools::sim

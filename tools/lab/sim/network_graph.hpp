// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The centre lines of a network of roads as a graph: where roads meet and end, how they run between, and ways through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/sim/network_noise.hpp"
#include "lab/sim/network_plan.hpp"

namespace pose_wall::tools::sim {

inline double length_of(const std::vector<Place>& line) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length_m += (line[i] - line[i - 1]).norm();
  return length_m;
}

struct NetworkNode {
  Place at;
  std::vector<std::uint32_t> edges;  // one: a dead end; three and more: a junction
};

struct NetworkEdge {
  std::uint32_t from = 0, to = 0;    // nodes
  std::vector<Place> line;           // of the middle of the road, a point a metre or closer
  std::vector<double> half_width_m;  // at each of them, without relief
  double length_m = 0.0;
  int road = -1;  // of the parallel ones, counted from 0; -1: a cross road or a blind drift
};

// Two stretches of road that a scanner can take for each other.
struct AlikePair {
  std::uint32_t first = 0, second = 0;  // edges
  bool reversed = false;                // the second is like the first driven the other way
  double length_m = 0.0;                // for which both look alike, from their beginnings on
};

// One way ahead between two points where the machine stops and turns on the spot.
struct RouteLeg {
  std::vector<Place> line;  // corners are rounded, points 0.25 m apart
  double length_m = 0.0;
};

struct Route {
  std::vector<std::uint32_t> nodes;
  std::vector<RouteLeg> legs;
  double length_m = 0.0;
};

struct NetworkGraph {
  std::vector<NetworkNode> nodes;
  std::vector<NetworkEdge> edges;
  double length_m = 0.0;

  std::size_t count_nodes(std::size_t edges_of_it) const;
  // The shortest way; empty where there is none, or from a node to itself.
  Route route(std::uint32_t from, std::uint32_t to) const;
  // Through these nodes in turn; throws std::invalid_argument where two of them are not joined by an edge.
  Route route_through(const std::vector<std::uint32_t>& nodes) const;
  // A drive that goes where it has been least, and so through all of the network in time; at dead ends the machine
  // turns. Its edges are at least least_m long together, the drive itself a few percent less.
  Route tour(std::uint32_t from, double least_m, std::uint64_t seed) const;
  // Stretches of at least least_m that differ by less than 3 degrees and 0.3 m of width everywhere.
  std::vector<AlikePair> alike_pairs(double least_m = 12.0) const;
};

// Centre lines of a plan. Roads that share no node have rock between them. Throws std::invalid_argument for a plan
// outside its limits, or without room for cross roads.
NetworkGraph draw_network(const NetworkPlan& plan, std::uint64_t seed);

// From places of the network to places on straight roads that lie on each other: the mould of twin rock.
class RoadMould {
 public:
  RoadMould(const NetworkPlan& plan, std::uint64_t seed);

  Place bent(const Place& straight) const;
  Place straightened(const Place& p) const;
  // Of parallel roads the same.
  Place in_mould(const Place& p) const;
  double spacing_m() const { return spacing_m_; }
  int roads() const { return roads_; }
  // Length of all roads for one metre of the first: more or less than their number in a turn.
  double roads_together() const;

 private:
  double swing_m(double along_m) const;

  int roads_;
  double spacing_m_;
  double bend_m_;
  double radius_m_ = 0.0;  // of the whole network's turn; 0: straight
  double wave_per_m_[3], phase_rad_[3];
};

}  // namespace pose_wall::tools::sim

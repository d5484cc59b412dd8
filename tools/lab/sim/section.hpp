// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The road's own surfaces, built from the setup.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/sim/label.hpp"
#include "lab/sim/setup.hpp"
#include "lab/sim/surface.hpp"

namespace pose_wall::tools::sim {

struct RoadSurface {
  Surface surface;
  Label label;
  int side;  // +1 left wall, -1 right wall, 0 neither: only walls have openings
  bool steel;
};

// A part of a wall that lies further back: crosscut, widening, niche before the face.
struct Recess {
  int side;
  double s_from_m;
  double s_to_m;
  double height_m;
  std::vector<Surface> bounds;
};

// Reliefs need the tile to live as long as they do; without one, surfaces are their means.
std::vector<RoadSurface> road_surfaces(const Setup& setup, const NoiseTile* tile, std::uint64_t seed);
std::vector<Recess> road_recesses(const Setup& setup, const NoiseTile* tile, std::uint64_t seed);

Plane floor_plane(const Road& road);
// The mean wall of a side at a half width at z = 0; lean + away at the top. Straight roads: a Plane.
Surface wall_mean(const Road& road, int side, double half_width_m, double lean_tangent);
double wall_lean_tangent(const Road& road, int side);
double floor_height_m(const Road& road, const Vector& p);

}  // namespace pose_wall::tools::sim

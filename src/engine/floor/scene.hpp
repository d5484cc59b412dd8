// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The input of the floor's stage and its scratch.

#pragma once

#include "base/containers/arena.hpp"
#include "base/containers/bounded_points.hpp"
#include "base/containers/work.hpp"
#include "base/estimation/mlesac.hpp"
#include "base/estimation/patch_fit.hpp"
#include "base/estimation/surface_patches.hpp"
#include "base/estimation/tangent_points.hpp"
#include "base/estimation/uneven_plane.hpp"
#include "engine/config.hpp"
#include "engine/floor/evidence.hpp"
#include "engine/region/region_plane.hpp"
#include "engine/types.hpp"

namespace pose_wall {

struct FloorScene {
  const BoundedPoints& cloud_base;
  const Settings& settings;
  const Axes& axes;
  Eigen::Vector3d sensor_base_m;
  const Plane* last_floor;  // the last frame's, or nullptr; scored like any other hypothesis
};

// Points so near a floor's plane are its own: 9 cm by default. The fit takes them, and ground further off may be
// another floor.
constexpr double kOwnInThresholds = 3.0;  // swept: half 1 lost 11 won 1 beyond, twice 1 won

// Points of a fit, as many as a wall's. More points add nothing, since rock and waves limit the fit.
constexpr std::uint32_t kFloorFitPoints = 8192;

struct FloorScratch {
  PointSet open_base;    // points with nothing standing on them, within the greatest radius
  PointSet within_base;  // those of them within the radius being tried
  // Indices, for three uses in turn. First the place of each point, until the open ones are known. Then the lowest part
  // of the points within, and then the open points that a fit takes.
  Span<std::uint32_t> low;
  TangentPoints points;  // the points of a fit
  PointSet subset;
  FloorGrid grid;
  PatchGrid patches;
  SurfacePatches surface;
  RegionFit region;
  Work work;

  void lay_out(Arena& arena, std::uint32_t points_max) {
    open_base.lay_out(arena, points_max);
    within_base.lay_out(arena, points_max);
    low = arena.take<std::uint32_t>(points_max + kFour);
    points.lay_out(arena, kFloorFitPoints);
    subset.lay_out(arena, kSubsetPoints);
    grid.lay_out(arena);
    patches.lay_out(arena);
    surface.lay_out(arena);
    region.lay_out(arena);
  }
};

}  // namespace pose_wall

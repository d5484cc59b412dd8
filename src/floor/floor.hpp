// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 3: the floor, and with it roll and pitch.

#pragma once

#include "base/containers/arena.hpp"
#include "base/containers/work.hpp"
#include "base/estimation/patch_fit.hpp"
#include "base/estimation/surface_patches.hpp"
#include "base/estimation/tangent_points.hpp"
#include "base/estimation/uneven_plane.hpp"
#include "base/math/random.hpp"
#include "config.hpp"
#include "floor/evidence.hpp"
#include "types.hpp"

namespace pose_wall {

constexpr std::uint32_t kFloorFitPoints = 8192;

struct FloorScratch {
  PointSet open_base;    // points with nothing standing on them, within the greatest radius
  PointSet within_base;  // of those, within the radius that is tried
  // Where each point lies, until it is known which are open; then which of those within are the lowest part, then which
  // of the open ones a fit takes.
  Span<std::uint32_t> low;
  TangentPoints points;  // of these, as many as a fit takes
  PointSet subset;
  FloorGrid grid;
  PatchGrid patches;
  SurfacePatches surface;
  UnevenPlane uneven;
  Work work;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

// Looks for the floor within ground_roi_radius, and in growing steps up to ground_roi_radius_max where it is not seen
// well enough to be valid. last_floor: the last frame's plane or nullptr, scored like any other hypothesis.
FloorResult find_floor(const BoundedPoints& cloud_base, const Settings& settings, const Axes& axes,
                       const Eigen::Vector3d& sensor_base_m, const Plane* last_floor, Random* random,
                       FloorScratch* scratch);

}  // namespace pose_wall

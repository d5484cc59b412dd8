// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Scratch of the walls' stage.

#pragma once

#include "engine/region/region_plane.hpp"
#include "engine/walls/doubts/edges.hpp"
#include "engine/walls/doubts/sight.hpp"
#include "engine/walls/fit/surface.hpp"
#include "engine/walls/propose/candidates.hpp"

namespace pose_wall {

struct WallsScratch {
  ProposeScratch propose;
  WallCandidates beside[2];  // of this frame, left and right: too large for the stack of all fits
  WallGrid grid;
  WallFitScratch fit;
  SightScratch sight;
  EdgeScratch edges;
  RegionFit region;
  PatchErrors errors[2];  // of the fitted walls, left and right

  void lay_out(Arena& arena, std::uint32_t points_max) {
    propose.lay_out(arena, points_max);
    grid.lay_out(arena);
    fit.lay_out(arena, points_max);
    sight.lay_out(arena);
    edges.lay_out(arena);
    region.lay_out(arena);
    propose.near = fit.near;
    propose.points = &fit.points.at;
    propose.grid = &grid;
    propose.work = &fit.work;
  }
};

}  // namespace pose_wall

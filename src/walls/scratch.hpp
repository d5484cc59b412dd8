// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the walls' stage works in.

#pragma once

#include "walls/doubts/edges.hpp"
#include "walls/doubts/sight.hpp"
#include "walls/fit/surface.hpp"
#include "walls/propose/search.hpp"

namespace pose_wall {

constexpr std::uint32_t kThinMost = 4096;

struct WallsScratch {
  WallSearch search[2];
  BoundedPoints thin_level;  // a part of the band, enough to refine hypotheses
  WallGrid grid;
  WallFitScratch fit;
  SightScratch sight;
  EdgeScratch edges;

  void lay_out(Arena& arena, std::uint32_t points_max) {
    for (WallSearch& s : search) s.lay_out(arena, points_max);
    thin_level.lay_out(arena, kThinMost);
    grid.lay_out(arena);
    fit.lay_out(arena, points_max);
    sight.lay_out(arena);
    edges.lay_out(arena);
  }
};

}  // namespace pose_wall

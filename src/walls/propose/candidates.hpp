// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What may be a wall: planes beside a direction, drawn, refined and weighed by the solid area that they show.

#pragma once

#include "base/containers/work.hpp"
#include "base/estimation/tangent_points.hpp"
#include "walls/propose/evidence.hpp"
#include "walls/propose/search.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

struct WallCandidate {
  Plane plane;
  WallEvidence evidence;
  std::uint32_t failed = 0;  // reasons of the gates that it does not pass
};

struct WallCandidates {
  WallCandidate item[kWallShortlist];
  std::uint32_t count = 0;

  // The one of the best score, whatever gates it fails; nullptr if there is none.
  const WallCandidate* strongest() const;
};

// What candidates are made in.
struct ProposeScratch {
  WallSearch search[2];
  BoundedPoints thin_level;  // a part of the band, enough to refine hypotheses
  // Of other steps, which come later.
  Span<std::uint32_t> near;
  TangentPoints* points = nullptr;
  WallGrid* grid = nullptr;
  Work* work = nullptr;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

// An even part of the band, of each side as much, into scratch->thin_level.
void thin_out(const WallScene& scene, ProposeScratch* scratch);

// The candidates on two sides that face each other, once the band is thinned. last: planes to be scored like any other
// hypothesis, or nullptr.
void propose_walls(const WallScene& scene, const SideView (&views)[2], const Plane* const last[2], Random* random,
                   ProposeScratch* scratch, WallCandidates (*out)[2]);

// The steps of that, for a caller who may stop between them. Directions are exchanged once both sides are drawn: each
// side is tried with the normal that was found on the other one.
void draw_walls(const WallScene& scene, const SideView& view, const Plane* last, Random* random, WallSearch* search);
void exchange_directions(WallSearch (&search)[2]);
void weigh_walls(const WallScene& scene, const SideView& view, WallSearch* search, ProposeScratch* scratch,
                 WallCandidates* out);

// A few rounds of Tukey from a drawn hypothesis on points of the band, its lean set free. False where nothing holds it.
// It is called first wide, to see the lean of a wall that an upright hypothesis cuts, then narrow. near and points:
// scratch.
enum class RefineWidth { kWide, kNarrow };
bool refine_hypothesis(const BoundedPoints& band_level, double thresh_m, const Eigen::Vector3d& along_level,
                       RefineWidth width, Span<std::uint32_t> near, TangentPoints* points, Plane* plane);

// The reasons of the gates that a plane fails.
std::uint32_t failed_gates(const Plane& plane, const WallEvidence& evidence, const Settings& settings);

}  // namespace pose_wall

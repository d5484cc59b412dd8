// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What may be the floor: planes through open points, drawn, refined and weighed by the open ground they show.

#pragma once

#include "base/math/random.hpp"
#include "config.hpp"
#include "floor/evidence.hpp"
#include "floor/floor.hpp"
#include "floor/search.hpp"

namespace pose_wall {

constexpr std::uint32_t kFloorPointsMin = 60;
constexpr double kFloorAreaMin_m2 = 2.0;
// A plane that shows so much of what the best one does may be the floor as well.
constexpr double kRivalShareOfFloor = 0.5;

struct FloorCandidate {
  Plane plane;
  FloorEvidence evidence;
  bool ghost = false;  // seen through the open floor of a plane above it: a reflection in wet ground
};

struct FloorCandidates {
  FloorCandidate item[kFloorShortlist];
  std::uint32_t count = 0;

  Span<const FloorCandidate> all() const { return Span<const FloorCandidate>(item, count); }
  const FloorCandidate* best() const;  // by score, no ghost; nullptr where there is none
};

struct FloorSearch {
  const PointSet& within_base;      // the open points to search
  const BoundedPoints& cloud_base;  // all points
  const Eigen::Vector3d& sensor_base_m;
  const Plane* last_floor;  // hypothesis 0: scored like any other; nullptr if none
  bool are_left_over;       // by a floor, much of which may lie below a plane through them
};

// Whether a plane is seen through the open floor of another one above it, which marks the grid.
bool is_reflection(const PointSet& open_base, const Plane& above, const Plane& below, const Settings& settings,
                   const Eigen::Vector3d& sensor_base_m, const FloorGrid& grid);

// Returns how many hypotheses were scored.
std::uint32_t find_candidates(const FloorSearch& in, const Settings& settings, const Axes& axes, Random* random,
                              FloorScratch* scratch, FloorCandidates* out);

}  // namespace pose_wall

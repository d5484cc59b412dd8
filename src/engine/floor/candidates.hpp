// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Planes that may be the floor: drawn through open points, scored on a few of them, refined, and weighed by the open
// ground that they cover.

#pragma once

#include "base/containers/point_set.hpp"
#include "base/estimation/shortlist.hpp"
#include "base/math/random.hpp"
#include "engine/floor/evidence.hpp"
#include "engine/floor/scene.hpp"

namespace pose_wall {

constexpr std::uint32_t kFloorShortlist = 8;  // floor, bench, deck and reflection are 4
using FloorShortlist = Shortlist<kFloorShortlist>;

struct FloorCandidate {
  Plane plane;
  FloorEvidence evidence;
  bool ghost = false;       // seen through the open floor of a plane above it, so a reflection in wet ground
  bool much_below = false;  // more lies below it than on it, so a deck, a bench or a cut through walls

  bool may_carry() const { return !ghost && !much_below; }
};

struct FloorCandidates {
  FloorCandidate item[kFloorShortlist];
  std::uint32_t count = 0;

  Span<const FloorCandidate> all() const { return Span<const FloorCandidate>(item, count); }
  std::uint32_t plausible() const;     // those that may carry the machine
  const FloorCandidate* best() const;  // the best score among these, or nullptr
};

// The limits of a floor by the config, worked out once for all hypotheses.
struct FloorLimits {
  double up_min;  // of the normal's z, in base
  double height_min_m, height_max_m;

  explicit FloorLimits(const Settings& settings);
};

// A plane within the allowed tilt of base, below the sensor by an allowed height.
bool may_be_floor(const Plane& plane, const FloorLimits& limits, const Eigen::Vector3d& sensor_base_m);

// True if two planes are the same surface around the machine.
bool same_floor(const Plane& a, const Plane& b);

// True if a plane is seen through the open floor of another plane above it. The grid is marked with that one.
bool is_reflection(const FloorScene& scene, const PointSet& open_base, const Plane& above, const Plane& below,
                   const FloorGrid& grid);

// The points that hypotheses are drawn from.
struct FloorDraw {
  const PointSet& open_base;      // open points within the region of interest
  Span<const std::uint32_t> low;  // the lowest part of them
};

// Fills the list and returns the number of scored hypotheses. subset: scratch of kSubsetPoints points.
std::uint32_t search_floor(const FloorScene& scene, const FloorDraw& from, Random* random, PointSet* subset,
                           FloorShortlist* list);

// Candidates among the open points of one look, or among those that a floor leaves over. Below the second kind many
// points may lie.
enum class Among { kOpen, kLeftOver };
// Returns the number of scored hypotheses.
std::uint32_t find_candidates(const FloorScene& scene, const PointSet& within_base, Among among, Random* random,
                              FloorScratch* scratch, FloorCandidates* out);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Hypotheses for the floor: drawn, scored on a subset, and kept as a short list of different surfaces.

#pragma once

#include "base/containers/point_set.hpp"
#include "base/estimation/shortlist.hpp"
#include "base/math/random.hpp"
#include "config.hpp"
#include "types.hpp"

namespace pose_wall {

constexpr std::uint32_t kFloorShortlist = 8;
constexpr std::uint32_t kFloorSubset = 512;
using FloorShortlist = Shortlist<kFloorShortlist>;

struct FloorDraw {
  const PointSet& open_base;      // open points within the region of interest
  Span<const std::uint32_t> low;  // the lowest part of them
  const Eigen::Vector3d& sensor_base_m;
  const Plane* last_floor;  // hypothesis 0: scored like any other; nullptr if none
};

// Fills the list; returns how many hypotheses were scored. subset: scratch of kFloorSubset points.
std::uint32_t search_floor(const FloorDraw& in, const Settings& settings, Random* random, PointSet* subset,
                           FloorShortlist* list);

// What the config allows of a floor, worked out once for all hypotheses.
struct FloorLimits {
  double up_min;  // of the normal's z, in base
  double height_min_m, height_max_m;

  explicit FloorLimits(const Settings& settings);
};

// A plane within the allowed tilt of base, below the sensor by an allowed height.
bool may_be_floor(const Plane& plane, const FloorLimits& limits, const Eigen::Vector3d& sensor_base_m);

// Whether two planes are the same surface around the machine.
bool same_floor(const Plane& a, const Plane& b);

}  // namespace pose_wall

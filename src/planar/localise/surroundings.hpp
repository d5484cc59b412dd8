// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What was seen, from where base stands now: a scan, or the last metres. And what of the map contradicts it, or has the
// relief to tell a place by.

#pragma once

#include <cstdint>

#include "place/patches.hpp"
#include "planar/localise/place_map.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kSurroundingsMost = 1024;  // points: 60 patches, of which each has its 16
constexpr std::uint32_t kSightsMost = 64;          // one for every 6 degrees of a whole turn

struct Surroundings : PatchedPoints {
  Span<ScanPoint> room;    // for points
  Span<ScanPoint> sights;  // ends of lines of sight from base, spread over all directions
  std::uint32_t sight_count = 0;
  ScanPoint sight_from = {0.0F, 0.0F};

  void lay_out(Arena& arena);
  // One scan, and its lines of sight.
  void take(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m, double scan_sigma_m);
  void take_sights(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m);
};

// Share of the lines of sight that pass through surfaces of the map.
double seen_through(const PlaceMap& map, const Surroundings& around, const Pose2& pose);

// A patch's own wall, and what it costs to be moved along it.
struct PatchWall {
  SurfaceCell points;      // from the corner of the square metre
  float along_x, along_y;  // unit, in the map
  float ahead, behind;     // sums of costs where it is moved
};
// How many patches have relief of their own: moved along their wall they fit worse, to either side. Rock is like that
// nearly everywhere, smooth walls only at their corners. `walls` has room for kPatchesMost.
std::uint32_t relief_patches(const PlaceMap& map, const Surroundings& around, const Pose2& pose, Span<PatchWall> walls);

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What speaks for a plane being the floor: open ground seen in plan, not a count of points.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "containers/arena.hpp"
#include "containers/point_set.hpp"
#include "estimation/plane.hpp"
#include "types.hpp"

namespace pose_wall {

struct FloorEvidence {
  double score_m2 = 0.0;         // open area, the strip the machine drives on counting double
  double area_m2 = 0.0;          // open area
  double across_spread_m = 0.0;  // standard deviation of the open cells across their main direction
};

// A grid in plan around the base origin. A cell is open floor when it holds points on the plane and none of a wall or
// heap rising from it. A slab cut through two walls has points enough, but every one of them has more wall above it.
class FloorGrid {
 public:
  static constexpr std::int32_t kSide = 160;
  static constexpr double kCell_m = 0.25;

  void lay_out(Arena& arena);

  void mark(const PointSet& points_base, Span<const std::uint32_t> candidates, const Plane& plane, double thresh_m);
  FloorEvidence evidence(const Axes& axes) const;

  // Whether the marked plane has open floor at or next to this place.
  bool open_near(double x_base_m, double y_base_m) const;
  // Whether something rises from the floor in the cell of this place.
  bool blocked(double x_base_m, double y_base_m) const;

 private:
  static std::int32_t cell_of(double coordinate_m);
  static bool inside(std::int32_t ix, std::int32_t iy) { return ix >= 0 && ix < kSide && iy >= 0 && iy < kSide; }
  bool open(std::int32_t ix, std::int32_t iy) const;

  Span<std::uint16_t> on_plane_;
  Span<std::uint16_t> rising_;
};

// Share of the points on 'below' whose ray from the sensor passes through open floor of the plane marked in the grid:
// no light comes through a floor, so such a plane is a reflection in wet ground.
double share_seen_through(const FloorGrid& marked, const Plane& marked_plane, const Plane& below,
                          const PointSet& points_base, Span<const std::uint32_t> candidates,
                          const Eigen::Vector3d& sensor_base_m, double thresh_m);

}  // namespace pose_wall

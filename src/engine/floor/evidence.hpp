// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Evidence for a floor: the open ground that a plane covers in plan, not a count of points.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/bounded_points.hpp"
#include "base/estimation/plane.hpp"
#include "engine/types.hpp"

namespace pose_wall {

struct FloorEvidence {
  double score_m2 = 0.0;  // open area; the strip that the machine drives on counts double
  double area_m2 = 0.0;   // open area
};

// A grid in plan around the base origin.
class FloorGrid {
 public:
  static constexpr std::int32_t kSide = 160;  // cells: 40 m, the widest ground_roi_radius to both sides
  // Separates a post from the floor beside it; swept: half 57 lost 3 won, twice 14 lost 7 won.
  static constexpr double kCell_m = 0.25;

  void lay_out(Arena& arena);

  // Finds the open points within the radius: no points from a quarter of a metre to a metre above or below in the same
  // cell. Floor and roof are open; walls, heaps, people and machines are not. Without this, a slab cut through two
  // walls beats a sparsely seen floor by its points. places and open have room for all points, and places for a four
  // behind them.
  void find_open(const PointSet& points_base, double radius_m, double sensor_z_base_m, Span<std::uint32_t> places,
                 PointSet* open);

  // Marks the cells in which points rise from a plane: they lie more than gate_m and up to a metre above it.
  // Like every mark...(), takes the place of the marks before it.
  void mark_rising(const BoundedPoints& points_base, const Plane& plane, double gate_m);
  // Of four points, keeps those clear of what rises, after mark_rising(). At the foot of a rough wall or heap its
  // lowest points pass for floor, on one side more than on the other, and tilt the fit.
  FourTruths clear_around(FourFloats x_base_m, FourFloats y_base_m, FourTruths counts) const;

  // Marks the cells in which a plane has points. open_base: from find_open(), all within the grid.
  void mark(const PointSet& open_base, const Plane& plane, double thresh_m);
  // The same, without the points that another plane has as well.
  void mark_apart(const PointSet& open_base, const Plane& plane, const Plane& other, double thresh_m);
  // Evidence for the marked plane.
  FloorEvidence evidence(const Axes& axes) const;
  // True if the marked plane has floor at or next to this place.
  [[gnu::noinline]] bool marked_near(double x_base_m, double y_base_m) const;
  // The same, or farther out in the same direction from the sensor. True inside the floor, even over a puddle.
  bool marked_behind(const Eigen::Vector3d& sensor_base_m, const Eigen::Vector3d& place_base_m) const;
  // True if below the marked plane more area is seen than this share of the area on it. The rays of reflections do not
  // count, since they pass through the floor. Nothing lies below a floor, while past the edge of a deck, a bench or a
  // table the floor shows. A plane that cuts through both walls has their feet below it. Area does not depend on where
  // the sensor looks: one that looks up has nearly all of its points on the roof. radius_m: that of find_open().
  bool much_lies_below(const Plane& plane, const BoundedPoints& points_base, double radius_m,
                       const Eigen::Vector3d& sensor_base_m, double share_max);

 private:
  class FourBins;
  static std::int32_t cell_of(float coordinate_m);
  static FourInts cells_of(FourFloats coordinates_m);  // the outermost cell for places outside
  static bool inside(std::int32_t ix, std::int32_t iy) { return ix >= 0 && ix < kSide && iy >= 0 && iy < kSide; }
  static std::uint32_t index(std::int32_t ix, std::int32_t iy) { return static_cast<std::uint32_t>(iy * kSide + ix); }

  // is_on(x, y, z): which of four points the plane has.
  // Of four points, marks the cells of those that are on.
  void mark_four(FourFloats x, FourFloats y, FourTruths on);
  template <typename IsOn>
  void mark_where(const PointSet& open_base, const IsOn& is_on);
  [[gnu::noinline]] void mark_cell(std::int32_t ix, std::int32_t iy);  // called once for each cell
  void clear_marks();

  // First and last of the marked cells.
  struct Bounds {
    std::int32_t x_min = kSide, x_max = -1, y_min = kSide, y_max = -1;
  };
  Bounds bounds_;

  static constexpr std::uint8_t kMarked = 1, kBelow = 2;  // bits of a cell
  std::uint32_t marked_cells_ = 0;
  // Per cell one bit for each eighth of a metre that holds points.
  Span<std::uint64_t> eighths_;
  Span<std::uint8_t> marked_;
  Span<std::uint8_t> near_marked_;  // marked or next to a marked cell
};

// Share of the open points on 'below' whose ray from the sensor passes through open floor of the marked plane. No light
// comes through a floor, so such a plane is a reflection in wet ground.
double share_seen_through(const FloorGrid& marked, const Plane& marked_plane, const Plane& below,
                          const PointSet& open_base, const Eigen::Vector3d& sensor_base_m, double thresh_m);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Evidence for and against a wall: solid area, and area that rays pass.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/point_set.hpp"
#include "base/estimation/plane.hpp"
#include "base/simd/four_floats.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

constexpr std::uint32_t kWallColumns = 128;  // 64 m: 32 m to both sides
// A door or a niche fills one or more; swept: half 27 lost 6 won, twice 5 lost 7 won 1 beyond.
constexpr double kWallColumn_m = 0.5;

// Where a column begins along the wall.
inline double wall_column_from_m(std::uint32_t column) {
  return (static_cast<double>(column) - kWallColumns / 2) * kWallColumn_m;
}

struct WallEvidence {
  double score_m2 = 0.0;      // solid area, reduced by the share that is seen through
  double area_m2 = 0.0;       // solid area
  double seen_through = 0.0;  // share of its own columns that is seen through, 0..1
  double length_m = 0.0;      // solid columns along the road
  double along_min_m = 0.0;
  double along_max_m = 0.0;
  double away_m = 1e3;        // along it, from the machine to the nearest two solid columns side by side
  std::uint32_t inliers = 0;  // measured points on the plane
  double stopped = 0.0;       // share of the returns at or behind it that came from it, wherever it has gaps, 0..1
  std::uint8_t solid_rows[kWallColumns] = {};  // solid cells of each column: where along the wall its area lies
};

// A plane cut into cells along the road and up. A cell is solid when points lie on the plane there. It is seen through
// when rays pass the plane there and end well behind it. A wall is solid wherever it is seen. A pipe, a row of props or
// a conveyor is solid in some rows or columns and seen through in the others. The number of points does not matter, so
// neither does how near or shiny a thing is.
class WallGrid {
 public:
  static constexpr std::uint32_t kColumns = kWallColumns;  // of the evidence, too
  static constexpr std::uint32_t kRowsMax = 16;            // 4.8 m of height; the default band has 8
  static constexpr double kColumn_m = kWallColumn_m;       // of the evidence, too

  void lay_out(Arena& arena);

  // The rows of the wall band. With the columns they make the cells.
  struct Rows {
    std::uint32_t count = 1;
    double z_min_level_m = 0.0, height_m = 0.3;

    double per_m() const { return 1.0 / height_m; }
    // Cells of four places along a line and up, counted row by row; negative outside.
    FourInts cells_of(FourFloats along_m, FourFloats z_level_m) const;
  };
  static Rows rows_of(const WallScene& scene);

  // along: horizontal, in the plane's direction. Points within hit_m of the plane make it solid. Rays that end more
  // than behind_m behind it pass through it, wherever they end: behind pipes before a dark wall only floor and roof are
  // seen.
  struct Reach {
    double hit_m;
    double behind_m;
  };
  void mark(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, const Reach& reach);
  WallEvidence evidence() const;

  bool is_solid_at(double along_m) const;
  // Of the four points that count, those at which the plane is solid.
  FourTruths solid_at(FourFloats along_m, FourFloats z_level_m, FourTruths counts) const;

 private:
  class FourMarks;
  enum class Rays { kOneAPoint, kByWeight };
  void mark_points(const BoundedPoints& points, Rays rays, FourMarks* marks);
  std::uint16_t hits(std::uint32_t cell) const { return counters_[cell]; }
  std::uint16_t through(std::uint32_t cell) const { return counters_[kCells + cell]; }
  bool solid(std::uint32_t cell) const { return hits(cell) >= 2 && hits(cell) >= through(cell); }
  bool open(std::uint32_t cell) const { return through(cell) >= 2 && through(cell) > hits(cell); }
  void count_rows(std::uint32_t column);
  bool column_is_solid(std::uint32_t column) const {
    return solid_rows_[column] > 0 && solid_rows_[column] >= open_rows_[column];
  }

  static constexpr std::uint32_t kCells = kColumns * kRowsMax;  // of the fullest grid
  Span<std::uint16_t> counters_;  // hits of each cell, rays through each, and a spare counter for points in no cell
  std::uint8_t solid_rows_[kColumns] = {}, open_rows_[kColumns] = {};
  Rows rows_;
  double inliers_ = 0.0, passed_ = 0.0;  // measured points on it and behind it
};

// A fit takes points this far from its plane. Rough rock stays in, and things before it do not: one threshold more than
// belongs to a wall.
constexpr double kFitGateInThresholds = 4.0;  // swept: half 3 lost 23 won, twice 17 lost 4 won
// Centroids of dense voxels scatter no less; swept: half nothing, twice 63 moved.
constexpr double kFitScaleMin_m = 0.003;

// Marks the grid with a plane, with the RANSAC threshold to judge a hypothesis, or as wide as the fit reaches.
enum class MarkWidth { kThreshold, kFit };
void mark_wall(const WallScene& scene, const Plane& plane, const Eigen::Vector3d& along_level, MarkWidth width,
               WallGrid* grid);

}  // namespace pose_wall

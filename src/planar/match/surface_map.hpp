// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What scans are matched against: the surfaces that placed scans saw, in a square window. Each cell holds the mean and
// spread of its points and of those around it (a normal-distributions transform: Biber and Strasser, IROS 2003). Three
// fields of likelihood over the same window, each coarser than the last, serve the search.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "place/pose2.hpp"
#include "planar/match/scan_points.hpp"

namespace pose_wall::planar {

// The surface about one cell.
struct Surface {
  float x_m, y_m;             // mean, from the window's middle
  float normal_x, normal_y;   // unit: the direction of least spread
  float across_m2, along_m2;  // variances along the normal and along the surface
};

class SurfaceMap {
 public:
  static constexpr double kCell_m = 0.1;       // finer than relief of rock is long, coarser than a sensor's noise
  static constexpr std::int32_t kSide = 1024;  // cells: 51 m to each side
  static constexpr std::int32_t kShrink = 4;   // cells of a level in a cell of the next
  static constexpr std::uint32_t kCellsMost = 24576;

  void lay_out(Arena& arena);
  // First use of memory that may hold anything.
  void open();
  // An empty window about this place.
  void begin(const Eigen::Vector2d& middle_m);
  // Adds the points of a scan at this pose. Those outside the window, and beyond the capacity, are left out.
  // with_sight: its lines of sight are marked as seen, too; they cost more than the points.
  void add(Span<const ScanPoint> points, const Pose2& pose, bool with_sight);
  // After the last scan: surfaces and fields.
  void finish();

  const Eigen::Vector2d& middle_m() const { return middle_m_; }
  bool is_empty() const { return used_ == 0; }
  // The surface next to a place given from the window's middle, or nullptr.
  const Surface* near(double x_m, double y_m) const;
  // Whether lines of sight went through the 40 cm about a place given from the window's middle, or ended there.
  bool is_seen(double x_m, double y_m) const;
  // Likelihood, 0 to 255, of a cell of a level: 0 the finest. A coarse cell has the most of its cells and of those of
  // its right, upper and upper right neighbours.
  std::uint32_t likelihood(std::uint32_t level, std::int32_t cell_x, std::int32_t cell_y) const;

 private:
  struct Cell {
    float x_m, y_m, xx_m2, xy_m2, yy_m2;  // sums about the cell's middle
    std::uint32_t count;
    std::int32_t column, row;
  };

  Cell* cell_at(std::int32_t column, std::int32_t row);
  void see(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m);
  void make_surface(std::uint32_t index);
  void spread_surface(std::uint32_t index);
  void spread_likelihood(const Cell& cell);
  void raise(std::uint32_t level, std::int32_t x, std::int32_t y, std::uint8_t value);

  static constexpr std::uint16_t kNone = 0xFFFF;
  static constexpr std::uint32_t kLevels = 3;

  Eigen::Vector2d middle_m_ = Eigen::Vector2d::Zero();
  Span<std::uint16_t> index_;    // of the cell that holds points
  Span<std::uint16_t> nearest_;  // of the surface in or next to a cell
  Span<std::uint8_t> field_[kLevels];
  Span<std::uint8_t> seen_;  // of coarser cells: 1 where lines of sight went
  Span<Cell> cells_;
  Span<Surface> surfaces_;
  std::uint32_t used_ = 0;
};

}  // namespace pose_wall::planar

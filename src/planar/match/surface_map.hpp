// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What scans are matched against: the surfaces that placed scans saw, in a square window. Three fields of likelihood
// over the same window, each coarser than the last, serve the search.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "place/beams.hpp"
#include "place/pose2.hpp"
#include "place/surface.hpp"

namespace pose_wall::planar {

class SurfaceMap {
 public:
  static constexpr std::int32_t kSide = 1024;         // cells: 51 m to each side, beyond what most scanners see
  static constexpr std::int32_t kShrink = 4;          // cells of a level in a cell of the next
  static constexpr std::uint32_t kCellsMost = 24576;  // 60 keyframes of 360 points, should no two share a cell

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
  bool is_empty() const { return cells_.used() == 0; }
  // The surface next to a place given from the window's middle, or nullptr.
  const Surface* near(double x_m, double y_m) const {
    if (!Cells::holds(x_m, y_m)) return nullptr;
    return cells_.surface(nearest_[at(Cells::cell_of(x_m), Cells::cell_of(y_m))]);
  }
  // Whether lines of sight went through the 40 cm about a place given from the window's middle, or ended there.
  bool is_seen(double x_m, double y_m) const {
    return Cells::holds(x_m, y_m) && seen_[seen_at(Cells::cell_of(x_m), Cells::cell_of(y_m))] != 0;
  }
  // Likelihood, 0 to 255, of a cell of a level: 0 the finest. A coarse cell has the most of its cells and of those of
  // its right, upper and upper right neighbours.
  std::uint32_t likelihood(std::uint32_t level, std::int32_t cell_x, std::int32_t cell_y) const;

 private:
  static constexpr std::int32_t kReach =
      3;  // cells about a surface that find it: beyond kSurfaceEnd_m of place/patches.hpp
  static constexpr std::uint32_t kLevels = 3;  // 0.1, 0.4 and 1.6 m: the last is still finer than a road
  using Cells = SurfaceCells<kSide, kReach + 1, std::uint16_t>;

  static std::uint32_t at(std::int32_t column, std::int32_t row) {
    return static_cast<std::uint32_t>(row * kSide + column);
  }
  static std::uint32_t seen_at(std::int32_t column, std::int32_t row) {
    return static_cast<std::uint32_t>(row / kSightCells * (kSide / kSightCells) + column / kSightCells);
  }
  void spread_likelihood(const SurfaceCell& cell);
  void raise(std::uint32_t level, std::int32_t x, std::int32_t y, std::uint8_t value);

  Eigen::Vector2d middle_m_ = Eigen::Vector2d::Zero();
  Cells cells_;
  Span<std::uint16_t> nearest_;  // of the surface in or next to a cell
  Span<std::uint8_t> field_[kLevels];
  Span<std::uint8_t> seen_;  // of coarser cells: 1 where lines of sight went
};

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/ground_evidence.hpp"

#include <cmath>

#include "estimation/normal_equations.hpp"

namespace pose_wall {
namespace {

// What stands on a floor cell between these heights makes it a wall's foot, a heap or a person.
constexpr double kRisingFrom_m = 0.12;
constexpr double kRisingTo_m = 0.80;
constexpr double kDrivingStripHalf_m = 1.0;  // the machine is 1.2 m wide

void count_up(std::uint16_t* counter) {
  if (*counter != 0xFFFF) ++*counter;
}

}  // namespace

void FloorGrid::lay_out(Arena& arena) {
  on_plane_ = arena.take<std::uint16_t>(kSide * kSide);
  rising_ = arena.take<std::uint16_t>(kSide * kSide);
}

std::int32_t FloorGrid::cell_of(double coordinate_m) {
  return static_cast<std::int32_t>(std::floor(coordinate_m / kCell_m)) + kSide / 2;
}

void FloorGrid::mark(const PointSet& points_base, Span<const std::uint32_t> candidates, const Plane& plane,
                     double thresh_m) {
  on_plane_.fill(0);
  rising_.fill(0);
  for (const std::uint32_t i : candidates) {
    const Eigen::Vector3d p = points_base.at(i);
    const double height = plane.signed_distance(p);
    const bool on = height >= -thresh_m && height <= thresh_m;
    const bool rising = height >= kRisingFrom_m && height <= kRisingTo_m;
    if (!on && !rising) continue;
    // In plan along the plane's normal, so that a leaning view does not put a wall's top over another cell.
    const Eigen::Vector3d foot = p - height * plane.n;
    const std::int32_t ix = cell_of(foot.x()), iy = cell_of(foot.y());
    if (inside(ix, iy)) count_up(&(on ? on_plane_ : rising_)[static_cast<std::uint32_t>(iy * kSide + ix)]);
  }
}

bool FloorGrid::open(std::int32_t ix, std::int32_t iy) const {
  const std::uint32_t c = static_cast<std::uint32_t>(iy * kSide + ix);
  return on_plane_[c] > 0 && 2 * rising_[c] < on_plane_[c];
}

FloorEvidence FloorGrid::evidence(const Axes& axes) const {
  constexpr double kCellArea_m2 = kCell_m * kCell_m;
  FloorEvidence out;
  NormalEquations spread;
  for (std::int32_t iy = 0; iy < kSide; ++iy) {
    for (std::int32_t ix = 0; ix < kSide; ++ix) {
      if (!open(ix, iy)) continue;
      const double x = (static_cast<double>(ix - kSide / 2) + 0.5) * kCell_m;
      const double y = (static_cast<double>(iy - kSide / 2) + 0.5) * kCell_m;
      const double across = axes.left_base.x() * x + axes.left_base.y() * y;
      out.area_m2 += kCellArea_m2;
      out.score_m2 += std::fabs(across) <= kDrivingStripHalf_m ? kCellArea_m2 * 2.0 : kCellArea_m2;
      spread.add(x, y, 0.0, 1.0);
    }
  }
  out.across_spread_m = spread.smaller_spread_m();
  return out;
}

bool FloorGrid::open_near(double x_base_m, double y_base_m) const {
  const std::int32_t cx = cell_of(x_base_m), cy = cell_of(y_base_m);
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      if (inside(cx + dx, cy + dy) && open(cx + dx, cy + dy)) return true;
    }
  }
  return false;
}

bool FloorGrid::blocked(double x_base_m, double y_base_m) const {
  const std::int32_t ix = cell_of(x_base_m), iy = cell_of(y_base_m);
  return inside(ix, iy) && !open(ix, iy);
}

double share_seen_through(const FloorGrid& marked, const Plane& marked_plane, const Plane& below,
                          const PointSet& points_base, Span<const std::uint32_t> candidates,
                          const Eigen::Vector3d& sensor_base_m, double thresh_m) {
  const double sensor_height_m = marked_plane.signed_distance(sensor_base_m);
  std::uint32_t on_below = 0, through = 0;
  for (const std::uint32_t i : candidates) {
    const Eigen::Vector3d p = points_base.at(i);
    if (!(std::fabs(below.signed_distance(p)) <= thresh_m)) continue;
    ++on_below;
    const double height = marked_plane.signed_distance(p);
    if (!(height < -2.0 * thresh_m)) continue;
    const Eigen::Vector3d crossing =
        sensor_base_m + (p - sensor_base_m) * (sensor_height_m / (sensor_height_m - height));
    if (marked.open_near(crossing.x(), crossing.y())) ++through;
  }
  return on_below > 0 ? static_cast<double>(through) / static_cast<double>(on_below) : 0.0;
}

}  // namespace pose_wall

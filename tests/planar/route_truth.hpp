// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What a rectangle touches, cell by cell and without any of the planner's code.

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "pose_wall_planar_grid.h"
#include "pose_wall_planar_plan.h"

namespace pose_wall::test {

struct Rectangle {
  double front_m, rear_m, left_m, right_m;

  Rectangle grown(double m) const { return {front_m + m, rear_m + m, left_m + m, right_m + m}; }
};

// Of settings, with the margin.
inline Rectangle rectangle_of(const pose_wall_planar_plan_settings& s) {
  return Rectangle{s.front_m, s.rear_m, s.left_m, s.right_m}.grown(s.margin_m);
}

// The square of a cell and the rectangle share more than an edge: by the four separating axes of two rectangles.
inline bool touches_cell(const Rectangle& r, double x, double y, double yaw, double cx, double cy, double half) {
  const double c = std::cos(yaw), s = std::sin(yaw), u = c * (cx - x) + s * (cy - y), v = c * (cy - y) - s * (cx - x);
  const double spread = half * (std::abs(c) + std::abs(s));
  if (u - spread >= r.front_m || u + spread <= -r.rear_m || v - spread >= r.left_m || v + spread <= -r.right_m) {
    return false;
  }
  double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
  for (const double a : {r.front_m, -r.rear_m}) {
    for (const double b : {r.left_m, -r.right_m}) {
      x0 = std::min(x0, x + c * a - s * b);
      x1 = std::max(x1, x + c * a - s * b);
      y0 = std::min(y0, y + s * a + c * b);
      y1 = std::max(y1, y + s * a + c * b);
    }
  }
  return cx + half > x0 && cx - half < x1 && cy + half > y0 && cy - half < y1;
}

inline bool is_driven_on(std::int8_t cell, std::uint32_t occupied_from) {
  return cell >= 0 && static_cast<std::uint32_t>(cell) < occupied_from;
}

inline bool is_rectangle_free(const pose_wall_planar_grid& grid, std::uint32_t occupied_from, const Rectangle& r,
                              double x, double y, double yaw) {
  const double reach = std::hypot(std::max(r.front_m, r.rear_m), std::max(r.left_m, r.right_m));
  const auto cell_at = [&](double m, double origin) {
    return static_cast<int>(std::floor((m - origin) / grid.resolution_m));
  };
  for (int row = cell_at(y - reach, grid.origin_y_m); row <= cell_at(y + reach, grid.origin_y_m); ++row) {
    for (int column = cell_at(x - reach, grid.origin_x_m); column <= cell_at(x + reach, grid.origin_x_m); ++column) {
      const bool is_inside =
          row >= 0 && column >= 0 && row < static_cast<int>(grid.height) && column < static_cast<int>(grid.width);
      if (is_inside) {
        const auto at = static_cast<std::size_t>(row) * grid.width + static_cast<std::size_t>(column);
        if (is_driven_on(grid.cells[at], occupied_from)) continue;
      }
      const double cx = grid.origin_x_m + (column + 0.5) * grid.resolution_m;
      const double cy = grid.origin_y_m + (row + 0.5) * grid.resolution_m;
      if (touches_cell(r, x, y, yaw, cx, cy, 0.5 * grid.resolution_m)) return false;
    }
  }
  return true;
}

inline double turned(double from, double to) {
  return std::remainder(to - from, 2.0 * 3.14159265358979323846);
}

}  // namespace pose_wall::test

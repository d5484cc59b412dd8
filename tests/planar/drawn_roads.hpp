// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Grids drawn by chance: networks of roads at any angle, mazes, and halls with blocks. All rock is 100, all free cells
// 0.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "pose_wall_planar_grid.h"

namespace pose_wall::test {

struct DrawnGrid {
  double resolution_m = 0.05;
  std::uint32_t width = 0, height = 0;
  std::vector<std::int8_t> cells;
  std::vector<double> places_xy;  // places in the middle of a road, x and y in turn

  DrawnGrid(double side_m, std::int8_t all, double resolution = 0.05)
      : resolution_m(resolution),
        width(static_cast<std::uint32_t>(side_m / resolution + 0.5)),
        height(width),
        cells(static_cast<std::size_t>(width) * height, all) {}

  pose_wall_planar_grid view(double origin_x_m = 0.0, double origin_y_m = 0.0) const {
    return {sizeof(pose_wall_planar_grid), width, height, 0, resolution_m, origin_x_m, origin_y_m, cells.data()};
  }

  template <typename Inside>
  void paint(double x0, double y0, double x1, double y1, std::int8_t value, const Inside& is_inside) {
    const auto clip = [&](double m, std::uint32_t most) {
      return static_cast<std::uint32_t>(std::clamp(m / resolution_m, 0.0, static_cast<double>(most)));
    };
    for (std::uint32_t row = clip(y0, height); row < clip(y1 + resolution_m, height); ++row) {
      for (std::uint32_t column = clip(x0, width); column < clip(x1 + resolution_m, width); ++column) {
        const double x = (column + 0.5) * resolution_m, y = (row + 0.5) * resolution_m;
        if (is_inside(x, y)) cells[static_cast<std::size_t>(row) * width + column] = value;
      }
    }
  }
  void box(double x0, double y0, double x1, double y1, std::int8_t value) {
    paint(x0, y0, x1, y1, value, [&](double x, double y) { return x >= x0 && x <= x1 && y >= y0 && y <= y1; });
  }
  void disc(double cx, double cy, double radius, std::int8_t value) {
    paint(cx - radius, cy - radius, cx + radius, cy + radius, value,
          [&](double x, double y) { return std::hypot(x - cx, y - cy) <= radius; });
  }
  // A road from a to b with rough walls: its half width waves by up to `rough`.
  void road(double ax, double ay, double bx, double by, double half, double rough, std::mt19937* random) {
    std::uniform_real_distribution<double> phase(0.0, 6.283);
    const double length = std::hypot(bx - ax, by - ay), p = phase(*random), q = phase(*random);
    const double ux = (bx - ax) / length, uy = (by - ay) / length;
    paint(std::min(ax, bx) - half, std::min(ay, by) - half, std::max(ax, bx) + half, std::max(ay, by) + half, 0,
          [&](double x, double y) {
            const double along = (x - ax) * ux + (y - ay) * uy, across = (y - ay) * ux - (x - ax) * uy;
            if (along < -half || along > length + half) return false;
            const double wave = rough * (across > 0.0 ? std::sin(2.1 * along + p) : std::sin(1.7 * along + q));
            return std::abs(across) <= half - rough + wave;
          });
  }
};

// A net of crossings about 18 m apart, turned and shifted by chance; some roads are missing, some are blocked.
inline DrawnGrid drawn_network(std::uint32_t seed, double side_m = 100.0, double half_least = 1.9,
                               double half_most = 2.6) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  DrawnGrid grid(side_m, 100);
  const double pitch = 18.0, turn = part(random) * 1.57;
  const int n = static_cast<int>(side_m / pitch) + 3;
  const auto at = [&](int i) { return (i - 0.5 * n) * pitch; };
  std::vector<double> xs, ys;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = at(i) + 6.0 * (part(random) - 0.5), y = at(j) + 6.0 * (part(random) - 0.5);
      xs.push_back(0.5 * side_m + std::cos(turn) * x - std::sin(turn) * y);
      ys.push_back(0.5 * side_m + std::sin(turn) * x + std::cos(turn) * y);
    }
  }
  const auto is_inside = [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    return xs[i] > 6.0 && ys[i] > 6.0 && xs[i] < side_m - 6.0 && ys[i] < side_m - 6.0;
  };
  const auto join = [&](int a, int b) {
    const double half = half_least + part(random) * (half_most - half_least), missing = part(random);
    if (!is_inside(a) || !is_inside(b) || missing < 0.22) return;
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    grid.road(xs[i], ys[i], xs[j], ys[j], half, 0.15, &random);
    grid.disc(xs[i], ys[i], 1.2 * half, 0);
    grid.disc(xs[j], ys[j], 1.2 * half, 0);
    for (const double t : {0.3, 0.7}) {
      grid.places_xy.push_back(xs[i] + t * (xs[j] - xs[i]));
      grid.places_xy.push_back(ys[i] + t * (ys[j] - ys[i]));
    }
  };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      if (i < n) join(j * (n + 1) + i, j * (n + 1) + i + 1);
      if (j < n) join(j * (n + 1) + i, (j + 1) * (n + 1) + i);
    }
  }
  return grid;
}

// A perfect maze of cells 10 m wide with roads of 4.4 m, and a few walls broken through.
inline DrawnGrid drawn_maze(std::uint32_t seed, double side_m = 100.0, double half = 2.2) {
  std::mt19937 random(seed);
  DrawnGrid grid(side_m, 100);
  const double pitch = 10.0;
  const int n = static_cast<int>(side_m / pitch);
  std::vector<int> seen(static_cast<std::size_t>(n * n), 0), stack{0};
  seen[0] = 1;
  const auto middle = [&](int k) { return (k + 0.5) * pitch; };
  const auto open = [&](int a, int b) {
    grid.road(middle(a % n), middle(a / n), middle(b % n), middle(b / n), half, 0.1, &random);
  };
  while (!stack.empty()) {
    const int here = stack.back(), x = here % n, y = here / n;
    std::vector<int> free;
    if (x > 0 && seen[static_cast<std::size_t>(here - 1)] == 0) free.push_back(here - 1);
    if (x + 1 < n && seen[static_cast<std::size_t>(here + 1)] == 0) free.push_back(here + 1);
    if (y > 0 && seen[static_cast<std::size_t>(here - n)] == 0) free.push_back(here - n);
    if (y + 1 < n && seen[static_cast<std::size_t>(here + n)] == 0) free.push_back(here + n);
    if (free.empty()) {
      stack.pop_back();
      continue;
    }
    const int next = free[random() % free.size()];
    open(here, next);
    seen[static_cast<std::size_t>(next)] = 1;
    stack.push_back(next);
    if (random() % 8 == 0 && x + 1 < n) open(here, here + 1);
  }
  for (int k = 0; k < n * n; ++k) {
    grid.places_xy.push_back(middle(k % n));
    grid.places_xy.push_back(middle(k / n));
  }
  return grid;
}

// A hall with blocks and props by chance.
inline DrawnGrid drawn_hall(std::uint32_t seed, double side_m = 100.0, int blocks = 160) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  DrawnGrid grid(side_m, 0);
  for (const double edge : {0.0, side_m - 0.5}) {
    grid.box(edge, 0.0, edge + 0.5, side_m, 100);
    grid.box(0.0, edge, side_m, edge + 0.5, 100);
  }
  for (int k = 0; k < blocks; ++k) {
    const double x = part(random) * side_m, y = part(random) * side_m, a = 0.3 + 3.0 * part(random);
    const double b = 0.3 + 3.0 * part(random), turn = part(random) * 3.14, reach = std::hypot(a, b);
    grid.paint(x - reach, y - reach, x + reach, y + reach, 100, [&](double px, double py) {
      const double u = std::cos(turn) * (px - x) + std::sin(turn) * (py - y);
      const double v = std::cos(turn) * (py - y) - std::sin(turn) * (px - x);
      return std::abs(u) <= a && std::abs(v) <= b;
    });
  }
  for (int k = 0; k < 60; ++k) {
    grid.places_xy.push_back(5.0 + part(random) * (side_m - 10.0));
    grid.places_xy.push_back(5.0 + part(random) * (side_m - 10.0));
  }
  return grid;
}

inline DrawnGrid drawn_grid(std::uint32_t seed) {
  if (seed % 3 == 0) return drawn_maze(seed);
  if (seed % 3 == 1) return drawn_network(seed);
  return drawn_hall(seed);
}

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The places and headings that the search knows, with the machine's rectangle as rows of cells for each.
//
// Places are corners of cells, step_cells apart. A heading points exactly from a place to another one nearby, so
// driving straight along a heading leads from place to place without rounding. Headings go round to the left from x.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "planar/route/bit_grid.hpp"
#include "planar/route/footprint.hpp"

namespace pose_wall::planar::route {

constexpr std::uint32_t kHeadingsMost = 64;        // room for all: 32 or 64, see lattice.cpp
constexpr double kUnits_m = 1e-4;                  // costs and lengths of the search are whole numbers of these
constexpr std::uint32_t kUnitsMost = 0x7FFFFFFFU;  // so that the sum of two fits its word: 215 km

struct Heading {
  std::int32_t dx = 0, dy = 0;  // in steps
  double yaw_rad = 0.0;
  std::uint32_t length = 0;  // of (dx, dy), in units
};

// A shape about a corner of cells: columns first[k] to last[k] of row first_row + k, counted from there.
struct Mask {
  Span<std::int16_t> first, last;
  std::int32_t first_row = 0, least = 0, most = 0;  // least first and greatest last

  bool is_free(const BitGrid& grid, std::int32_t column, std::int32_t row) const;
};

// A shape at a place of the lattice: most looks end with the coarse cells, as large as the steps between places.
struct Shape {
  Mask exact, coarse;
};

class Lattice {
 public:
  // headings: 32 or 64.
  void lay_out(Arena& arena, std::uint32_t headings, double reach_cells);
  void open(std::uint32_t step_cells, double resolution_m, const Footprint& footprint);

  std::uint32_t headings() const { return headings_; }
  std::int32_t step_cells() const { return step_cells_; }
  double step_m() const { return step_m_; }
  const Heading& heading(std::uint32_t k) const { return heading_[k]; }
  std::uint32_t next(std::uint32_t k) const { return k + 1 < headings_ ? k + 1 : 0; }
  std::uint32_t before(std::uint32_t k) const { return k > 0 ? k - 1 : headings_ - 1; }
  // The heading at or before a yaw, the next one is behind it.
  std::uint32_t at_or_before(double yaw_rad) const;
  double gap_rad(std::uint32_t k) const;  // from heading k to the next

  const Shape& standing(std::uint32_t k) const { return standing_[k]; }
  const Shape& turning(std::uint32_t k) const { return turning_[k]; }  // between heading k and the next
  const Shape& circle() const { return circle_; }                      // inscribed: free wherever the machine fits

  // A circle of another radius, within the reach.
  Shape room_for_shape(Arena& arena) const;
  void write_circle(double radius_cells, Shape* shape) const;

 private:
  std::uint32_t headings_ = 0;
  std::int32_t step_cells_ = 1, reach_ = 0;
  double step_m_ = 0.0;
  Heading heading_[kHeadingsMost];
  void merge(const Piece& body_m, double yaw_rad, double cell_m) const;
  void finish(Mask* mask) const;

  Shape standing_[kHeadingsMost], turning_[kHeadingsMost], circle_;
  RowBounds bounds_;
};

// The grid as a search over a lattice looks at it: with the coarse cells of that lattice.
struct LatticeGrid {
  const BitGrid* exact = nullptr;
  const BitGrid* coarse = nullptr;
  std::int32_t step_cells = 1;

  // Column and row in steps.
  bool is_free(const Shape& shape, std::int32_t column, std::int32_t row) const {
    if (shape.coarse.is_free(*coarse, column, row)) return true;
    return shape.exact.is_free(*exact, column * step_cells, row * step_cells);
  }
};

}  // namespace pose_wall::planar::route

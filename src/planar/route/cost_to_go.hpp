// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How far it is at least from each place to the goal: for the machine's inscribed circle, that may go along any heading
// at once. No way of the machine in the lattice is shorter.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "planar/route/bit_grid.hpp"
#include "planar/route/lattice.hpp"

namespace pose_wall::planar::route {

// Places of a lattice over a grid: column and row in steps, and their number.
struct LatticePlaces {
  std::int32_t columns = 0, rows = 0;

  static LatticePlaces of(const BitGrid& grid, std::int32_t step_cells) {
    return {grid.width() / step_cells + 1, grid.height() / step_cells + 1};
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows); }
  bool holds(std::int32_t column, std::int32_t row) const {
    return column >= 0 && column < columns && row >= 0 && row < rows;
  }
  std::uint32_t number(std::int32_t column, std::int32_t row) const {
    return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns) + static_cast<std::uint32_t>(column);
  }
  std::int32_t column(std::uint32_t place) const {
    return static_cast<std::int32_t>(place % static_cast<std::uint32_t>(columns));
  }
  std::int32_t row(std::uint32_t place) const {
    return static_cast<std::int32_t>(place / static_cast<std::uint32_t>(columns));
  }
};

class CostToGo {
 public:
  // No distances, which end at kUnitsMost:
  static constexpr std::uint32_t kUnknown = 0xFFFFFFFFU, kBlocked = 0xFFFFFFFEU, kFar = 0xFFFFFFFDU;

  void lay_out(Arena& arena, std::uint32_t places);
  std::uint32_t capacity() const { return distance_.size(); }

  // begin, seeds, then spread. The field ends `beyond` of the distance behind the place where it first meets `target`.
  // Only the lattice's vectors up to `longest` (in units) are moves: a longer one leaps over rock that is thinner.
  void begin(const Lattice* lattice, const LatticeGrid& grid, const Shape* circle, const LatticePlaces& places,
             std::uint32_t longest);
  void seed(std::uint32_t place, std::uint32_t distance);
  struct Target {
    std::int32_t column = 0, row = 0, reach = 0;  // a square of places
    bool holds(std::int32_t c, std::int32_t r) const {
      return c >= column - reach && c <= column + reach && r >= row - reach && r <= row + reach;
    }
  };
  // False if no place of the target was reached.
  bool spread(const Target& target);

  // At least this far, in units; kBlocked: the circle does not fit there, or no way leads there.
  std::uint32_t at(std::uint32_t place) const {
    const std::uint32_t distance = distance_[place];
    if (distance == kBlocked) return kBlocked;
    if (distance < end_) return distance;
    return is_cut_ ? end_ : kBlocked;
  }
  std::uint32_t settled() const { return settled_; }
  std::uint64_t looks() const { return looks_; }  // at places, from others, since it was laid out: the work

  // Of the target's places the one that the field met first; and from any that it met the next on a way to the goal, or
  // the same one at its end.
  std::uint32_t nearest_of_target() const { return met_; }
  std::uint32_t step_down(std::uint32_t place) const;

 private:
  static constexpr std::uint32_t kBuckets = 16;        // the longest vector of a heading is 7.9 steps
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;  // no place has this number

  bool is_free(std::uint32_t place, std::int32_t column, std::int32_t row);
  void put(std::uint32_t place, std::uint32_t distance);
  void take_out(std::uint32_t place);
  void relax_from(std::uint32_t place);

  Span<std::uint32_t> distance_, next_, before_;
  std::uint32_t head_[kBuckets] = {};
  const Heading* moves_[kHeadingsMost] = {};
  std::uint32_t moves_count_ = 0;
  std::uint64_t looks_ = 0;
  std::uint32_t width_ = 1, end_ = 0, settled_ = 0, waiting_ = 0, met_ = 0;
  bool is_cut_ = false;
  LatticePlaces places_;
  LatticeGrid grid_;
  const Shape* circle_ = nullptr;
};

}  // namespace pose_wall::planar::route

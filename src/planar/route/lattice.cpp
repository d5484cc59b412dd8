// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/lattice.hpp"

#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall::planar {
namespace {

// Directions of an eighth of a turn, the diagonal left out: short vectors that lie about evenly.
struct Vector {
  std::int32_t x, y;
};
constexpr Vector kEighthOf32[] = {{1, 0}, {4, 1}, {2, 1}, {3, 2}};
constexpr Vector kEighthOf64[] = {{1, 0}, {7, 1}, {4, 1}, {5, 2}, {2, 1}, {3, 2}, {4, 3}, {6, 5}};

// Heading k of `eighth` headings in each eighth: the first quarter is mirrored at its diagonal, then turned.
Vector vector_of(const Vector* eighths, std::uint32_t eighth, std::uint32_t k) {
  const std::uint32_t quarter = k / (2 * eighth), within = k % (2 * eighth);
  Vector v{1, 1};
  if (within < eighth) v = eighths[within];
  if (within > eighth) v = {eighths[2 * eighth - within].y, eighths[2 * eighth - within].x};
  for (std::uint32_t turn = 0; turn < quarter; ++turn) v = {-v.y, v.x};
  return v;
}

// Rows on each side of the middle, with some to spare for what turns sweep.
std::int32_t reach_of(double reach_cells) {
  return static_cast<std::int32_t>(reach_cells) + 3;
}
std::uint32_t rows_of(std::int32_t reach) {
  return static_cast<std::uint32_t>(2 * reach + 1);
}

void start(const RowBounds& bounds) {
  bounds.clear(bounds.low.size());
}

void merge(const RowBounds& bounds, const Piece& body_m, double yaw_rad, double resolution_m, std::int32_t reach) {
  const Turn2 turn(yaw_rad);
  Piece piece;
  for (std::uint32_t k = 0; k < Piece::kCorners; ++k) piece.corner[k] = turn * body_m.corner[k] / resolution_m;
  bounds.merge(piece, -reach);
}

void finish(const RowBounds& bounds, std::int32_t reach, Mask* mask) {
  std::uint32_t begin = 0, end = bounds.low.size();
  while (begin < end && bounds.low[begin] > bounds.high[begin]) ++begin;
  while (end > begin && bounds.low[end - 1] > bounds.high[end - 1]) --end;
  mask->first_row = static_cast<std::int32_t>(begin) - reach;
  mask->least = reach;
  mask->most = -reach;
  for (std::uint32_t k = begin; k < end; ++k) {
    const auto first = static_cast<std::int16_t>(std::floor(bounds.low[k]));
    const auto last = static_cast<std::int16_t>(std::floor(bounds.high[k]));
    mask->first[k - begin] = first;
    mask->last[k - begin] = last;
    if (first < mask->least) mask->least = first;
    if (last > mask->most) mask->most = last;
  }
  mask->first = mask->first.first(end - begin);  // over the same room, so that it may grow again
  mask->last = mask->last.first(end - begin);
}

}  // namespace

bool Mask::is_free(const BitGrid& grid, std::int32_t column, std::int32_t row) const {
  const auto rows = static_cast<std::int32_t>(first.size());
  const std::int32_t top = row + first_row;
  if (column + least < 0 || column + most >= grid.width() || top < 0 || top + rows > grid.height()) return false;
  // The ends of the machine meet a wall first, its middle last.
  for (std::int32_t k = 0; k < rows; ++k) {
    const std::int32_t at = (k & 1) != 0 ? rows - 1 - (k >> 1) : k >> 1;
    const auto i = static_cast<std::uint32_t>(at);
    if (grid.is_any_blocked(top + at, column + first[i], column + last[i])) return false;
  }
  return true;
}

Mask Lattice::room_for_mask(Arena& arena, double reach_cells) {
  const std::uint32_t rows = rows_of(reach_of(reach_cells));
  Mask mask;
  mask.first = arena.take<std::int16_t>(rows);
  mask.last = arena.take<std::int16_t>(rows);
  return mask;
}

void Lattice::lay_out(Arena& arena, std::uint32_t headings, double reach_cells) {
  headings_ = headings;
  reach_ = reach_of(reach_cells);
  const std::uint32_t rows = rows_of(reach_);
  for (std::uint32_t k = 0; k < headings; ++k) {
    standing_[k] = room_for_mask(arena, reach_cells);
    turning_[k] = room_for_mask(arena, reach_cells);
  }
  circle_ = room_for_mask(arena, reach_cells);
  bounds_.low = arena.take<double>(rows);
  bounds_.high = arena.take<double>(rows);
}

void Lattice::open(std::uint32_t step_cells, double resolution_m, const Footprint& footprint) {
  step_cells_ = static_cast<std::int32_t>(step_cells);
  step_m_ = step_cells * resolution_m;
  const Vector* const eighths = headings_ == 64 ? kEighthOf64 : kEighthOf32;
  for (std::uint32_t k = 0; k < headings_; ++k) {
    const Vector v = vector_of(eighths, headings_ / 8, k);
    const double length_m = step_m_ * std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y));
    double yaw_rad = arc_tangent2(v.y, v.x);
    if (yaw_rad < 0.0) yaw_rad += 2.0 * kPi;
    heading_[k] = {v.x, v.y, yaw_rad, static_cast<std::uint32_t>(length_m / kUnits_m + 0.5)};
  }
  for (std::uint32_t k = 0; k < headings_; ++k) {
    start(bounds_);
    merge(bounds_, straight_piece(footprint, 0.0, 0.0), heading_[k].yaw_rad, resolution_m, reach_);
    finish(bounds_, reach_, &standing_[k]);
    start(bounds_);
    const auto steps = static_cast<std::uint32_t>(gap_rad(k) / kTurnStep_rad) + 1;
    const TurnPieces pieces = turn_pieces(footprint, gap_rad(k) / steps, 0.0);
    for (std::uint32_t i = 0; i < steps; ++i) {
      const double yaw_rad = heading_[k].yaw_rad + (i + 0.5) * gap_rad(k) / steps;
      for (const Piece& piece : pieces.piece) merge(bounds_, piece, yaw_rad, resolution_m, reach_);
    }
    finish(bounds_, reach_, &turning_[k]);
  }
  write_circle(footprint.inscribed_m() / resolution_m, &circle_);
}

// The cells that the circle touches: the machine touches them too, so a place where one is blocked has no free heading.

void Lattice::write_circle(double radius_cells, Mask* mask) const {
  start(bounds_);
  for (std::int32_t row = -reach_; row < reach_; ++row) {
    const double far = row >= 0 ? row : -row - 1;  // nearest edge of the row: the circle is widest there
    if (!(far < radius_cells)) continue;
    const double half = std::sqrt(radius_cells * radius_cells - far * far);
    bounds_.low[static_cast<std::uint32_t>(row + reach_)] = -half + 1e-9;
    bounds_.high[static_cast<std::uint32_t>(row + reach_)] = half - 1e-9;
  }
  finish(bounds_, reach_, mask);
}

std::uint32_t Lattice::at_or_before(double yaw_rad) const {
  double yaw = wrapped(yaw_rad);
  if (yaw < 0.0) yaw += 2.0 * kPi;
  std::uint32_t k = headings_ - 1;
  while (k > 0 && heading_[k].yaw_rad > yaw) --k;
  return k;
}

double Lattice::gap_rad(std::uint32_t k) const {
  const double gap = heading_[next(k)].yaw_rad - heading_[k].yaw_rad;
  return gap > 0.0 ? gap : gap + 2.0 * kPi;
}

}  // namespace pose_wall::planar

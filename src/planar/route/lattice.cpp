// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/lattice.hpp"

#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall::planar::route {
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

std::uint32_t rows_of(std::int32_t reach) {
  return static_cast<std::uint32_t>(2 * reach + 1);
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

Shape Lattice::room_for_shape(Arena& arena) const {
  const std::uint32_t rows = rows_of(reach_);
  Shape shape;
  for (Mask* mask : {&shape.exact, &shape.coarse}) {
    mask->first = arena.take<std::int16_t>(rows);
    mask->last = arena.take<std::int16_t>(rows);
  }
  return shape;
}

void Lattice::lay_out(Arena& arena, std::uint32_t headings, double reach_cells) {
  headings_ = headings;
  reach_ = static_cast<std::int32_t>(reach_cells) + 3;  // with some to spare for what turns sweep
  for (std::uint32_t k = 0; k < headings; ++k) {
    standing_[k] = room_for_shape(arena);
    turning_[k] = room_for_shape(arena);
  }
  circle_ = room_for_shape(arena);
  bounds_.low = arena.take<double>(rows_of(reach_));
  bounds_.high = arena.take<double>(rows_of(reach_));
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
  for (const bool is_coarse : {false, true}) {
    const double cell_m = is_coarse ? step_m_ : resolution_m;
    for (std::uint32_t k = 0; k < headings_; ++k) {
      bounds_.clear(bounds_.low.size());
      merge(straight_piece(footprint, 0.0, 0.0), heading_[k].yaw_rad, cell_m);
      finish(is_coarse ? &standing_[k].coarse : &standing_[k].exact);
      bounds_.clear(bounds_.low.size());
      const ArcSteps steps = arc_steps(footprint, 0.0, gap_rad(k));
      for (std::uint32_t i = 0; i < steps.count; ++i) {
        const double yaw_rad = heading_[k].yaw_rad + (i + 0.5) * gap_rad(k) / steps.count;
        for (const Piece& piece : steps.half) merge(piece, yaw_rad, cell_m);
      }
      finish(is_coarse ? &turning_[k].coarse : &turning_[k].exact);
    }
  }
  write_circle(footprint.inscribed_m() / resolution_m, &circle_);
}

void Lattice::merge(const Piece& body_m, double yaw_rad, double cell_m) const {
  const Turn2 turn(yaw_rad);
  Piece piece;
  piece.corners = body_m.corners;
  for (std::uint32_t k = 0; k < body_m.corners; ++k) piece.corner[k] = turn * body_m.corner[k] / cell_m;
  bounds_.merge(piece, -reach_);
}

void Lattice::finish(Mask* mask) const {
  std::uint32_t begin = 0, end = bounds_.low.size();
  while (begin < end && bounds_.low[begin] > bounds_.high[begin]) ++begin;
  while (end > begin && bounds_.low[end - 1] > bounds_.high[end - 1]) --end;
  mask->first_row = static_cast<std::int32_t>(begin) - reach_;
  mask->least = reach_;
  mask->most = -reach_;
  for (std::uint32_t k = begin; k < end; ++k) {
    const auto first = static_cast<std::int16_t>(std::floor(bounds_.low[k]));
    const auto last = static_cast<std::int16_t>(std::floor(bounds_.high[k]));
    mask->first[k - begin] = first;
    mask->last[k - begin] = last;
    if (first < mask->least) mask->least = first;
    if (last > mask->most) mask->most = last;
  }
  mask->first = mask->first.first(end - begin);  // over the same room, so that it may grow again
  mask->last = mask->last.first(end - begin);
}

// The cells that the circle touches: the machine touches them too, so a place where one is blocked has no free heading.
void Lattice::write_circle(double radius_cells, Shape* shape) const {
  for (const bool is_coarse : {false, true}) {
    bounds_.clear(bounds_.low.size());
    const double radius = is_coarse ? radius_cells / step_cells_ : radius_cells;
    for (std::int32_t row = -reach_; row < reach_; ++row) {
      const double far = row >= 0 ? row : -row - 1;  // nearest edge of the row: the circle is widest there
      if (!(far < radius)) continue;
      const double half = std::sqrt(radius * radius - far * far);
      bounds_.low[static_cast<std::uint32_t>(row + reach_)] = -half + 1e-9;
      bounds_.high[static_cast<std::uint32_t>(row + reach_)] = half - 1e-9;
    }
    finish(is_coarse ? &shape->coarse : &shape->exact);
  }
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

}  // namespace pose_wall::planar::route

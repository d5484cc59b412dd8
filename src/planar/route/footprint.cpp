// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/footprint.hpp"

#include <cmath>

#include "base/math/larger.hpp"

namespace pose_wall::planar {
namespace {

double smaller_of(double a, double b) {
  return a < b ? a : b;
}
double magnitude(double a) {
  return a < 0.0 ? -a : a;
}

}  // namespace

double Footprint::inscribed_m() const {
  return smaller_of(smaller_of(front_m, rear_m), smaller_of(left_m, right_m));
}

double Footprint::reach_m() const {
  const double along_m = larger(front_m, rear_m), across_m = larger(left_m, right_m);
  return std::sqrt(along_m * along_m + across_m * across_m);
}

Piece straight_piece(const Footprint& f, double forward_m, double backward_m) {
  const double front_m = f.front_m + forward_m, rear_m = -f.rear_m - backward_m;
  return {{{front_m, f.left_m}, {rear_m, f.left_m}, {rear_m, -f.right_m}, {front_m, -f.right_m}}};
}

// A point (x, y) of the front half that turns by up to s either way and goes along by up to u comes no further to the
// left than y + x s + (the arc's own bend), and no further to the front than x + |y| s + u.
TurnPieces turn_pieces(const Footprint& f, double angle_rad, double stretch_m) {
  const double s = 0.5 * magnitude(angle_rad), u = 0.5 * magnitude(stretch_m);
  const double wide_m = larger(f.left_m, f.right_m);
  const double more_m = wide_m * s * s + 0.5 * u * s;  // bend of the arc: u^2 / 2R with s = u / R
  const double back_m = u + wide_m * s;
  const auto half = [&](double length_m, double sign) {
    const double tip_m = length_m + back_m, spread_m = more_m + (tip_m + u) * s;
    const double base_m = more_m + u * s;
    return Piece{{{-sign * back_m, f.left_m + base_m},
                  {sign * tip_m, f.left_m + spread_m},
                  {sign * tip_m, -f.right_m - spread_m},
                  {-sign * back_m, -f.right_m - base_m}}};
  };
  return {{half(f.front_m, 1.0), half(f.rear_m, -1.0)}};
}

void RowBounds::merge(const Piece& piece, std::int32_t first_row) const {
  for (std::uint32_t k = 0; k < Piece::kCorners; ++k) {
    Eigen::Vector2d a = piece.corner[k], b = piece.corner[(k + 1) % Piece::kCorners];
    if (a.y() > b.y()) {
      const Eigen::Vector2d swap = a;
      a = b;
      b = swap;
    }
    const double rise = b.y() - a.y(), slope = rise > 1e-9 ? (b.x() - a.x()) / rise : 0.0;
    auto row = static_cast<std::int32_t>(std::floor(a.y())) - first_row;
    const auto last = static_cast<std::int32_t>(std::floor(b.y())) - first_row;
    double x = a.x();
    for (; row <= last && row < static_cast<std::int32_t>(low.size()); ++row) {
      const double next = row == last ? b.x() : a.x() + (row + 1 + first_row - a.y()) * slope;
      double& least = low[static_cast<std::uint32_t>(row)];
      double& most = high[static_cast<std::uint32_t>(row)];
      least = smaller_of(least, smaller_of(x, next));
      most = larger(most, larger(x, next));
      x = next;
    }
  }
}

void Sweeps::lay_out(Arena& arena, std::uint32_t height_max) {
  bounds_.low = arena.take<double>(height_max + 1);
  bounds_.high = arena.take<double>(height_max + 1);
}

bool Sweeps::is_free(const Piece& body, const Pose2& at) {
  const Turn2 turn(at.yaw_rad);
  Piece piece;
  Eigen::Vector2d least(1e9, 1e9), most(-1e9, -1e9);
  for (std::uint32_t k = 0; k < Piece::kCorners; ++k) {
    piece.corner[k] = grid_->in_cells(turn * body.corner[k] + at.place());
    least = least.cwiseMin(piece.corner[k]);
    most = most.cwiseMax(piece.corner[k]);
  }
  const bool is_inside =
      least.x() >= 0.0 && least.y() >= 0.0 && most.x() < grid_->width() && most.y() < grid_->height();
  if (!is_inside) return false;
  const auto first_row = static_cast<std::int32_t>(least.y());
  const auto rows = static_cast<std::uint32_t>(static_cast<std::int32_t>(most.y()) - first_row + 1);
  rows_ += rows + 10;
  bounds_.clear(rows);
  bounds_.merge(piece, first_row);
  for (std::uint32_t k = 0; k < rows; ++k) {
    const auto first = static_cast<std::int32_t>(bounds_.low[k]), last = static_cast<std::int32_t>(bounds_.high[k]);
    if (first <= last && grid_->is_any_blocked(first_row + static_cast<std::int32_t>(k), first, last)) return false;
  }
  return true;
}

bool Sweeps::is_pose_free(const Pose2& at) {
  return is_free(straight_piece(footprint_, 0.0, 0.0), at);
}

bool Sweeps::is_straight_free(const Pose2& from, double along_m) {
  return is_free(straight_piece(footprint_, larger(along_m, 0.0), larger(-along_m, 0.0)), from);
}

bool Sweeps::is_arc_free(const Pose2& from, double along_m, double turn_rad) {
  constexpr double kMostTurn_rad = 4.0 * kPi;
  if (!(magnitude(turn_rad) <= kMostTurn_rad)) return false;
  if (magnitude(turn_rad) < 1e-9) return is_straight_free(from, along_m);
  const auto steps = static_cast<std::uint32_t>(magnitude(turn_rad) / kTurnStep_rad) + 1;
  const double step_rad = turn_rad / steps, step_m = along_m / steps;
  const TurnPieces pieces = turn_pieces(footprint_, step_rad, step_m);
  for (std::uint32_t k = 0; k < steps; ++k) {
    const double part = (k + 0.5) / steps;
    const Pose2 middle = along_arc(from, part * along_m, part * turn_rad);
    if (!is_free(pieces.piece[0], middle) || !is_free(pieces.piece[1], middle)) return false;
  }
  return true;
}

Pose2 along_arc(const Pose2& from, double along_m, double turn_rad) {
  const double half_rad = 0.5 * turn_rad;
  // The chord: along sin(half) / half, at half the turn.
  const double ratio = magnitude(half_rad) > 1e-4 ? sine(half_rad) / half_rad : 1.0 - half_rad * half_rad / 6.0;
  const Turn2 middle(from.yaw_rad + half_rad);
  return {from.x_m + along_m * ratio * middle.c, from.y_m + along_m * ratio * middle.s, from.yaw_rad + turn_rad};
}

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/footprint.hpp"

#include <cmath>

#include "base/math/finite.hpp"

namespace pose_wall::planar::route {
namespace {

double smaller_of(double a, double b) {
  return a < b ? a : b;
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
  return {{{front_m, f.left_m}, {rear_m, f.left_m}, {rear_m, -f.right_m}, {front_m, -f.right_m}}, 4};
}

namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Andrew's monotone chain (1979) over eight points.
Piece hull_of(Eigen::Vector2d (&points)[Piece::kCornersMost]) {
  constexpr std::uint32_t kCount = Piece::kCornersMost;  // all of them
  for (std::uint32_t k = 1; k < kCount; ++k) {
    const Eigen::Vector2d point = points[k];
    std::uint32_t at = k;
    for (; at > 0; --at) {
      const Eigen::Vector2d& before = points[at - 1];
      if (before.x() < point.x() || (before.x() == point.x() && before.y() <= point.y())) break;
      points[at] = before;
    }
    points[at] = point;
  }
  Eigen::Vector2d hull[2 * kCount];
  std::uint32_t count = 0;
  for (std::uint32_t pass = 0, floor = 0; pass < 2; ++pass, floor = count - 1) {
    for (std::uint32_t k = pass; k < kCount; ++k) {
      const Eigen::Vector2d& point = points[pass == 0 ? k : kCount - 1 - k];
      while (count >= floor + 2 && cross(hull[count - 2], hull[count - 1], point) <= 0.0) --count;
      hull[count++] = point;
    }
  }
  Piece piece;
  piece.corners = count - 1 < kCount ? count - 1 : kCount;  // the last one is the first again
  for (std::uint32_t k = 0; k < piece.corners; ++k) piece.corner[k] = hull[k];
  return piece;
}

}  // namespace

// Both ends of a step are turns about its centre. Their hull lacks what bulges over the chords; pushed away from the
// centre by the cosine of half a step, the chords touch the bulges.
ArcSteps arc_steps(const Footprint& f, double along_m, double turn_rad) {
  constexpr double kTooWide_m = 0.003;  // by at most so much
  const double centre_m = along_m / turn_rad, far_m = std::abs(centre_m) + f.reach_m();
  const double half_most_rad = std::sqrt(2.0 * kTooWide_m / far_m);
  ArcSteps steps;
  steps.count = static_cast<std::uint32_t>(0.5 * std::abs(turn_rad) / half_most_rad) + 1;
  const double half_rad = 0.5 * turn_rad / steps.count;
  const Turn2 turn(half_rad);
  for (std::uint32_t half = 0; half < 2; ++half) {
    const double tip_m = half == 0 ? f.front_m : -f.rear_m;
    Eigen::Vector2d points[Piece::kCornersMost];
    std::uint32_t count = 0;
    for (const double x : {0.0, tip_m}) {
      for (const double y : {f.left_m, -f.right_m}) {
        const Eigen::Vector2d from_centre(x / turn.c, (y - centre_m) / turn.c), centre(0.0, centre_m);
        points[count++] = turn * from_centre + centre;
        points[count++] = turn.back(from_centre) + centre;
      }
    }
    steps.half[half] = hull_of(points);
  }
  return steps;
}

void RowBounds::merge(const Piece& piece, std::int32_t first_row) const {
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    Eigen::Vector2d a = piece.corner[k], b = piece.corner[k + 1 < piece.corners ? k + 1 : 0];
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
  piece.corners = body.corners;
  Eigen::Vector2d least(1e9, 1e9), most(-1e9, -1e9);
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    piece.corner[k] = grid_->in_cells(turn * body.corner[k] + at.place());
    least = least.cwiseMin(piece.corner[k]);
    most = most.cwiseMax(piece.corner[k]);
  }
  const bool is_inside =
      least.x() >= 0.0 && least.y() >= 0.0 && most.x() < grid_->width() && most.y() < grid_->height();
  if (!is_inside) return false;
  for (std::uint32_t k = 0; k < body.corners; ++k) {  // most that is not free is so at a corner
    const Eigen::Vector2d& corner = piece.corner[k];
    if (grid_->is_blocked(static_cast<std::int32_t>(corner.y()), static_cast<std::int32_t>(corner.x()))) return false;
  }
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

// Rock between the ends is mostly met by the middle line already.
bool Sweeps::is_straight_free(const Pose2& from, double along_m) {
  constexpr double kProbe_m = 0.5;  // a quick look alone: all of the way is swept behind it
  const Turn2 turn(from.yaw_rad);
  const auto probes = static_cast<std::uint32_t>(std::abs(along_m) / kProbe_m);
  rows_ += probes;
  for (std::uint32_t k = 1; k < probes; ++k) {
    const Eigen::Vector2d at = grid_->in_cells(from.place() + along_m * k / probes * Eigen::Vector2d(turn.c, turn.s));
    const bool is_inside = at.x() >= 0.0 && at.y() >= 0.0 && at.x() < grid_->width() && at.y() < grid_->height();
    if (!is_inside) return false;
    if (grid_->is_blocked(static_cast<std::int32_t>(at.y()), static_cast<std::int32_t>(at.x()))) return false;
  }
  return is_free(straight_piece(footprint_, larger(along_m, 0.0), larger(-along_m, 0.0)), from);
}

bool Sweeps::is_arc_free(const Pose2& from, double along_m, double turn_rad) {
  constexpr double kMostTurn_rad = 4.0 * kPi;  // two turns: no way needs more than one, and the loop needs an end
  if (!(std::abs(turn_rad) <= kMostTurn_rad)) return false;
  if (std::abs(turn_rad) < 1e-9) return is_straight_free(from, along_m);
  const ArcSteps steps = arc_steps(footprint_, along_m, turn_rad);
  for (std::uint32_t k = 0; k < steps.count; ++k) {
    const double part = (k + 0.5) / steps.count;
    const Pose2 middle = along_arc(from, part * along_m, part * turn_rad);
    if (!is_free(steps.half[0], middle) || !is_free(steps.half[1], middle)) return false;
  }
  return true;
}

Pose2 along_arc(const Pose2& from, double along_m, double turn_rad) {
  const double half_rad = 0.5 * turn_rad;
  // The chord: along sin(half) / half, at half the turn.
  const double ratio = std::abs(half_rad) > 1e-4 ? sine(half_rad) / half_rad : 1.0 - half_rad * half_rad / 6.0;
  const Turn2 middle(from.yaw_rad + half_rad);
  return {from.x_m + along_m * ratio * middle.c, from.y_m + along_m * ratio * middle.s, from.yaw_rad + turn_rad};
}

}  // namespace pose_wall::planar::route

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The machine's rectangle and what it sweeps: convex pieces, row by row, against the blocked bits. A piece covers at
// least all that the rectangle covers on its way: exactly for a pose and a straight stretch, and to within millimetres
// for turns and curves.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "place/pose2.hpp"
#include "planar/route/bit_grid.hpp"

namespace pose_wall::planar::route {

// Edges of the rectangle from the turning centre, margins included. All are positive.
struct Footprint {
  double front_m = 0.0, rear_m = 0.0, left_m = 0.0, right_m = 0.0;

  double length_m() const { return front_m + rear_m; }
  double inscribed_m() const;  // radius of the largest circle about the turning centre that it covers
  double reach_m() const;      // the farthest corner
};

// A convex piece. Corners go round it one way or the other.
struct Piece {
  static constexpr std::uint32_t kCornersMost = 8;  // a rectangle at both ends of a way
  Eigen::Vector2d corner[kCornersMost];
  std::uint32_t corners = 0;
};
Piece straight_piece(const Footprint& footprint, double forward_m, double backward_m);

// An arc in even steps, and what the front half and the rear half of the machine sweep in one of them, in the machine's
// axes at the middle of the step.
struct ArcSteps {
  std::uint32_t count = 1;
  Piece half[2];
};
ArcSteps arc_steps(const Footprint& footprint, double along_m, double turn_rad);

// Columns that a convex piece covers in each of the rows first_row + k, merged into low and high.
struct RowBounds {
  Span<double> low, high;  // low > high: the row is empty

  void clear(std::uint32_t rows) const {
    for (std::uint32_t k = 0; k < rows; ++k) {
      low[k] = 1e9;
      high[k] = -1e9;
    }
  }
  // Every row that the piece covers is one of low.size().
  void merge(const Piece& piece, std::int32_t first_row) const;
};

class Sweeps {
 public:
  void lay_out(Arena& arena, std::uint32_t height_max);
  void open(const BitGrid* grid, const Footprint& footprint) {
    grid_ = grid;
    footprint_ = footprint;
    rows_ = 0;
  }

  const Footprint& footprint() const { return footprint_; }
  bool is_pose_free(const Pose2& at);
  bool is_straight_free(const Pose2& from, double along_m);  // backwards: negative
  // Along an arc that turns by turn_rad, positive to the left, over along_m (backwards: negative; 0: on the spot).
  bool is_arc_free(const Pose2& from, double along_m, double turn_rad);
  bool is_turn_free(const Pose2& from, double turn_rad) { return is_arc_free(from, 0.0, turn_rad); }

  std::uint64_t rows() const { return rows_; }  // looked at so far: what the sweeps cost

 private:
  bool is_free(const Piece& body, const Pose2& at);

  const BitGrid* grid_ = nullptr;
  Footprint footprint_;
  RowBounds bounds_;
  std::uint64_t rows_ = 0;
};

// Where base stands after an arc that turns by turn_rad over along_m.
Pose2 along_arc(const Pose2& from, double along_m, double turn_rad);

}  // namespace pose_wall::planar::route

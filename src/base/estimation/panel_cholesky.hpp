// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Cholesky's factor of a matrix of some hundred rows, in floats and in an order of sums that no machine changes.
//
// Rows lie in panels of four: of each column the four values side by side. So four rows are worked on as one register,
// lane by lane, and nothing is ever summed across lanes.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

class PanelCholesky {
 public:
  static constexpr std::uint32_t kRowsMost = 96;  // a row for each of SurfacePatches::kMost
  // Floats of four rows, and of four right sides.
  static constexpr std::uint32_t kPanel = kFour * kRowsMost;

  static constexpr std::uint32_t panels_of(std::uint32_t rows) { return (rows + kFour - 1) / kFour; }

  void lay_out(Arena& arena) { panels_ = arena.take<float>(panels_of(kRowsMost) * kPanel); }

  // The rows 4 p to 4 p + 3: value k of column c is at 4 c + k. To be filled with the lower triangle and its diagonal,
  // and with the identity's rows up to a whole panel, before factor() makes the factor of it.
  float* panel(std::uint32_t p) { return &panels_[p * kPanel]; }

  // False if the matrix is not positive definite in floats.
  bool factor(std::uint32_t rows);
  // Four right sides, value k of row c at 4 c + k. Solves for each: the factor times the result gives the old value.
  void solve(std::uint32_t rows, float* right_sides) const { eliminate(panels_of(rows), right_sides); }
  // One over the factor's diagonal.
  float inverse_pivot(std::uint32_t row) const { return panels_[row / kFour * kPanel + kFour * row + row % kFour]; }

 private:
  void eliminate(std::uint32_t panels, float* rows) const;

  Span<float> panels_;  // the diagonal inverted; above it within a panel is nothing of meaning
};

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// For every start of a grid over yaw and place: at most how many observations lie on the map there. The map's surfaces
// are drawn as bits of a coarse grid, so that 49 places in a row are counted at once. The search looks exactly only
// where these bounds leave room for a better start.

#pragma once

#include "base/containers/work.hpp"
#include "motion/features.hpp"

namespace pose_wall::motion {

constexpr int kStartsMost = 24;                    // to each side, of yaw and of place
constexpr int kStartsInRow = 2 * kStartsMost + 1;  // fits a word of bits
constexpr double kPlaceStep_m = 0.3;               // of the grid: a layer is 0.35 m thick to each side
// Shares that a squared step costs, so that of starts that fit alike the nearest is taken. At the end of the grid that
// is 0.29 for place and 0.06 for yaw: about what a scan of the place has more than one of another (the gate
// on_map_found).
constexpr double kPlaceCost = 5e-4, kYawCost = 1e-4;
constexpr std::uint32_t kAskedMost = 250;  // observations that answer

// One start: steps from the middle.
struct Start {
  int yaw, x, y;
  double cost() const { return kPlaceCost * (x * x + y * y) + kYawCost * yaw * yaw; }
};
struct StartGrid {
  int yaws, places;  // to each side
  double yaw_step_rad;

  std::uint32_t in_row() const { return 2 * static_cast<std::uint32_t>(places) + 1; }
  std::uint32_t starts() const { return (2 * static_cast<std::uint32_t>(yaws) + 1) * in_row() * in_row(); }
  Start at(std::uint32_t index) const;
  // The facings of a yaw, of those of all yaws.
  Span<std::uint8_t> of_yaw(Span<std::uint8_t> facing, std::uint32_t asked, int yaw) const {
    return {facing.data() + static_cast<std::uint32_t>(yaw + yaws) * asked, asked};
  }
  Eigen::Matrix3d turn(int yaw) const { return turn_by(Eigen::Vector3d(0.0, 0.0, yaw_step_rad * yaw)); }
};

// The first row of places as an observation sees it: the words of the grid that hold its lower and its upper bits.
struct BitWindow {
  std::uint32_t low, high, shift;
};

struct StartScratch {
  void lay_out(Arena& arena);
  Span<std::uint64_t> bits;  // [facing][bin of height][word of x][y]
  Span<std::uint8_t> bound;  // [start], share less cost, in steps of kBoundUnit
  Span<std::uint32_t> best;  // starts, the best bound first
  Span<Observation> asked;
  Span<std::uint8_t> facing;  // [yaw][observation]
  Span<BitWindow> window;
};

constexpr double kBoundUnit = 1.0 / 255.0;  // a share of one fills a byte
constexpr std::uint32_t kExactMost = 128;   // of the grid that are tried exactly; see README, After gaps

// How observations face in another attitude. One that faces no axis there keeps its own.
void find_facings(const Eigen::Matrix3d& R_map_base, Span<const Observation> asked, Span<std::uint8_t> facing);

// The bounds of all starts about the pose, and how the observations face at each yaw. Gives how many of the best
// starts stand in scratch->best, at most kExactMost.
std::uint32_t count_starts(const ReliefMap& map, Span<const Observation> asked, const Pose& pose, const StartGrid& grid,
                           StartScratch* scratch, Work* work);

}  // namespace pose_wall::motion

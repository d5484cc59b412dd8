// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Poses along the road, tied by what was measured between them. The chain of neighbours makes a band of blocks, which
// is factored exactly. Closures stand outside the band. Conjugate gradients with the band as preconditioner take about
// as many rounds as there are independent closures (Dellaert et al., IROS 2010), and never more than a fixed number.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "place/pose2.hpp"

namespace pose_wall::planar {

struct Edge {
  std::uint32_t from = 0, to = 0;
  Pose2 step;                                             // of `to` in the frame of `from`
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of x, y, yaw of step
  bool is_closure = false;
};

// The error of an edge: x, y, yaw of the poses' step less those that were measured, in the frame of `from`.
Eigen::Vector3d error_of(const Edge& edge, const Pose2& from, const Pose2& to);

struct GraphRound {
  std::uint32_t gradients = 0;  // rounds of conjugate gradients
  double moved_m = 0.0;         // the most that a pose moved
};

class PoseGraph {
 public:
  void lay_out(Arena& arena, std::uint32_t poses_most);
  // One round of Gauss and Newton: moves poses towards what the edges say. The first pose stays. Edges between
  // neighbours go from k to k + 1. At most kGradientsMost times through all poses and edges.
  GraphRound improve(Span<Pose2> poses, Span<const Edge> edges) const;

  static constexpr std::uint32_t kGradientsMost = 40;  // a bound on the time of a call (README.md)

 private:
  using Block = Eigen::Matrix3d;
  using Vector = Eigen::Vector3d;

  void linearise(Span<Pose2> poses, Span<const Edge> edges) const;
  void factor(std::uint32_t count) const;
  void precondition(std::uint32_t count) const;
  void multiply(Span<const Edge> edges, std::uint32_t count) const;
  std::uint32_t gradients(Span<const Edge> edges, std::uint32_t count) const;

  struct Row {
    Block diagonal, next;    // of H: with itself, with the next pose
    Block inverse, carried;  // of the band: inverse of the reduced diagonal; next' inverse
    Vector right, x, r, z, p, q;
  };
  Span<Row> rows_;
  struct Tie {  // a closure's block of H
    Block between;
  };
  mutable Span<Tie> ties_;
};

}  // namespace pose_wall::planar

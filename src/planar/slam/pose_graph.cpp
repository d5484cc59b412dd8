// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/pose_graph.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kClosuresMost = 8192;  // two for each keyframe of the default trail

bool is_band(const Edge& edge) {
  return edge.to == edge.from + 1;
}

struct Jacobians {
  Eigen::Matrix3d from, to;
};

Jacobians jacobians_of(const Pose2& from, const Pose2& to) {
  const Turn2 turn(from.yaw_rad);
  const Eigen::Vector2d d = turn.back(to.place() - from.place());
  Jacobians out;
  out.from << -turn.c, -turn.s, d.y(), turn.s, -turn.c, -d.x(), 0.0, 0.0, -1.0;
  out.to << turn.c, turn.s, 0.0, -turn.s, turn.c, 0.0, 0.0, 0.0, 1.0;
  return out;
}

// A closure that contradicts the rest pulls less than by its square, but never ceases to (Huber): it was believed for
// good reasons, and a long loop begins metres off.
double weight_of(const Edge& edge, double squared) {
  constexpr double kBelieved = 11.3;  // 99 % of a chi-square of three
  return !edge.is_closure || squared <= kBelieved ? 1.0 : std::sqrt(kBelieved / squared);
}

}  // namespace

Eigen::Vector3d error_of(const Edge& edge, const Pose2& from, const Pose2& to) {
  const Pose2 step = between(from, to);
  return {step.x_m - edge.step.x_m, step.y_m - edge.step.y_m, wrapped(step.yaw_rad - edge.step.yaw_rad)};
}

void PoseGraph::lay_out(Arena& arena, std::uint32_t poses_most) {
  rows_ = arena.take<Row>(poses_most);
  ties_ = arena.take<Tie>(kClosuresMost);
}

void PoseGraph::linearise(Span<Pose2> poses, Span<const Edge> edges) const {
  const std::uint32_t count = poses.size();
  for (std::uint32_t k = 0; k < count; ++k) {
    rows_[k].diagonal.setZero();
    rows_[k].next.setZero();
    rows_[k].right.setZero();
  }
  constexpr double kStays = 1e12;  // of information: a micrometre, for the pose that holds the map
  rows_[0].diagonal = kStays * Block::Identity();
  std::uint32_t ties = 0;
  for (const Edge& edge : edges) {
    const Pose2 &from = poses[edge.from], &to = poses[edge.to];
    const Vector error = error_of(edge, from, to);
    const double squared = error.dot(edge.information * error);
    const Block weighed = weight_of(edge, squared) * edge.information;
    const Jacobians j = jacobians_of(from, to);
    const Block from_weighed = j.from.transpose() * weighed, to_weighed = j.to.transpose() * weighed;
    rows_[edge.from].diagonal += from_weighed * j.from;
    rows_[edge.to].diagonal += to_weighed * j.to;
    rows_[edge.from].right -= from_weighed * error;
    rows_[edge.to].right -= to_weighed * error;
    if (is_band(edge)) {
      rows_[edge.from].next += from_weighed * j.to;
    } else if (ties < ties_.size()) {
      ties_[ties++].between = from_weighed * j.to;
    }
  }
}

// Band = L D L', block by block.
void PoseGraph::factor(std::uint32_t count) const {
  Block reduced = rows_[0].diagonal;
  for (std::uint32_t k = 0; k < count; ++k) {
    Row& row = rows_[k];
    row.inverse = reduced.inverse();
    if (k + 1 == count) break;
    row.carried = row.next.transpose() * row.inverse;
    reduced = rows_[k + 1].diagonal - row.carried * row.next;
  }
}

// z = band^-1 r
void PoseGraph::precondition(std::uint32_t count) const {
  rows_[0].z = rows_[0].r;
  for (std::uint32_t k = 1; k < count; ++k) rows_[k].z = rows_[k].r - rows_[k - 1].carried * rows_[k - 1].z;
  rows_[count - 1].z = rows_[count - 1].inverse * rows_[count - 1].z;
  for (std::uint32_t k = count - 1; k-- > 0;) {
    rows_[k].z = rows_[k].inverse * (rows_[k].z - rows_[k].next * rows_[k + 1].z);
  }
}

// q = H p
void PoseGraph::multiply(Span<const Edge> edges, std::uint32_t count) const {
  for (std::uint32_t k = 0; k < count; ++k) rows_[k].q = rows_[k].diagonal * rows_[k].p;
  for (std::uint32_t k = 0; k + 1 < count; ++k) {
    rows_[k].q += rows_[k].next * rows_[k + 1].p;
    rows_[k + 1].q += rows_[k].next.transpose() * rows_[k].p;
  }
  std::uint32_t ties = 0;
  for (const Edge& edge : edges) {
    if (is_band(edge) || ties == ties_.size()) continue;
    const Block& between = ties_[ties++].between;
    rows_[edge.from].q += between * rows_[edge.to].p;
    rows_[edge.to].q += between.transpose() * rows_[edge.from].p;
  }
}

std::uint32_t PoseGraph::gradients(Span<const Edge> edges, std::uint32_t count) const {
  constexpr double kEnough = 1e-10;  // of the first residual, squared
  for (std::uint32_t k = 0; k < count; ++k) {
    rows_[k].x.setZero();
    rows_[k].r = rows_[k].right;
  }
  precondition(count);
  double rz = 0.0;
  for (std::uint32_t k = 0; k < count; ++k) {
    rows_[k].p = rows_[k].z;
    rz += rows_[k].r.dot(rows_[k].z);
  }
  const double first = rz;
  std::uint32_t done = 0;
  while (done < kGradientsMost && rz > kEnough * first && rz > 0.0) {
    ++done;
    multiply(edges, count);
    double pq = 0.0;
    for (std::uint32_t k = 0; k < count; ++k) pq += rows_[k].p.dot(rows_[k].q);
    if (!(pq > 0.0)) break;
    const double alpha = rz / pq;
    for (std::uint32_t k = 0; k < count; ++k) {
      rows_[k].x += alpha * rows_[k].p;
      rows_[k].r -= alpha * rows_[k].q;
    }
    precondition(count);
    double next = 0.0;
    for (std::uint32_t k = 0; k < count; ++k) next += rows_[k].r.dot(rows_[k].z);
    for (std::uint32_t k = 0; k < count; ++k) rows_[k].p = rows_[k].z + (next / rz) * rows_[k].p;
    rz = next;
  }
  return done;
}

GraphRound PoseGraph::improve(Span<Pose2> poses, Span<const Edge> edges) const {
  GraphRound out;
  const std::uint32_t count = poses.size();
  if (count < 2 || count > rows_.size()) return out;
  linearise(poses, edges);
  factor(count);
  out.gradients = gradients(edges, count);
  for (std::uint32_t k = 1; k < count; ++k) {
    const Vector& x = rows_[k].x;
    out.moved_m = std::max(out.moved_m, std::max(std::abs(x.x()), std::abs(x.y())));
    poses[k] = {poses[k].x_m + x.x(), poses[k].y_m + x.y(), wrapped(poses[k].yaw_rad + x.z())};
  }
  return out;
}

}  // namespace pose_wall::planar

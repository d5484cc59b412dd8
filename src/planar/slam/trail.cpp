// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/trail.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kPointsPerKeyframe = 360;  // in the mean: a whole turn in a road
constexpr std::uint32_t kEdgesPerKeyframe = 3;     // one to the last, others to old ones

}  // namespace

void Trail::lay_out(Arena& arena, std::uint32_t keyframes_most) {
  keyframes_ = arena.take<Keyframe>(keyframes_most);
  poses_ = arena.take<Pose2>(keyframes_most);
  points_ = arena.take<ScanPoint>(keyframes_most * kPointsPerKeyframe);
  edges_ = arena.take<Edge>(keyframes_most * kEdgesPerKeyframe);
}

void Trail::open() {
  count_ = point_count_ = edge_count_ = 0;
}

bool Trail::add(Span<const ScanPoint> points, const Pose2& pose, std::int64_t stamp_ns, const Beyond& beyond) {
  if (count_ == keyframes_.size() || points_.size() - point_count_ < points.size()) return false;
  Keyframe& keyframe = keyframes_[count_];
  keyframe = {stamp_ns, point_count_, points.size(), 0.0, 0.0};
  if (count_ > 0) {
    const Pose2 step = between(poses_[count_ - 1], pose);
    keyframe.travel_m =
        keyframes_[count_ - 1].travel_m + beyond.leap_m + std::sqrt(step.x_m * step.x_m + step.y_m * step.y_m);
    keyframe.doubt_rad = keyframes_[count_ - 1].doubt_rad + beyond.doubt_rad;
  }
  std::copy(points.begin(), points.end(), points_.begin() + point_count_);
  poses_[count_++] = pose;
  point_count_ += points.size();
  return true;
}

bool Trail::tie(const Edge& edge) {
  if (edge_count_ == edges_.size()) return false;
  edges_[edge_count_++] = edge;
  return true;
}

Trail::Range Trail::around(std::uint32_t k, double reach_m, std::uint32_t most, Range within) const {
  Range out{k, k};
  while (out.first > within.first && k - out.first < most && travel_between_m(k, out.first - 1) < reach_m) --out.first;
  while (out.last < within.last && out.last - k < most && travel_between_m(k, out.last + 1) < reach_m) ++out.last;
  return out;
}

void Trail::draw(SurfaceMap* map, std::uint32_t k, Range range) const {
  map->begin(poses_[k].place());
  // Neighbours' lines of sight go through the same cells.
  constexpr std::uint32_t kSightEvery = 3;
  for (std::uint32_t i = range.first; i <= range.last; ++i) map->add(points(i), poses_[i], (i - k) % kSightEvery == 0);
  map->finish();
}

std::uint32_t Trail::nearest(const Eigen::Vector2d& place_m) const {
  std::uint32_t nearest = 0;
  for (std::uint32_t k = 1; k < count_; ++k) {
    if ((poses_[k].place() - place_m).squaredNorm() < (poses_[nearest].place() - place_m).squaredNorm()) nearest = k;
  }
  return nearest;
}

}  // namespace pose_wall::planar

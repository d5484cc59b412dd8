// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/recent.hpp"

#include <algorithm>
#include <cmath>

#include "planar/gates.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kKeyframe_m = 0.3, kKeyframe_rad = 0.25;  // as the SLAM's by default
constexpr double kLookBack_m = 8.0;                        // README.md, metres help: searched for as one

double length_of(const Pose2& step) {
  return step.place().norm();
}

}  // namespace

void Recent::lay_out(Arena& arena) {
  near_.lay_out(arena);
  kept_ = arena.take<Kept>(kKeyframesMost);
  points_ = arena.take<ScanPoint>(kKeyframesMost * kMatchPointsMost);
}

void Recent::open(double odometry_m, double odometry_rad) {
  near_.open();
  follower_.open(odometry_m, odometry_rad);
  clear();
}

void Recent::clear() {
  first_ = count_ = 0;
  follower_.begin();
  pose_ = Pose2();
  travel_m_ = turned_rad_ = 0.0;
}

Span<const ScanPoint> Recent::points_of(std::uint32_t k) const {
  const std::uint32_t slot = (first_ + k) % kKeyframesMost;
  return Span<const ScanPoint>(points_.data() + slot * kMatchPointsMost, kept_[slot].count);
}

double Recent::look_back_m() const {
  return count_ > 0 ? std::min(kLookBack_m, travel_m_ - kept(0).travel_m) : 0.0;
}

bool Recent::follow(Span<const ScanPoint> points, const BeamScan& scan, const Pose2* odometry, Matcher& matcher) {
  bool continues = true;
  if (count_ > 0) {
    const Fit placed = follower_.follow(pose_, points, near_, scan.sigma_m, odometry, matcher).match;
    continues = placed.is_valid && passes<gate::RECENT>(placed.explained);
    if (continues) {
      const Pose2 step = between(pose_, placed.pose);
      pose_ = placed.pose;
      travel_m_ += length_of(step);
      turned_rad_ += std::abs(step.yaw_rad);
    } else {
      clear();
    }
  }
  if (count_ == 0) follower_.see_first(odometry);
  keep(points);
  return continues;
}

void Recent::keep(Span<const ScanPoint> points) {
  if (count_ > 0) {
    const Pose2 since = between(kept(count_ - 1).pose, pose_);
    if (length_of(since) < kKeyframe_m && std::abs(since.yaw_rad) < kKeyframe_rad) return;
  }
  if (count_ == kKeyframesMost) {
    first_ = (first_ + 1) % kKeyframesMost;
    --count_;
  }
  const std::uint32_t slot = (first_ + count_) % kKeyframesMost;
  kept_[slot] = {pose_, travel_m_, points.size()};
  std::copy(points.begin(), points.end(), points_.begin() + slot * kMatchPointsMost);
  ++count_;
  draw();
}

void Recent::draw() {
  near_.begin(pose_.place());
  for (std::uint32_t k = 0; k < count_; ++k) {
    if (travel_m_ - kept(k).travel_m < kLookBack_m) near_.add(points_of(k), kept(k).pose, true);
  }
  near_.finish();
}

void Recent::gather(Span<const ScanPoint> points, const BeamScan& scan, Surroundings* out) const {
  std::uint32_t first = 0, all = points.size();
  while (first < count_ && travel_m_ - kept(first).travel_m > kLookBack_m) ++first;
  // The last keyframe may be this very scan.
  const bool is_kept = count_ > 0 && length_of(between(kept(count_ - 1).pose, pose_)) == 0.0;
  const std::uint32_t end = is_kept ? count_ - 1 : count_;
  for (std::uint32_t k = first; k < end; ++k) all += kept(k).count;
  // Half of the room is the present scan's, which nothing can have moved.
  const std::uint32_t own =
      std::min(points.size(), all > kSurroundingsMost ? kSurroundingsMost / 2 : kSurroundingsMost);
  const std::uint32_t own_stride = own > 0 ? (points.size() + own - 1) / own : 1;
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < points.size() && count < kSurroundingsMost; k += own_stride)
    out->room[count++] = points[k];
  const std::uint32_t others = all - points.size(), room = kSurroundingsMost - count;
  const std::uint32_t stride = room > 0 ? std::max(1U, (others + room - 1) / room) : 1;
  std::uint32_t seen = 0;
  for (std::uint32_t k = first; k < end; ++k) {
    const Pose2 in_base = between(pose_, kept(k).pose);
    const Turn2 turn(in_base.yaw_rad);
    for (const ScanPoint& point : points_of(k)) {
      if (seen++ % stride != 0 || count == kSurroundingsMost) continue;
      const Eigen::Vector2d p = turn * as_double(point) + in_base.place();
      out->room[count++] = {static_cast<float>(p.x()), static_cast<float>(p.y())};
    }
  }
  out->sort(out->room.first(count), scan.sigma_m);
  out->take_sights(points, scan.origin_m);
}

}  // namespace pose_wall::planar

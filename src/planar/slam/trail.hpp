// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The scans that the map is made of, in the order in which they were seen.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "planar/match/surface_map.hpp"
#include "planar/slam/pose_graph.hpp"

namespace pose_wall::planar {

struct Keyframe {
  std::int64_t stamp_ns;
  std::uint32_t first, count;  // points
  double travel_m;             // since the first one, whichever way
  double doubt_rad;            // by how much yaw can have gone astray since then, where scans fitted badly
};

class Trail {
 public:
  void lay_out(Arena& arena, std::uint32_t keyframes_most);
  void open();
  // What happened since the last keyframe beyond the way between the two poses.
  struct Beyond {
    double leap_m = 0.0;     // travel that nobody saw
    double doubt_rad = 0.0;  // of yaw
  };
  // False where it is full.
  bool add(Span<const ScanPoint> points, const Pose2& pose, std::int64_t stamp_ns, const Beyond& beyond);
  bool tie(const Edge& edge);
  void untie(std::uint32_t edge) { edges_[edge].information.setZero(); }

  std::uint32_t size() const { return count_; }
  std::uint32_t point_count() const { return point_count_; }
  std::uint32_t capacity() const { return keyframes_.size(); }
  const Keyframe& operator[](std::uint32_t k) const { return keyframes_[k]; }
  const Pose2& pose(std::uint32_t k) const { return poses_[k]; }
  Span<Pose2> poses() const { return poses_.first(count_); }
  Span<const Edge> edges() const { return edges_.first(edge_count_); }
  Span<const ScanPoint> points(std::uint32_t k) const {
    return Span<const ScanPoint>(points_.data() + keyframes_[k].first, keyframes_[k].count);
  }
  double travel_between_m(std::uint32_t a, std::uint32_t b) const {
    return a < b ? keyframes_[b].travel_m - keyframes_[a].travel_m : keyframes_[a].travel_m - keyframes_[b].travel_m;
  }

  double doubt_between_rad(std::uint32_t a, std::uint32_t b) const {
    return a < b ? keyframes_[b].doubt_rad - keyframes_[a].doubt_rad
                 : keyframes_[a].doubt_rad - keyframes_[b].doubt_rad;
  }

  struct Range {
    std::uint32_t first, last;
  };
  // The keyframes about k within so much travel, at most `most` to each side, none before first or after last.
  Range around(std::uint32_t k, double reach_m, std::uint32_t most, Range within) const;
  // Their surfaces, in a window about k.
  void draw(SurfaceMap* map, std::uint32_t k, Range range) const;

  // The number of the keyframe nearest to a place. There is one.
  std::uint32_t nearest(const Eigen::Vector2d& place_m) const;

 private:
  friend class TrailImage;
  Span<Keyframe> keyframes_;
  Span<Pose2> poses_;
  Span<ScanPoint> points_;
  Span<Edge> edges_;
  std::uint32_t count_ = 0, point_count_ = 0, edge_count_ = 0;
};

}  // namespace pose_wall::planar

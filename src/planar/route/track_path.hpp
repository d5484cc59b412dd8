// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A route as the tracker goes along it: legs between stops, and the point of a leg that belongs to a pose.

#pragma once

#include <cstdint>

#include "base/containers/span.hpp"
#include "place/pose2.hpp"
#include "pose_wall_planar_plan.h"

namespace pose_wall::planar::route {

// Poses `first` to `last` of a route: driven one way, or a turn on the spot, without a stop between.
struct Leg {
  std::uint32_t first = 0, last = 0;
  std::int32_t drive = 0;  // 1 forwards, -1 backwards, 0 a turn on the spot
};

// A point of the route and how a pose lies to it.
struct OnPath {
  std::uint32_t index = 0;     // the last pose that was passed
  double along_m = 0.0;        // of the route
  double yaw_rad = 0.0;        // of the machine there
  double curvature_1_m = 0.0;  // there, to the machine's left
  double cross_m = 0.0;        // to the left of the machine as it should stand
  double heading_rad = 0.0;    // turned to the left against the route
};

class TrackPath {
 public:
  void take(Span<const pose_wall_planar_path_pose> poses) { poses_ = poses; }
  std::uint32_t size() const { return poses_.size(); }
  const pose_wall_planar_path_pose& operator[](std::uint32_t k) const { return poses_[k]; }

  // The leg that begins at a pose; first == last at the end of the route.
  Leg leg_from(std::uint32_t first) const;
  // The point nearest to a pose, not before `from` and not far beyond.
  OnPath nearest(const Leg& leg, std::uint32_t from, const Pose2& pose) const;
  // What is left to turn to the leg's last yaw, in the leg's own sense.
  double left_to_turn(const Leg& leg, double yaw_rad) const;
  double sharpest_1_m(const Leg& leg, const OnPath& at, double ahead_m) const;
  double end_m(const Leg& leg) const { return poses_[leg.last].along_m; }

 private:
  OnPath on_stretch(std::uint32_t k, const Pose2& pose, double* distance_squared) const;

  Span<const pose_wall_planar_path_pose> poses_;
};

}  // namespace pose_wall::planar::route

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The uncertainty of a pose: the covariance of the map's place, which adds up keyframe by keyframe, and the levels.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pose_wall_motion.h"

namespace pose_wall::motion {

using Six = Eigen::Matrix<double, POSE_WALL_MOTION_DIRECTIONS, 1>;
using SixBySix = Eigen::Matrix<double, POSE_WALL_MOTION_DIRECTIONS, POSE_WALL_MOTION_DIRECTIONS>;

struct Bounds {
  Six sigma = Six::Zero(), level = Six::Zero();

  // By the unknown part, evenly over its range.
  void widen(double place_m, double turn_rad);
};

// A way of many pieces, each in a direction of its own.
class Pieces {
 public:
  void add(double m, const Eigen::Vector3d& direction);
  void add(const Pieces& other);
  // At most so far in a direction. The sum of s |a d| over pieces s along a is no more than the root of two
  // sums' product: of s, and of s (a d)² (Cauchy and Schwarz). Along one straight road it is that.
  double towards(const Eigen::Vector3d& direction) const;
  double m() const { return m_; }

 private:
  double m_ = 0.0;
  Eigen::Matrix3d by_way_ = Eigen::Matrix3d::Zero();
};

// A covariance in the axes of the road, in its axes further on.
SixBySix turned(const SixBySix& covariance, const Eigen::Matrix3d& in_road_before, const Eigen::Matrix3d& in_road_now);

// Axes of the road are the rows of a turn into it from the map: along, left, up.
class Travel {
 public:
  void reset() { *this = Travel{}; }
  // The machine went so far along, across and up; the map's turns become its place. Errors stay where they are when the
  // axes of the road turn.
  void go(const Eigen::Vector3d& moved_m, const Eigen::Matrix3d& in_road);
  // A keyframe enters a map of so many, itself among them, with the errors of its own alignment.
  void take_in(const SixBySix& of_alignment, std::uint32_t keyframes);
  // A new map begins with a frame: all of its errors are the map's.
  void begin_with(const SixBySix& of_alignment);
  // The way is unknown: known to within so many metres. The map's surfaces are then those of another place, whose
  // slopes differ by the unevenness.
  void slip(const Pieces& slip, double unevenness);
  // Everything is known to within so much only: after a frame that was lost.
  void lose(double place_m, double turn_rad) {
    lost_m_ += place_m;
    lost_rad_ += turn_rad;
  }
  // slipping: the slip that may yet be undone.
  Bounds bounds(const SixBySix& of_alignment, const Pieces& slipping, double factor) const;
  // The part that comes and goes with this alignment.
  Six level_of(const SixBySix& of_alignment, const Pieces& slipping, double factor) const;
  // Of the way from one frame to the next, each against the same map.
  Bounds of_step(const SixBySix& before, const SixBySix& now, const Pieces& slipped, double factor) const;

  // Variances of a step by the patches of rock alone.
  static Six variance_of_step(const SixBySix& before, const SixBySix& now);

  // The lasting part of each direction's errors since reset, without lever arms. The error between two places in one
  // map is that of either alignment and the difference of these two.
  const Six& drift_variance() const { return drift_variance_; }
  const Six& drift() const { return drift_; }

  double along_m() const { return along_m_; }

 private:
  void drift_by(const SixBySix& covariance);
  double part_of(const Pieces& way, int k) const {
    return k < POSE_WALL_MOTION_ROLL ? way.towards(in_road_.row(k)) : 0.0;
  }

  SixBySix of_map_ = SixBySix::Zero();
  Six drift_variance_ = Six::Zero(), drift_ = Six::Zero();
  double along_m_ = 0.0;
  Eigen::Matrix3d in_road_ = Eigen::Matrix3d::Identity();
  Pieces way_, slip_;
  double lost_m_ = 0.0, lost_rad_ = 0.0;
};

}  // namespace pose_wall::motion

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The motion within a scan: whether to take it out, and what of it stays unknown in the values (README, Motion within a
// scan).

#pragma once

#include <Eigen/Core>

#include "engine/cloud/result.hpp"
#include "engine/config.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/output/measurements.hpp"
#include "engine/types.hpp"
#include "engine/walls/wall.hpp"
#include "pose_wall.h"

namespace pose_wall {

// What floor and walls of the last frame showed. Levels are without what its scan's motion added.
struct OwnChanges {
  double raw[POSE_WALL_QUANTITIES] = {};
  double level[POSE_WALL_QUANTITIES] = {};      // infinite: nothing to compare with
  double random[POSE_WALL_QUANTITIES] = {};     // of it, the random part
  double taken_out[POSE_WALL_QUANTITIES] = {};  // rate by the motion that was taken out: m/s, rad/s
  // What the motion that was taken out of the scan before does not explain; not a number: unknown.
  double change[POSE_WALL_QUANTITIES] = {};
  double scan_s = 0.0;                                                                // how long its scan took
  Eigen::Vector3d up_base = Eigen::Vector3d::UnitZ();                                 // normal of the floor
  Eigen::Vector3d wall_base[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  // zero: never seen

  OwnChanges() { forget(); }
  // Nothing is comparable with the next frame.
  void forget();
};

// Of a frame: how long its scan took, and the step from the last one.
struct ScanInTime {
  ScanTime scan;
  ScanStep step;
  bool has_times = true;  // of its points, by which an odometry could free it
};

// scan: by the times that freed it of motion; none: as long as the step from the last frame, up to
// scan_max; a first frame's, too.
ScanInTime scan_in_time(const ScanTime& scan, const ScanStep& step, const Settings& settings);

// The odometry's motion in base, for walls whose normals are known there. odometry: null for none.
class MotionInScan {
 public:
  MotionInScan(const pose_wall_odometry* odometry, const Settings& settings, const Axes& axes);

  // Whether the odometry's levels are narrower than the motion that it tells. One that is hardly known would bend the
  // scan, and what is left in it shows from frame to frame. A scan takes as long as the last one.
  bool improves(const OwnChanges& last) const;

  // Adds what is unknown of the motion to the levels: what the odometry leaves, or what the values of the last frames
  // show, if that is less. Where nothing could be taken out, for want of times or of an odometry, sets shown_motion:
  // what the values show, or what the odometry tells for sure. Keeps the values. Deviations stay those of the
  // measurement.
  void widen(bool taken_out, const ScanInTime& time, const Levelling& levelling, const JudgedWall (&walls)[2],
             OwnChanges* last, Measurements* measured) const;

 private:
  double rate_of(std::uint32_t quantity, const OwnChanges& surfaces) const;
  double moves(std::uint32_t quantity, const OwnChanges& surfaces) const;
  double lever_m(std::uint32_t quantity) const;
  double by_odometry(std::uint32_t quantity, double seconds, double random, const OwnChanges& surfaces) const;

  const Settings& settings_;
  const Axes& axes_;
  const bool is_told_;                                     // by an odometry
  Eigen::Vector3d direction_base_[3];                      // along, across, up
  double rate_level_[POSE_WALL_ODOMETRY_DIRECTIONS] = {};  // m/s, rad/s
  Eigen::Vector3d velocity_base_m_s_, turn_base_rad_s_;
};

}  // namespace pose_wall

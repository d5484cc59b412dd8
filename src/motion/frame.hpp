// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What a frame is given: its cloud and time, the settings, and the machine's course up to then. No step of a frame
// writes any of it.

#pragma once

#include "motion/registration.hpp"
#include "motion/travel.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::motion {

struct MotionSettings {
  double speed_max_m_s = 2.0, turn_max_rad_s = 1.5, keyframe_m = 0.2;
  double protection_sigmas = 0.0;  // by the engine's integrity_risk
  Eigen::Vector3d forward_base = Eigen::Vector3d::UnitX();
};

struct Frame {
  const pose_wall_cloud& cloud;
  double dt_s;   // since the map's last scan was placed
  bool is_late;  // by what is usual
};

// Where the machine stands on the map, how it came there, and how well that is known: all that a frame's place hangs on
// beside map and motion.
struct Course {
  Pose pose;
  RoadAxes axes;
  SixBySix covariance = SixBySix::Zero();  // of the last alignment, with what slip adds
  SixBySix of_rock = SixBySix::Zero();     // the same by the patches of rock alone
  double rock_variance_m2 = 0.0;           // of the way along by the rock, pooled over frames; 0: none yet on this map
  Travel travel;
  Pieces slipped;            // since the way was last known on this relief
  Pieces since_known;        // since it was last known, whatever the relief
  double lost_s = 0.0;       // since the last pose, where the map began anew
  std::uint32_t frames = 0;  // on this map
  bool is_bent = false;      // the map's scans, by unknown motion
  bool guesses = false;      // keyframes of unknown place since the way was last known

  // What slipped can no longer be undone: the map's surfaces are those of another place.
  void lose_slip(double unevenness) {
    travel.slip(slipped, unevenness);
    slipped = Pieces{};
    guesses = false;
  }

  Bounds bounds(double factor) const { return travel.bounds(covariance, slipped, factor); }
};

}  // namespace pose_wall::motion

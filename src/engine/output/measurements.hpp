// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The measurements of one frame, before any other frame is considered.

#pragma once

#include <cstdint>

#include "engine/types.hpp"
#include "pose_wall.h"

namespace pose_wall {

// One of the seven quantities, as this frame measured it.
struct Measurement {
  bool measured = false;
  bool stale = false;  // of a cloud that came before: never better than degraded
  double raw = 0.0;
  double sigma = 0.0;
  double dof = 1.0;  // behind the random part of protection
  ProtectionParts protection;
  // How far off motion within a scan may have put it that nobody took out, as far as it shows. Widens the value's
  // level, and the last good one's, but explains no jump of this frame: it follows from the same change.
  double shown_motion = 0.0;
  std::uint32_t reasons = 0;
};

struct Measurements {
  Measurement quantity[POSE_WALL_QUANTITIES];
  double left_right_yaw_difference_rad = 0.0;
  bool has_yaw_difference = false;
};

// The timing of a frame, by its stamp.
struct FrameTiming {
  double dt_s = 0.0;  // since the last frame, 0 for the first
  bool first = false;
  bool still = false;  // the last frame's stamp again
  bool back = false;   // older than the last frame's
  bool leap = false;   // more than stamp_gap_max ahead
  std::uint32_t reasons = 0;
};

// From the last scan to this one, as the scans show motion.
struct ScanStep {
  double s = 0.0;  // 0 for a first frame
  // By the stamps. Where these jumped it is the sensor's own step, and may have been longer: then what moved meanwhile
  // counts as faster than it was, and proves nothing of how slow it is.
  bool is_told = true;
};

// Which of the two walls a distance belongs to: 0 left, 1 right.
inline int side_of(std::uint32_t quantity) {
  return quantity == POSE_WALL_D_LF || quantity == POSE_WALL_D_LB ? 0 : 1;
}

}  // namespace pose_wall

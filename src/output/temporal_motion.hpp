// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// By how much the seven quantities may have changed since the last frame: by the config's greatest rates, by what the
// machine knows of itself in this frame (pose_wall_inputs), or by an odometry (temporal_odometry).

#pragma once

#include <cstdint>

#include "config.hpp"
#include "pose_wall.h"

namespace pose_wall {

// As pose_wall_inputs documents them. A roadheader is never as fast: more is a wrong unit or a broken sensor:
constexpr double kSpeedMost_m_s = 50.0;
constexpr double kTurnRateMost_rad_s = 10.0;

struct Change {
  double carry[POSE_WALL_QUANTITIES] = {};   // what is known of it: a held value moves by it
  double growth[POSE_WALL_QUANTITIES] = {};  // what is not: a held level grows by it
  // Where both frames have places of one odometry. Places err frame by frame, and that does not add up; what drifts
  // does.
  bool by_places[POSE_WALL_QUANTITIES] = {};
  double place_level_before[POSE_WALL_QUANTITIES] = {};
  double place_level[POSE_WALL_QUANTITIES] = {};
  double drift2[POSE_WALL_QUANTITIES] = {};  // variance times protection_factor^2
};

// What is not known of a quantity since the frame that measured it.
struct Unknown {
  double sum = 0.0;     // what adds up
  double drift2 = 0.0;  // what adds up in squares
  double place_level_then = 0.0, place_level = 0.0;
  std::uint64_t steps_by_places = 0;  // in a row
  double blind_s = 0.0;               // for so long no place told what changed

  double total() const;
  void grow(const Change& by, std::uint32_t quantity, double elapsed_s);
};

Change change_by_config(const Settings& settings, double elapsed_s);

// False where a member is out of its range, or two contradict each other: then *change is unchanged.
bool change_by_inputs(const pose_wall_inputs& inputs, const Settings& settings, double elapsed_s, Change* change);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The change of the seven quantities since the last frame: by the config's greatest rates, by the machine's own data of
// this frame (pose_wall_inputs), or by an odometry (temporal_odometry).

#pragma once

#include <cstdint>

#include "engine/config.hpp"
#include "pose_wall.h"

namespace pose_wall {

// As pose_wall_inputs documents them. No roadheader is as fast: more is a wrong unit or a broken sensor:
constexpr double kSpeedMost_m_s = 50.0;
constexpr double kTurnRateMost_rad_s = 10.0;

struct Change {
  double carry[POSE_WALL_QUANTITIES] = {};   // the known change: a held value moves by it
  double growth[POSE_WALL_QUANTITIES] = {};  // the unknown change: a held level grows by it
  // If both frames have places of one odometry. Errors of places come and go with each frame and do not add up; drift
  // does.
  bool by_places[POSE_WALL_QUANTITIES] = {};
  double place_level_before[POSE_WALL_QUANTITIES] = {};
  double place_level[POSE_WALL_QUANTITIES] = {};
  double drift2[POSE_WALL_QUANTITIES] = {};  // variance times protection_sigmas^2
  // Of growth, what comes of the way along a surface whose direction is not quite known.
  double by_way[POSE_WALL_QUANTITIES] = {};
  // Share of the rock behind a quantity that this way has brought into view.
  double new_rock[POSE_WALL_QUANTITIES] = {};
  bool by_odometry = false;  // both frames have places, whatever was seen from them
};

// The unknown change of a quantity since the frame that measured it.
struct Unknown {
  double sum = 0.0;     // adds up
  double drift2 = 0.0;  // adds up in squares
  double place_level_then = 0.0, place_level = 0.0;
  std::uint64_t steps_by_places = 0;  // in a row
  double blind_s = 0.0;               // time without a place that gave the change

  double total() const;
  void grow(const Change& by, std::uint32_t quantity, double elapsed_s);
};

Change change_by_config(const Settings& settings, double elapsed_s);

// False if a member is out of its range or two contradict each other; then *change is unchanged.
bool change_by_inputs(const pose_wall_inputs& inputs, const Settings& settings, double elapsed_s, Change* change);

}  // namespace pose_wall

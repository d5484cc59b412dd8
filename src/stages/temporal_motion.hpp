// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How fast the seven quantities may change between two frames: by the config's greatest rates, or by what the machine
// knows of itself in this frame (pose_wall_inputs).

#pragma once

#include "config.hpp"
#include "pose_wall.h"

namespace pose_wall {

struct MotionRates {
  // Per second: what is not known of a change. A held level grows by it.
  double growth[POSE_WALL_QUANTITIES] = {};
  // Per second: what is known of it. A held value moves by it.
  double carry[POSE_WALL_QUANTITIES] = {};
};

MotionRates rates_by_config(const Settings& settings);

// False where a member is out of its range, or two contradict each other: then *rates is unchanged.
bool rates_by_inputs(const pose_wall_inputs& inputs, const Settings& settings, MotionRates* rates);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Settings of the stop: defaults and limits.

#pragma once

#include <cstdint>

#include "pose_wall_planar_stop.h"

namespace pose_wall::planar {

using StopSettings = pose_wall_planar_stop_settings;

StopSettings default_stop_settings();
void set_rectangle(StopSettings* settings, double x_min_m, double x_max_m, double y_min_m, double y_max_m);

// POSE_WALL_OK, POSE_WALL_E_STRUCT_SIZE or POSE_WALL_E_VALUE_RANGE with its fault (may be NULL).
std::int32_t check_stop_settings(const StopSettings& settings, pose_wall_planar_fault* fault);

// From the stamp to the first effect of the brakes.
inline double reaction_s(const StopSettings& s) {
  return s.scan_s + s.stale_s + s.delay_s + s.latency_s;
}

}  // namespace pose_wall::planar

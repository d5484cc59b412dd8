// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the sensor is by the pattern of its returns.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "doctor/recording.hpp"

namespace pose_wall::tools::doctor {

struct SensorSeen {
  std::string model = "unknown";  // else a name of sim/sensors.hpp: vlp16, mid360, os1-64, os0-128
  std::string title = "unknown";  // "VLP-16 class"
  double returns = 0.0;           // median per frame
  std::size_t rings = 0;          // 0: no rings, a non-repetitive pattern
  double elevation_min_deg = 0.0, elevation_max_deg = 0.0;
  double azimuth_share = 0.0;                                          // of the circle from which anything came
  double range_median_m = 0.0, range_near_m = 0.0, range_far_m = 0.0;  // 1 %, 99 %
};

SensorSeen look_at_sensor(const Recording& recording);

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// sensor_msgs/LaserScan in and out.

#pragma once

#include <cstdint>

#include "pose_wall_planar_scan.h"

namespace pose_wall::planar {

// Of a checked scan.
pose_wall_planar_laserscan laserscan_of(const pose_wall_planar_scan& scan);

// Not yet checked as a scan. The message has ranges, if it counts any.
pose_wall_planar_scan scan_of(const pose_wall_planar_laserscan& message);

// Infinity becomes unknown.
void copy_without_infinity(const float* from, std::uint32_t count, float* to);

}  // namespace pose_wall::planar

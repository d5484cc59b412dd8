// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One frame on its way from a source to the runtime and to the sinks.

#pragma once

#include <cstdint>
#include <string>

#include "io/frames/frame.hpp"

namespace pose_wall::tools::live {

struct LiveFrame {
  Frame frame;                // frame.cloud.stamp_ns is what the engine reads
  std::int64_t stamp_ns = 0;  // of the cloud's header, which results copy
  std::string frame_id;       // of the cloud's header; empty where the source has none: lidar_frame of the config
};

// Where the sensor stands in base, as tf tells it.
struct Extrinsic {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;  // base = Rz(yaw) Ry(pitch) Rx(roll) lidar + position
};

}  // namespace pose_wall::tools::live

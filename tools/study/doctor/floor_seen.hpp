// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The floor as the engine finds it under a mounting that is being tried, and the mounting that levels it.

#pragma once

#include <Eigen/Core>

#include "pose_wall.hpp"
#include "study/doctor/recording.hpp"

namespace pose_wall::tools::doctor {

struct FloorSeen {
  double measured = 0.0;  // share of the frames
  double valid = 0.0;
  Eigen::Vector3d up_lidar{0.0, 0.0, 0.0};  // normal of the floor
  double height_m = 0.0;                    // of the sensor above it
  double height_spread_m = 0.0;             // nine in ten frames lie within this
  double tilt_spread_rad = 0.0;
  double tilt_sigma_rad = 0.0;                      // of one frame, as the engine tells
  double tilt_level_rad = 0.0;                      // median protection level
  double points = 0.0, area_m2 = 0.0, rms_m = 0.0;  // medians
  bool is_found() const { return measured >= 0.5; }
};

// What the engine makes of the floor with this config; `frames_max` of the frames.
FloorSeen look_at_floor(const api::Config& config, const std::vector<KeptFrame>& frames, std::size_t frames_max);

// Sets extrinsic_roll and extrinsic_pitch so that `up_lidar` points along +Z of base; the other keys stay.
void level_mount(api::Config& config, const Eigen::Vector3d& up_lidar);

// Turned by half a circle about the sensor's own X axis.
void flip_mount(api::Config& config);

// Between the sensor's present up axis and the floor's.
double tilt_rad(const api::Config& config, const Eigen::Vector3d& up_lidar);

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Finds a scan of unknown place: the level by its own normals, and a coarse search over yaw and place.

#pragma once

#include "motion/registration.hpp"
#include "motion/start_counts.hpp"

namespace pose_wall::motion {

// The turn of the map that takes the ground's normals of the observations upright; identity where there is no ground.
Eigen::Matrix3d upright(Span<const Observation> observations, const Eigen::Matrix3d& R_map_base,
                        const Eigen::Vector3d& sensor_base_m);

// The turn about the map's z that takes most walls square to its axes.
double squaring_yaw_rad(Span<const Observation> observations, const Eigen::Matrix3d& R_map_base);

struct WideReach {
  double yaw_rad, place_m;
};
// The place that most observations agree with, within reach of the alignment's pose; false where few do. Faces the
// observations anew.
bool search_wide(const ReliefMap& map, Span<Observation> observations, const WideReach& reach, StartScratch* scratch,
                 Work* work, Pose* pose);

// Which share of the observations on walls lies on the map's surfaces, weighed by how near.
double share_on_map(const ReliefMap& map, Span<const Observation> observations, const Pose& pose, std::uint32_t stride);

}  // namespace pose_wall::motion

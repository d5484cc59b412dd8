// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Floor and walls stand still, so the change of each quantity follows from two places of the machine.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/config.hpp"
#include "engine/types.hpp"

namespace pose_wall {

// Of base, in a frame that stands still.
struct Place {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // turns base into that frame
};

// Where a quantity's distance is measured from, in base.
Eigen::Vector3d sample_base(std::uint32_t quantity, const Settings& settings, const Axes& axes);

// up: the floor's normal; wall_normal: that of the quantity's wall, towards the machine. Both are in the places' frame.
double change_between(std::uint32_t quantity, const Place& from, const Place& to, const Eigen::Vector3d& up,
                      const Eigen::Vector3d& wall_normal, const Settings& settings, const Axes& axes);

}  // namespace pose_wall

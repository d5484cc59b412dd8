// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What an odometry (pose_wall_odometry) says of the seven quantities: machine and surfaces in the odometry's own frame.
// Floor and walls stand still there, so the change of a quantity follows from two places of the machine.

#pragma once

#include <Eigen/Core>

#include "config.hpp"
#include "floor/levelling.hpp"
#include "floor/result.hpp"
#include "output/measurements.hpp"
#include "output/temporal_motion.hpp"
#include "pose_wall.h"
#include "types.hpp"
#include "walls/wall.hpp"

namespace pose_wall {

// A surface as it was measured last, in the run's frame. What is known of it ends where it was no longer seen.
struct SeenSurface {
  bool exists = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of the floor: up. Of a wall: towards the machine
  // A wall's direction towards the machine's front, and the stretch along it that was seen.
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  double from_m = 0.0, to_m = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  // of a floor, and how far it was seen
  double radius_m = 0.0;
  double slope_level = 0.0;  // how well its direction is known: rad, that is metres a metre
};

// The machine's last place, and what it saw until then.
struct OdometryMemory {
  static constexpr std::uint64_t kNoRun = 0;  // the interface counts runs from 1

  std::uint64_t run = kNoRun;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_run_base = Eigen::Matrix3d::Identity();
  double place_level[POSE_WALL_QUANTITIES] = {};
  double drift_variance[POSE_WALL_ODOMETRY_DIRECTIONS] = {};
  double drift[POSE_WALL_ODOMETRY_DIRECTIONS] = {};
  SeenSurface floor, wall[2];
};

// Whether all its numbers are within their ranges.
bool is_sound(const pose_wall_odometry& odometry);

// What changed since the place in memory, which is one of the same run. Where a surface was not seen there, *change
// stays as it is. False where drift fell: then it is of another run, whatever its number says.
bool change_by_odometry(const pose_wall_odometry& odometry, const OdometryMemory& memory, const Settings& settings,
                        const Axes& axes, Change* change);

// What is not known of the motion in the course of a scan that the motion was taken out of, in levels of what it
// measured: as if a whole surface had been seen at the scan's end. The memory has this frame's surfaces.
void widen_by_skew(const pose_wall_odometry& odometry, double scan_s, const OdometryMemory& memory,
                   const Settings& settings, const Axes& axes, Measurements* measured);

// The place and the surfaces that this frame measured well become memory; a new run forgets those of the one before.
void remember_place(const pose_wall_odometry& odometry, const FloorResult& floor, const Levelling& levelling,
                    const JudgedWall (&walls)[2], const Measurements& measured, const Settings& settings,
                    const Axes& axes, OdometryMemory* memory);

}  // namespace pose_wall

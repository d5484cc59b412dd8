// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The change of the seven quantities by an odometry (pose_wall_odometry), with machine and surfaces in the odometry's
// own frame. Floor and walls stand still there, so the change of a quantity follows from two places of the machine.

#pragma once

#include <Eigen/Core>

#include "engine/config.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/floor/result.hpp"
#include "engine/output/measurements.hpp"
#include "engine/output/temporal_motion.hpp"
#include "engine/types.hpp"
#include "engine/walls/wall.hpp"
#include "pose_wall.h"

namespace pose_wall {

// A surface as last measured, in the run's frame. Knowledge of it ends where it was no longer seen.
struct SeenSurface {
  bool exists = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of the floor: up; of a wall: towards the machine
  // A wall's direction towards the machine's front, and the stretch of it that was seen.
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  double from_m = 0.0, to_m = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  // of a floor, with the radius within which it was seen
  double radius_m = 0.0;
  double slope_level = 0.0;  // level of its direction: rad, or metres a metre
  double rock_m = 1.0;       // after such a way a third of the rock behind a value is still that of then
  // By which other rock moves the values: of a floor roll and pitch, of a wall distance and yaw. Standard deviations.
  double waves[2] = {0.0, 0.0};
};

// The machine's last place, and the surfaces seen until then.
struct OdometryMemory {
  static constexpr std::uint64_t kNoRun = 0;  // the interface counts runs from 1

  std::uint64_t run = kNoRun;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_run_base = Eigen::Matrix3d::Identity();
  double place_level[POSE_WALL_QUANTITIES] = {};
  double drift_variance[POSE_WALL_ODOMETRY_DIRECTIONS] = {};
  double drift[POSE_WALL_ODOMETRY_DIRECTIONS] = {};
  SeenSurface floor, wall[2];
  // Of the floor, which levels the walls, even where another reading of it forbids to remember it.
  bool has_up = false;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

// True if all its numbers are within their ranges.
bool is_sound(const pose_wall_odometry& odometry);

// The change since the place in memory, which is of the same run. If a surface was not seen there, *change stays. False
// if drift fell: then it is another run, whatever its number.
bool change_by_odometry(const pose_wall_odometry& odometry, const OdometryMemory& memory, const Settings& settings,
                        const Axes& axes, Change* change);

// Keeps the place and the surfaces that this frame measured well. A new run drops those of the one before.
void remember_place(const pose_wall_odometry& odometry, const FloorResult& floor, const Levelling& levelling,
                    const JudgedWall (&walls)[2], const Measurements& measured, const Settings& settings,
                    const Axes& axes, OdometryMemory* memory);

}  // namespace pose_wall

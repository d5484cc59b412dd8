// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The machine of `pose_wall drive`: a roadheader of 4.5 x 1.2 m on two tracks. It turns about a point a little ahead of
// its middle. There is base, and above it a LiDAR on a mast. All settings of the library's parts for it stand here.

#pragma once

#include <string>
#include <vector>

#include "lab/sim/drive_tracks.hpp"
#include "lab/sim/network_scan.hpp"
#include "lab/sim/sensors.hpp"
#include "pose_wall.hpp"
#include "pose_wall_planar_plan.h"
#include "pose_wall_planar_scan.h"
#include "pose_wall_planar_stop.h"
#include "pose_wall_planar_track.h"
#include "study/planar/map_picture.hpp"

namespace pose_wall::tools {

inline constexpr double kTurnAhead_m = 0.15;  // from the middle to base; sim::TrackSettings::turn_ahead_m
inline constexpr double kFront_m = 2.1, kRear_m = 2.4, kHalfWidth_m = 0.6;  // from base
inline constexpr double kBaseHeight_m = 1.0, kMastHeight_m = 2.2;           // of base and sensor above the floor
inline constexpr double kMargin_m = 0.7;   // that routes keep from rock, where they can
inline constexpr double kFrame_s = 0.1;    // from cloud to cloud
inline constexpr double kResult_s = 0.05;  // from a cloud's stamp to the command that follows from it

// Of base: ahead, and to the left.
struct Motion {
  double speed_m_s = 0.0, turn_rad_s = 0.0;
};

// Names that a user may choose.
std::vector<std::string> drive_sensors();

// Throws std::invalid_argument for a name that is none of them.
const sim::SensorModel& drive_sensor(const std::string& name);

api::Config drive_config(const sim::SensorModel& model);
pose_wall_planar_scanner_settings drive_scanner_settings();
pose_wall_planar_stop_settings drive_stop_settings();
pose_wall_planar_track_settings drive_track_settings(double speed_max_m_s);
// For a grid of this many cells.
pose_wall_planar_plan_settings drive_plan_settings(const pose_wall_planar_grid& grid, double margin_m);
sim::TrackSettings drive_tracks();

// Free room beside the footprint without which the stop lets it come no nearer to a thing: at least, for a thing in
// sight, and at most, for one that it remembers from far back.
double stop_needs_least_m();
double stop_needs_most_m();

// The speeds of the tracks for a motion, by what is known of them on average.
sim::TrackSpeeds track_speeds(const Motion& motion);
// Of the footprint's fastest corner.
double rim_speed_m_s(const Motion& motion);

// Where base and sensor truly are, as the tracks stand on the floor.
pose_wall_planar_pose true_base(const sim::TrackDrive& drive);
sim::StandingPose true_sensor(const sim::TrackDrive& drive, const sim::SensorModel& model);

}  // namespace pose_wall::tools

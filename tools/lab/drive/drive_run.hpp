// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The closed loop: the machine is restarted at an unknown place of roads that it was taught, finds its place, plans and
// drives to the goal. People step into its way, walls are lost. All parts of pose_wall_planar work together here.

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/drive/drive_scanner.hpp"
#include "lab/drive/guard.hpp"
#include "lab/drive/pilot.hpp"
#include "lab/drive/taught_roads.hpp"
#include "lab/sim/network_people.hpp"
#include "study/planar/map_localiser.hpp"

namespace pose_wall::tools {

struct DriveRunSettings {
  std::uint64_t seed = 1;
  int people = 3;
  bool people_stay = false;
  bool loses_walls = true;
  std::optional<pose_wall_planar_pose> goal;   // in map; none: where the map began, facing either way
  std::optional<pose_wall_planar_pose> start;  // of base, truly; none: drawn
  double time_most_s = 1800.0;
  double patience_s = 60.0;  // before a stop
};

// What was true, believed and done at a frame.
struct DriveFrame {
  double time_s = 0.0;
  PilotPhase phase = PilotPhase::kLocating;
  pose_wall_planar_pose truth{}, believed{};  // of base in map; NaN: not believed
  std::uint32_t place_state = 0;              // pose_wall_planar_localise_state
  double place_sigma_m = 0.0;
  std::uint32_t stop_state = 0, stop_reasons = 0;
  double allowed_m_s = 0.0;
  double limit_x_m = 0.0, limit_y_m = 0.0;  // in base, of what limits the speed most; NaN: nothing
  double nearest_m = 0.0;                   // truly, from the footprint to the nearest person; infinity: nobody
  Motion wished, command;
  double off_route_m = 0.0;  // of the truth; NaN: no route
  bool is_contact = false;
  std::string loss;  // at work; empty: none
};

struct DriveEnd {
  bool has_arrived = false;
  std::string reason;  // of an end short of the goal
  double driven_m = 0.0, time_s = 0.0;
  std::uint32_t contacts = 0;                      // with people and rock; each counts once
  std::uint32_t wrong_places = 0;                  // frames that were unique and more than half a metre off
  double error_mean_m = 0.0, error_worst_m = 0.0;  // of unique places
  double off_route_worst_m = 0.0;
  double unique_after_s = 0.0, crept_m = 0.0;  // until it planned; 0: never
  std::string loss;                            // what was lost; empty: nothing
  double loss_s = 0.0;
  std::size_t plans = 0, floors = 0, own_planes = 0;
};

class DriveRun {
 public:
  // All must outlive it.
  DriveRun(const sim::Network& network, const sim::SensorModel& model, const TaughtRoads& roads,
           const DriveRunSettings& settings);

  // notice gets each frame; false ends the drive.
  DriveEnd run(const std::function<bool(const DriveFrame&)>& notice);

  const std::vector<DriveFrame>& frames() const { return frames_; }
  const std::vector<sim::Person>& people() const { return people_; }
  // Of each, in map.
  const std::vector<std::vector<MapPlace>>& people_ways() const { return people_ways_; }
  const PlannedRoute& first_route() const { return first_route_; }
  const pose_wall_planar_pose& goal() const { return goal_; }

 private:
  sim::CloudScene scene();
  Motion measured_motion();
  DriveFrame take_frame();
  void report(DriveFrame* row);
  void move(const Motion& before, const Motion& after);
  void begin_trouble();
  void judge(const DriveFrame& row, DriveEnd* end);
  sim::Footprint footprint() const;
  bool touches() const;

  const sim::Network& network_;
  const sim::SensorModel& model_;
  const TaughtRoads& roads_;
  DriveRunSettings settings_;
  pose_wall_planar_pose goal_;
  sim::TrackDrive machine_;
  DriveScanner scanner_;
  MapLocaliser finder_;
  DriveGuard guard_;
  DrivePilot pilot_;
  std::vector<sim::Person> people_;
  std::vector<std::vector<MapPlace>> people_ways_;
  std::optional<sim::Loss> loss_;
  PlannedRoute first_route_;
  std::vector<DriveFrame> frames_;
  Motion command_;
  pose_wall_planar_pose odometry_before_{};
  double followed_from_m_ = 0.0, loss_began_s_ = -1.0;
  std::size_t unique_frames_ = 0;
  bool was_touching_ = false;
  std::uint32_t contacts_ = 0;
};

}  // namespace pose_wall::tools

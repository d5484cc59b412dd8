// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Drive commands that keep the machine on a route.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "planar/route/drive_model.hpp"
#include "planar/route/track_path.hpp"
#include "pose_wall_planar_track.h"

namespace pose_wall::planar::route {

class Tracker {
 public:
  void lay_out(Arena& arena, const pose_wall_planar_track_settings& settings);
  void open(const pose_wall_planar_track_settings& settings);

  std::uint32_t path_max() const { return room_.size(); }
  // The poses have been checked.
  void take_route(const pose_wall_planar_path_pose* poses, std::uint32_t count, pose_wall_planar_clearance clearance,
                  void* context);
  void step(const pose_wall_planar_track_input& input, pose_wall_planar_track_command* command);
  // In place of the last command.
  void obeyed(const Rates& rates) {
    now_ = rates;
    model_.command(rates);
  }

 private:
  enum class Phase : std::uint32_t { idle, leg, stopping, done, off_path };

  double step_seconds(std::int64_t now_ns);
  bool is_good(const pose_wall_planar_track_input& input, double age_s) const;
  void report(const OnPath& at, pose_wall_planar_track_command* command) const;
  void drive(const Pose2& given, double age_s, double step_s, pose_wall_planar_track_command* command);
  void follow(const Pose2& ahead, double step_s, pose_wall_planar_track_command* command);
  void turn(const Pose2& ahead, double step_s, pose_wall_planar_track_command* command);
  double allowed_speed(const OnPath& at, const Pose2& ahead, double left_m, std::uint32_t* slowed_by) const;
  double steering(const OnPath& at) const;
  void halt() { now_ = Rates(); }
  void next_leg();

  pose_wall_planar_track_settings settings_{};
  Span<pose_wall_planar_path_pose> room_;
  TrackPath path_;
  DriveModel model_;
  Leg leg_;
  Phase phase_ = Phase::idle;
  std::uint32_t index_ = 0, index_ahead_ = 0;
  Rates now_;  // commanded
  std::int64_t last_ns_ = 0, last_pose_ns_ = 0;
  bool has_time_ = false, seen_to_move_ = false;
  pose_wall_planar_clearance clearance_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace pose_wall::planar::route

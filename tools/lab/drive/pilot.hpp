// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// From where the machine believes to be to what it wishes to do next: it looks for its place, plans, follows. Where the
// stop holds it, it goes back some metres, if another way leads to the goal from there; else it waits.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lab/drive/machine.hpp"
#include "lab/drive/road_feeler.hpp"
#include "lab/drive/way_finder.hpp"
#include "pose_wall_planar_localise.h"
#include "pose_wall_planar_stop.h"

namespace pose_wall::tools {

enum class PilotPhase { kLocating, kFollowing, kArrived, kGivenUp };
// "locating"; no language.
const char* pilot_phase_name(PilotPhase phase);
// As a person reads it: "looks for its place".
std::string pilot_phase_text(PilotPhase phase);

class DrivePilot {
 public:
  // Any of the goals will do. The map must outlive it. It gives up once the stop has held it for patience_s. Throws
  // PlanarError.
  DrivePilot(const MapFile& map, std::vector<pose_wall_planar_pose> goals, double speed_max_m_s, double patience_s);

  struct View {
    std::int64_t stamp_ns = 0, now_ns = 0;
    const pose_wall_planar_scan* scan = nullptr;
    const pose_wall_planar_localise_result* where = nullptr;
    Motion measured;
  };
  Motion wish(const View& view);
  // What the stop made of the wish, and why.
  void obeyed(const Motion& command, const pose_wall_planar_stop_result& stop);

  PilotPhase phase() const { return phase_; }
  // Of giving up, a sentence.
  const std::string& reason() const { return reason_; }
  const PlannedRoute& route() const { return route_; }
  std::size_t plans() const { return plans_; }
  const pose_wall_planar_track_command& track() const { return command_; }

 private:
  void plan_from(const pose_wall_planar_pose& base);
  bool leave_from(const pose_wall_planar_pose& base);
  void take(PlannedRoute route);
  void look_for_another_way(const pose_wall_planar_pose& base);
  void remember(const pose_wall_planar_pose& base);
  Motion follow(const View& view);
  Motion creep(const View& view);
  bool is_held() const;  // by the stop, and has not looked for another way lately
  void give_up(std::string reason);
  std::string held_text() const;

  std::vector<pose_wall_planar_pose> goals_;
  double patience_s_;
  WayFinder finder_;
  PartBlock track_block_;
  pose_wall_planar_tracker* tracker_ = nullptr;
  pose_wall_planar_track_command command_{};
  PlannedRoute route_;
  RoadFeeler feeler_;
  PilotPhase phase_ = PilotPhase::kLocating;
  std::string reason_;
  std::size_t plans_ = 0;
  bool wants_to_move_ = false;
  bool leads_out_ = false;  // the route: another begins at its end
  std::int64_t now_ns_ = 0, moved_ns_ = -1, sought_ns_ = -1, looked_ns_ = -1;
  double crept_m_ = 0.0, moved_m_ = 0.0;
  pose_wall_planar_pose base_{};                // where it last knew to be
  pose_wall_planar_stop_result stop_{};         // after it
  std::vector<pose_wall_planar_pose> trail_{};  // of the way to here, and back again
  int unique_looks_ = 0;
};

}  // namespace pose_wall::tools

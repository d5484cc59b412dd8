// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "drive/pilot.hpp"

#include <cmath>
#include <utility>

#include "drive/guard.hpp"
#include "language/language.hpp"
#include "planar/map_localiser.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kStands_s = 3.0;      // while it looks for its place, before it creeps
constexpr int kUniqueLooks = 5;        // in a row, before it believes its place
constexpr double kCreepMost_m = 60.0;  // in search of its place
constexpr double kNoPose_s = 5.0;      // without a good pose, before it creeps
constexpr double kLevel = 2.0;         // standard deviations that a pose may be off
constexpr double kStill = 1e-3;        // m/s and rad/s
constexpr std::size_t kPlansMost = 20;
// Round the machine. With the last the stop hardly lets it pass rock.
constexpr double kMargins_m[] = {kMargin_m, 0.5, 0.35, 0.2, 0.1};

double seconds_since(std::int64_t then_ns, std::int64_t now_ns) {
  return 1e-9 * static_cast<double>(now_ns - then_ns);
}

bool is_moving(const Motion& motion) {
  return std::abs(motion.speed_m_s) + std::abs(motion.turn_rad_s) > kStill;
}

bool has_place(const pose_wall_planar_localise_result& where) {
  return where.state == POSE_WALL_PLANAR_LOCALISE_UNIQUE || where.state == POSE_WALL_PLANAR_LOCALISE_DOUBTFUL;
}

double clearance_of(void* planner, double x_m, double y_m) {
  return static_cast<const RoutePlanner*>(planner)->clearance_m(x_m, y_m);
}

}  // namespace

const char* pilot_phase_name(PilotPhase phase) {
  static constexpr const char* kNames[] = {"locating", "following", "arrived", "given_up"};
  return kNames[static_cast<int>(phase)];
}

DrivePilot::DrivePilot(const MapFile& map, const pose_wall_planar_pose& goal, double speed_max_m_s, double patience_s)
    : map_(map), goal_(goal), patience_s_(patience_s), track_block_([speed_max_m_s] {
        const pose_wall_planar_track_settings settings = drive_track_settings(speed_max_m_s);
        return pose_wall_planar_track_memory_needed(&settings);
      }()) {
  const pose_wall_planar_track_settings settings = drive_track_settings(speed_max_m_s);
  require_ok(pose_wall_planar_track_open(&settings, track_block_.data(), track_block_.bytes(), &tracker_),
             translatable("the settings of the drive"));
  for (const double margin_m : kMargins_m) planners_.emplace_back(drive_plan_settings(map.grid(), margin_m));
  command_.struct_size = sizeof command_;
}

void DrivePilot::give_up(std::string reason) {
  phase_ = PilotPhase::kGivenUp;
  reason_ = std::move(reason);
}

void DrivePilot::plan_from(const pose_wall_planar_pose& base) {
  if (++plans_ > kPlansMost) return give_up(say("after {} routes it is not there", kPlansMost));
  for (RoutePlanner& planner : planners_) {
    planner_ = &planner;
    route_ = planner.plan(map_.grid(), base, goal_);
    if (route_.is_found()) break;
  }
  if (!route_.is_found()) return give_up(say("there is no route. {}", no_route_text(route_.result)));
  require_ok(pose_wall_planar_track_route(tracker_, route_.poses.data(),
                                          static_cast<std::uint32_t>(route_.poses.size()), clearance_of, planner_),
             translatable("the route"));
  phase_ = PilotPhase::kFollowing;
}

Motion DrivePilot::creep(const Look& look) {
  if (crept_m_ > kCreepMost_m) {
    give_up(say("after {:.0f} m of creeping its place is still {}", kCreepMost_m,
                pose_wall_planar_localise_state_name(look.where->state)));
    return {};
  }
  return feeler_.creep(*look.scan);
}

Motion DrivePilot::follow(const Look& look) {
  pose_wall_planar_track_input input{};
  input.struct_size = sizeof input;
  input.now_ns = look.now_ns;
  input.pose_ns = look.where->stamp_ns;
  input.has_pose = has_place(*look.where) ? 1 : 0;
  input.pose = look.where->pose;
  input.pose_level_m = kLevel * position_sigma_m(*look.where);
  input.speed_m_s = look.measured.speed_m_s;
  require_ok(pose_wall_planar_track_step(tracker_, &input, &command_), translatable("the route"));
  if (command_.state == POSE_WALL_TRACK_DONE) phase_ = PilotPhase::kArrived;
  if (command_.state == POSE_WALL_TRACK_OFF_PATH) plan_from(look.where->pose);
  if (command_.state != POSE_WALL_TRACK_NO_POSE) {
    sought_ns_ = look.now_ns;
  } else if (seconds_since(sought_ns_, look.now_ns) > kNoPose_s) {
    phase_ = PilotPhase::kLocating;
  }
  return {command_.speed_m_s, command_.turn_rad_s};
}

Motion DrivePilot::wish(const Look& look) {
  now_ns_ = look.now_ns;
  if (moved_ns_ < 0) moved_ns_ = sought_ns_ = now_ns_;
  const pose_wall_planar_localise_result& where = *look.where;
  const bool is_unique = where.state == POSE_WALL_PLANAR_LOCALISE_UNIQUE;
  unique_looks_ = is_unique && look.scan != nullptr ? unique_looks_ + 1 : is_unique ? unique_looks_ : 0;
  Motion wish;
  if (phase_ == PilotPhase::kLocating) {
    if (unique_looks_ >= kUniqueLooks) {
      sought_ns_ = now_ns_;
      plan_from(where.pose);
    } else if (unique_looks_ == 0 && look.scan != nullptr && seconds_since(sought_ns_, now_ns_) > kStands_s) {
      wish = creep(look);
    }
  }
  if (phase_ == PilotPhase::kFollowing) wish = follow(look);
  wants_to_move_ = is_moving(wish);
  return wish;
}

void DrivePilot::obeyed(const Motion& command, std::uint32_t stop_reasons) {
  if (phase_ == PilotPhase::kFollowing) {
    require_ok(pose_wall_planar_track_obeyed(tracker_, command.speed_m_s, command.turn_rad_s),
               translatable("the route"));
  }
  if (phase_ == PilotPhase::kLocating) crept_m_ += kFrame_s * std::abs(command.speed_m_s);
  if (!wants_to_move_ || is_moving(command)) moved_ns_ = now_ns_;
  const bool is_under_way = phase_ == PilotPhase::kFollowing || phase_ == PilotPhase::kLocating;
  if (is_under_way && seconds_since(moved_ns_, now_ns_) > patience_s_) {
    give_up(say("the stop held it for {:.0f} s: {}", patience_s_, stop_reasons_text(stop_reasons)));
  }
}

}  // namespace pose_wall::tools

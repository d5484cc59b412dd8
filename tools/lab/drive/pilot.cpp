// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "io/language/language.hpp"
#include "study/planar/map_localiser.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/stop_reasons.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kStands_s = 3.0;      // while it looks for its place, before it creeps
constexpr int kUniqueLooks = 5;        // in a row, before it believes its place
constexpr double kCreepMost_m = 60.0;  // in search of its place
constexpr double kNoPose_s = 5.0;      // without a good pose, before it creeps
constexpr double kLevel = 2.0;         // standard deviations that a pose may be off
constexpr double kStill = 1e-3;        // m/s and rad/s
constexpr std::size_t kPlansMost = 20;
// Held for so long it looks for another way. A person who pauses before it and walks past it takes 10 s.
constexpr double kHeld_s = 15.0;
constexpr double kProgress_m = 0.3;       // of the rim: who moved less did not get on
constexpr double kTrail_m = 0.5;          // between poses of the way to here; a radian of a turn is so many metres
constexpr double kLeaveMost_m = 6.0;      // of way so near to rock: more than the machine's length
constexpr double kBack_m[] = {2.0, 5.0};  // that it may go back, to where it turns off

double seconds_since(std::int64_t then_ns, std::int64_t now_ns) {
  return 1e-9 * static_cast<double>(now_ns - then_ns);
}

bool is_moving(const Motion& motion) {
  return std::abs(motion.speed_m_s) + std::abs(motion.turn_rad_s) > kStill;
}

bool has_place(const pose_wall_planar_localise_result& where) {
  return where.state == POSE_WALL_PLANAR_LOCALISE_UNIQUE || where.state == POSE_WALL_PLANAR_LOCALISE_DOUBTFUL;
}

// Along the way; turns count as well.
double apart_m(const pose_wall_planar_pose& a, const pose_wall_planar_pose& b) {
  return distance_m(a, b) + std::abs(std::remainder(a.yaw_rad - b.yaw_rad, 2.0 * M_PI));
}

double clearance_of(void* planner, double x_m, double y_m) {
  return static_cast<const RoutePlanner*>(planner)->clearance_m(x_m, y_m);
}

struct PhaseWords {
  const char *name, *text;
};
constexpr PhaseWords kPhases[] = {{"locating", translatable("looks for its place")},
                                  {"following", translatable("follows its route")},
                                  {"arrived", translatable("arrived")},
                                  {"given_up", translatable("given up")}};
static_assert(std::size(kPhases) == static_cast<std::size_t>(PilotPhase::kGivenUp) + 1);

}  // namespace

const char* pilot_phase_name(PilotPhase phase) {
  return kPhases[static_cast<int>(phase)].name;
}

std::string pilot_phase_text(PilotPhase phase) {
  return tr(kPhases[static_cast<int>(phase)].text);
}

DrivePilot::DrivePilot(const MapFile& map, std::vector<pose_wall_planar_pose> goals, double speed_max_m_s,
                       double patience_s)
    : goals_(std::move(goals)), patience_s_(patience_s), finder_(map), track_block_([speed_max_m_s] {
        const pose_wall_planar_track_settings settings = drive_track_settings(speed_max_m_s);
        std::uint64_t bytes = 0;
        require_ok(pose_wall_planar_track_memory_needed(&settings, &bytes), translatable("the settings of the drive"));
        return bytes;
      }()) {
  const pose_wall_planar_track_settings settings = drive_track_settings(speed_max_m_s);
  require_ok(pose_wall_planar_track_open(&settings, track_block_.data(), track_block_.bytes(), &tracker_),
             translatable("the settings of the drive"));
  command_.struct_size = sizeof command_;
}

void DrivePilot::give_up(std::string reason) {
  phase_ = PilotPhase::kGivenUp;
  reason_ = std::move(reason);
}

void DrivePilot::take(PlannedRoute route) {
  route_ = std::move(route);
  require_ok(
      pose_wall_planar_track_route(tracker_, route_.poses.data(), static_cast<std::uint32_t>(route_.poses.size()),
                                   clearance_of, finder_.planner()),
      translatable("the route"));
  phase_ = PilotPhase::kFollowing;
  ++plans_;
}

void DrivePilot::plan_from(const pose_wall_planar_pose& base) {
  if (plans_ >= kPlansMost) return give_up(say("after {} routes it is not there", kPlansMost));
  leads_out_ = false;
  PlannedRoute route = finder_.to_goal(base, goals_);
  if (route.result.outcome == POSE_WALL_PLANAR_PLAN_START_BLOCKED && leave_from(base)) return;
  if (route.result.outcome == POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED) {
    return give_up(say("there is no route. {} Another --goal may have room.", no_route_text(route.result)));
  }
  if (!route.is_found()) return give_up(say("there is no route. {}", no_route_text(route.result)));
  take(std::move(route));
}

// From where it stands too near to rock, to the first place on the way to the goal that has room.
bool DrivePilot::leave_from(const pose_wall_planar_pose& base) {
  const PlannedRoute near = finder_.out(base, goals_.front());
  double tried_m = 0.0;
  for (const pose_wall_planar_path_pose& at : near.poses) {
    if (at.along_m < tried_m + kTrail_m) continue;
    tried_m = at.along_m;
    if (tried_m > kLeaveMost_m) return false;
    if (!finder_.to_goal(at.pose, goals_).is_found()) continue;
    leads_out_ = true;
    take(finder_.out(base, at.pose));
    return true;
  }
  return false;
}

// Back along the way it came, to the first place from which the goal can be reached round what holds it.
void DrivePilot::look_for_another_way(const pose_wall_planar_pose& base) {
  looked_ns_ = now_ns_;
  if (!std::isfinite(stop_.nearest_m[0])) return;  // the sensor sees nothing
  const pose_wall_planar_pose at = combined(base_, {stop_.nearest_m[0], stop_.nearest_m[1], 0.0});
  const bool stands = (stop_.reasons & (POSE_WALL_PLANAR_STOP_R_BLIND | POSE_WALL_PLANAR_STOP_R_NEARING)) == 0;
  finder_.hold({{at.x_m, at.y_m}, stop_.nearest_distance_m, !stands});
  if (plans_ >= kPlansMost) return;
  std::size_t there = trail_.size();
  double back_m = 0.0;
  pose_wall_planar_pose last = base;
  for (const double wanted_m : kBack_m) {
    while (there > 0 && back_m < wanted_m) {
      back_m += apart_m(trail_[--there], last);
      last = trail_[there];
    }
    if (back_m < wanted_m) return;
    if (!finder_.to_goal(last, goals_).is_found()) continue;
    PlannedRoute route = finder_.out(base, last);
    if (!route.is_found()) continue;
    trail_.resize(there);
    leads_out_ = true;
    return take(std::move(route));
  }
}

bool DrivePilot::is_held() const {
  return seconds_since(std::max(moved_ns_, looked_ns_), now_ns_) > kHeld_s;
}

void DrivePilot::remember(const pose_wall_planar_pose& base) {
  if (!leads_out_ && (trail_.empty() || apart_m(trail_.back(), base) > kTrail_m)) trail_.push_back(base);
}

Motion DrivePilot::creep(const View& view) {
  if (crept_m_ > kCreepMost_m) {
    give_up(say("after {:.0f} m of creeping its place is still {}", kCreepMost_m,
                tr(pose_wall_planar_localise_state_name(view.where->state))));
    return {};
  }
  if (is_held()) {
    looked_ns_ = view.now_ns;
    feeler_.turn_back();
  }
  return feeler_.creep(*view.scan);
}

Motion DrivePilot::follow(const View& view) {
  pose_wall_planar_track_input input{};
  input.struct_size = sizeof input;
  input.now_ns = view.now_ns;
  input.pose_ns = view.where->stamp_ns;
  input.has_pose = has_place(*view.where) ? 1 : 0;
  input.pose = view.where->pose;
  input.pose_level_m = kLevel * position_sigma_m(*view.where);
  input.speed_m_s = view.measured.speed_m_s;
  require_ok(pose_wall_planar_track_step(tracker_, &input, &command_), translatable("the route"));
  const bool is_back = command_.state == POSE_WALL_PLANAR_TRACK_DONE && leads_out_;
  if (command_.state == POSE_WALL_PLANAR_TRACK_DONE && !leads_out_) phase_ = PilotPhase::kArrived;
  if (is_back || command_.state == POSE_WALL_PLANAR_TRACK_OFF_PATH) plan_from(view.where->pose);
  if (command_.state != POSE_WALL_PLANAR_TRACK_NO_POSE) {
    sought_ns_ = view.now_ns;
    remember(view.where->pose);
    if (phase_ == PilotPhase::kFollowing && is_held()) look_for_another_way(view.where->pose);
  } else if (seconds_since(sought_ns_, view.now_ns) > kNoPose_s) {
    phase_ = PilotPhase::kLocating;
  }
  return {command_.speed_m_s, command_.turn_rad_s};
}

Motion DrivePilot::wish(const View& view) {
  now_ns_ = view.now_ns;
  if (moved_ns_ < 0) moved_ns_ = sought_ns_ = looked_ns_ = now_ns_;
  if (has_place(*view.where)) base_ = view.where->pose;
  const pose_wall_planar_localise_result& where = *view.where;
  const bool is_unique = where.state == POSE_WALL_PLANAR_LOCALISE_UNIQUE;
  unique_looks_ = is_unique ? unique_looks_ + 1 : 0;
  Motion wish;
  if (phase_ == PilotPhase::kLocating) {
    if (unique_looks_ >= kUniqueLooks) {
      sought_ns_ = now_ns_;
      plan_from(where.pose);
    } else if (unique_looks_ == 0 && seconds_since(sought_ns_, now_ns_) > kStands_s) {
      wish = creep(view);
    }
  }
  if (phase_ == PilotPhase::kFollowing) wish = follow(view);
  wants_to_move_ = is_moving(wish);
  return wish;
}

// Of the reasons, that it is faster than it may be is none while it stands.
std::string DrivePilot::held_text() const {
  const std::uint32_t reasons = stop_.reasons & ~std::uint32_t{POSE_WALL_PLANAR_STOP_R_SPEED};
  const std::string text = say("the stop held it for {:.0f} s: {}", patience_s_, stop_reasons_text(reasons));
  if (phase_ != PilotPhase::kFollowing || !std::isfinite(stop_.nearest_m[0])) return text;
  const pose_wall_planar_pose at = combined(base_, {stop_.nearest_m[0], stop_.nearest_m[1], 0.0});
  return say("{}, at x {:.1f} m, y {:.1f} m of the map. No other way was found", text, at.x_m, at.y_m);
}

void DrivePilot::obeyed(const Motion& command, const pose_wall_planar_stop_result& stop) {
  if (phase_ == PilotPhase::kFollowing) {
    require_ok(pose_wall_planar_track_obeyed(tracker_, command.speed_m_s, command.turn_rad_s),
               translatable("the route"));
  }
  stop_ = stop;
  if (phase_ == PilotPhase::kLocating) crept_m_ += kFrame_s * std::abs(command.speed_m_s);
  moved_m_ += kFrame_s * rim_speed_m_s(command);
  if (!wants_to_move_ || moved_m_ > kProgress_m) {
    moved_ns_ = now_ns_;
    moved_m_ = 0.0;
  }
  const bool is_under_way = phase_ == PilotPhase::kFollowing || phase_ == PilotPhase::kLocating;
  if (is_under_way && seconds_since(moved_ns_, now_ns_) > patience_s_) give_up(held_text());
}

}  // namespace pose_wall::tools

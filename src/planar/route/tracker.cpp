// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/tracker.hpp"

#include <cmath>
#include <cstring>

#include "base/math/finite.hpp"

namespace pose_wall::planar::route {
namespace {

constexpr double kStepMost_s = 0.5;       // a longer pause counts as so much
constexpr double kTurnShare = 0.75;       // of turn_max, for the route's own curvature: the rest is for corrections
constexpr double kSettled = 4.744;        // (1 + x) exp(-x) is a twentieth: both roots of the error at 1 / settle * x
constexpr double kCorrectMost_rad = 0.6;  // a cross error asks for no steeper heading towards the route
constexpr double kFuture_s = 0.02;        // two clocks of one machine; a pose further ahead is of another clock
constexpr double kBrake = 0.7;            // share of speed_change that stops are planned with

double towards(double from, double to, double most) {
  return from + clamped(to - from, -most, most);
}

}  // namespace

void Tracker::lay_out(Arena& arena, const pose_wall_planar_track_settings& settings) {
  room_ = arena.take<pose_wall_planar_path_pose>(settings.path_max);
}

void Tracker::open(const pose_wall_planar_track_settings& settings) {
  settings_ = settings;
  model_.open(settings.delay_s, settings.lag_s, settings.pose_age_max_s);
  path_ = TrackPath();
  phase_ = Phase::idle;
  has_time_ = false;
  halt();
}

void Tracker::take_route(const pose_wall_planar_path_pose* poses, std::uint32_t count,
                         pose_wall_planar_clearance clearance, void* context) {
  std::memmove(room_.data(), poses, count * sizeof(*poses));
  path_.take(room_.first(count));
  clearance_ = clearance;
  context_ = context;
  leg_ = path_.leg_from(0);
  index_ = index_ahead_ = 0;
  phase_ = Phase::stopping;  // first it stands
}

double Tracker::step_seconds(std::int64_t now_ns) {
  const bool rises = has_time_ && now_ns > last_ns_;
  const double step_s =
      rises ? static_cast<double>(static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(last_ns_)) *
                  kNanosecond_s
            : 0.0;
  if (rises || !has_time_) last_ns_ = now_ns;
  has_time_ = true;
  return clamped(step_s, 0.0, kStepMost_s);
}

bool Tracker::is_good(const pose_wall_planar_track_input& input, double age_s) const {
  return input.has_pose == 1 && is_pose(input.pose) && input.pose_level_m >= 0.0 &&
         input.pose_level_m <= settings_.pose_level_max_m && age_s >= -kFuture_s && age_s <= settings_.pose_age_max_s;
}

void Tracker::report(const OnPath& at, pose_wall_planar_track_command* command) const {
  command->pose_index = at.index;
  // To the left as it drives: backwards the machine's left is on the right.
  command->cross_error_m = leg_.drive < 0 ? -at.cross_m : at.cross_m;
  command->heading_error_rad = at.heading_rad;
  command->along_m = at.along_m;
  command->remaining_m = path_[path_.size() - 1].along_m - at.along_m;
}

void Tracker::step(const pose_wall_planar_track_input& input, pose_wall_planar_track_command* command) {
  const double none = not_a_number();
  *command = {
      sizeof(*command), POSE_WALL_PLANAR_TRACK_IDLE, 0, 0, 0.0, 0.0, 0.0, 0.0, none, none, none, none, 0.0, 0.0};
  const double step_s = step_seconds(input.now_ns);
  model_.advance(step_s);
  const bool is_late = input.pose_ns <= last_ns_;
  double age_s =
      is_late ? static_cast<double>(static_cast<std::uint64_t>(last_ns_) - static_cast<std::uint64_t>(input.pose_ns)) *
                    kNanosecond_s
              : -static_cast<double>(static_cast<std::uint64_t>(input.pose_ns) - static_cast<std::uint64_t>(last_ns_)) *
                    kNanosecond_s;
  if (phase_ == Phase::idle) {
    halt();
  } else if (!is_good(input, age_s)) {
    halt();
    model_.learn_anew();
    command->state = POSE_WALL_PLANAR_TRACK_NO_POSE;
  } else {
    const Pose2 pose{input.pose.x_m, input.pose.y_m, wrapped(input.pose.yaw_rad)};
    age_s = age_s > 0.0 ? age_s : 0.0;
    if (leg_.drive != 0 && phase_ == Phase::leg && input.pose_ns != last_pose_ns_) model_.learn(pose, age_s);
    if (leg_.drive == 0 || phase_ != Phase::leg) model_.learn_anew();
    last_pose_ns_ = input.pose_ns;
    constexpr double kStill_m_s = 0.03;  // less is taken for noise of the measured speed
    seen_to_move_ = std::abs(input.speed_m_s) > kStill_m_s;
    drive(pose, age_s, step_s, command);
  }
  model_.command(now_);
  command->speed_m_s = now_.speed_m_s;
  command->turn_rad_s = now_.turn_rad_s;
  command->left_m_s = now_.speed_m_s - 0.5 * settings_.track_distance_m * now_.turn_rad_s;
  command->right_m_s = now_.speed_m_s + 0.5 * settings_.track_distance_m * now_.turn_rad_s;
  command->slip = model_.slip();
  command->drift_1_m = model_.drift_1_m();
}

void Tracker::next_leg() {
  leg_ = path_.leg_from(leg_.last);
  index_ = index_ahead_ = leg_.first;
}

void Tracker::drive(const Pose2& given, double age_s, double step_s, pose_wall_planar_track_command* command) {
  const Pose2 ahead = model_.predicted(given, age_s);
  if (leg_.last > leg_.first) {
    const OnPath at = path_.nearest(leg_, index_, given);
    if (leg_.drive != 0) index_ = at.index;
    report(at, command);
    const bool is_on = std::abs(at.cross_m) <= settings_.off_path_m &&
                       (leg_.drive == 0 || std::abs(at.heading_rad) <= settings_.off_path_rad);
    const bool is_before = leg_.drive == 0 || at.along_m <= path_.end_m(leg_) + settings_.off_path_m;
    if (phase_ != Phase::done && !(is_on && is_before)) phase_ = Phase::off_path;
  }
  if (phase_ == Phase::stopping && model_.stands() && !seen_to_move_)
    phase_ = leg_.last > leg_.first ? Phase::leg : Phase::done;
  command->state = POSE_WALL_PLANAR_TRACK_STOPPING;
  if (phase_ == Phase::leg && leg_.drive != 0) follow(ahead, step_s, command);
  if (phase_ == Phase::leg && leg_.drive == 0) turn(ahead, step_s, command);
  if (phase_ == Phase::leg) return;
  halt();
  if (phase_ == Phase::done) command->state = POSE_WALL_PLANAR_TRACK_DONE;
  if (phase_ == Phase::off_path) command->state = POSE_WALL_PLANAR_TRACK_OFF_PATH;
}

// The curvature to drive, as the way is driven: the route's own, without what the tracks add by themselves, and two
// gains that let cross and heading error fade as (1 + x) exp(-x), without overshoot.
double Tracker::steering(const OnPath& at) const {
  const double rate_1_m = kSettled / settings_.settle_m, drive = leg_.drive;
  const double cross_m = drive * at.cross_m, curvature_1_m = drive * at.curvature_1_m;
  const double most_m = 2.0 * kCorrectMost_rad / rate_1_m;
  const double back_1_m = rate_1_m * rate_1_m * clamped(cross_m, -most_m, most_m) + 2.0 * rate_1_m * at.heading_rad;
  return curvature_1_m - back_1_m - model_.drift_1_m();
}

double Tracker::allowed_speed(const OnPath& at, const Pose2& ahead, double left_m, std::uint32_t* slowed_by) const {
  double speed_m_s = settings_.speed_max_m_s;
  *slowed_by = POSE_WALL_PLANAR_SLOWED_BY_NOTHING;
  const auto limit = [&](double most_m_s, std::uint32_t reason) {
    const double at_least_m_s = most_m_s > settings_.speed_min_m_s ? most_m_s : settings_.speed_min_m_s;
    if (!(at_least_m_s < speed_m_s)) return;
    speed_m_s = at_least_m_s;
    *slowed_by = reason;
  };
  const double brake_m_s2 = kBrake * settings_.speed_change_m_s2;
  const double ahead_m = 0.2 + 0.5 * now_.speed_m_s * now_.speed_m_s / brake_m_s2;
  const double sharpest_1_m = path_.sharpest_1_m(leg_, at, ahead_m);
  if (sharpest_1_m > 1e-6)
    limit(kTurnShare * settings_.turn_max_rad_s / sharpest_1_m, POSE_WALL_PLANAR_SLOWED_BY_CURVE);
  if (clearance_ != nullptr && settings_.slow_below_m > 0.0) {
    const double room_m = clearance_(context_, ahead.x_m, ahead.y_m) - settings_.half_width_m;
    const double share = room_m > 0.0 ? room_m / settings_.slow_below_m : 0.0;  // not known: 0
    if (share < 1.0) limit(share * settings_.speed_max_m_s, POSE_WALL_PLANAR_SLOWED_BY_CLEARANCE);
  }
  limit(std::sqrt(2.0 * brake_m_s2 * (left_m > 0.0 ? left_m : 0.0)), POSE_WALL_PLANAR_SLOWED_BY_STOP);
  return speed_m_s;
}

void Tracker::follow(const Pose2& ahead, double step_s, pose_wall_planar_track_command* command) {
  const OnPath at = path_.nearest(leg_, index_ahead_, ahead);
  index_ahead_ = at.index;
  // What the lag lets the machine roll on is way that is left no more.
  const double rolls_m = std::abs(now_.speed_m_s) * (1.0 - model_.slip()) * settings_.lag_s;
  const double left_m = path_.end_m(leg_) - at.along_m - rolls_m;
  command->state = POSE_WALL_PLANAR_TRACK_FOLLOWING;
  if (left_m <= 0.5 * settings_.stop_within_m) {
    halt();
    next_leg();
    phase_ = Phase::stopping;
    command->state = POSE_WALL_PLANAR_TRACK_STOPPING;
    return;
  }
  double speed_m_s = allowed_speed(at, ahead, left_m, &command->slowed_by);
  const double curvature_1_m = steering(at);
  if (std::abs(curvature_1_m) * speed_m_s > settings_.turn_max_rad_s) {
    speed_m_s = settings_.turn_max_rad_s / std::abs(curvature_1_m);
    command->slowed_by = POSE_WALL_PLANAR_SLOWED_BY_CURVE;
  }
  const double before_m_s = std::abs(now_.speed_m_s);
  speed_m_s = towards(before_m_s, speed_m_s, settings_.speed_change_m_s2 * step_s);
  now_.speed_m_s = leg_.drive * speed_m_s;
  const double turn_rad_s = clamped(curvature_1_m * speed_m_s, -settings_.turn_max_rad_s, settings_.turn_max_rad_s);
  now_.turn_rad_s = towards(now_.turn_rad_s, turn_rad_s, settings_.turn_change_rad_s2 * step_s);
}

void Tracker::turn(const Pose2& ahead, double step_s, pose_wall_planar_track_command* command) {
  const double rolls_rad = now_.turn_rad_s * (1.0 - model_.slip()) * settings_.lag_s;
  const double left_rad = path_.left_to_turn(leg_, ahead.yaw_rad) - rolls_rad;
  command->state = POSE_WALL_PLANAR_TRACK_TURNING;
  if (std::abs(left_rad) <= 0.5 * settings_.stop_within_rad) {
    halt();
    next_leg();
    phase_ = Phase::stopping;
    command->state = POSE_WALL_PLANAR_TRACK_STOPPING;
    return;
  }
  constexpr double kSlowest = 0.08;  // of turn_max: slower, tracks stick
  const double brake_rad_s2 = kBrake * settings_.turn_change_rad_s2;
  const double rate_rad_s = clamped(std::sqrt(brake_rad_s2 * std::abs(left_rad)), kSlowest * settings_.turn_max_rad_s,
                                    settings_.turn_max_rad_s);
  now_.speed_m_s = 0.0;
  now_.turn_rad_s =
      towards(now_.turn_rad_s, left_rad < 0.0 ? -rate_rad_s : rate_rad_s, settings_.turn_change_rad_s2 * step_s);
}

}  // namespace pose_wall::planar::route

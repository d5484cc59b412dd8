// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// A machine that stands begins so fast; the stop judges the arc at this speed.
constexpr double kStart_m_s = 0.05;

Motion scaled(const Motion& motion, double share) {
  return {share * motion.speed_m_s, share * motion.turn_rad_s};
}

pose_wall_planar_stop_motion motion_of(const Motion& measured, const Motion& command) {
  pose_wall_planar_stop_motion motion{};
  motion.struct_size = sizeof motion;
  motion.given = POSE_WALL_PLANAR_STOP_MEASURED | POSE_WALL_PLANAR_STOP_COMMANDED;
  motion.speed_m_s = measured.speed_m_s;
  motion.turn_rad_s = measured.turn_rad_s;
  motion.command_speed_m_s = command.speed_m_s;
  motion.command_turn_rad_s = command.turn_rad_s;
  return motion;
}

}  // namespace

DriveGuard::DriveGuard(const sim::SensorModel& model, bool has_looked) : block_(POSE_WALL_PLANAR_STOP_BLOCK_MOST) {
  const api::Config config = drive_config(model);
  const pose_wall_planar_stop_settings settings = drive_stop_settings();
  require_ok(pose_wall_planar_stop_open(config.get(), &settings, block_.data(), block_.bytes(), &stop_),
             translatable("the settings of the stop"));
  if (has_looked) require_ok(pose_wall_planar_stop_confirm(stop_), translatable("the stop"));
  result_.struct_size = sizeof result_;
}

Motion DriveGuard::limit(const pose_wall_cloud& cloud, std::int64_t now_ns, const Motion& measured,
                         const Motion& wished) {
  const double wish_m_s = rim_speed_m_s(wished);
  const double judged_m_s = std::min(wish_m_s, std::max(rim_m_s_, kStart_m_s));
  const Motion judged = wish_m_s > 0.0 ? scaled(wished, judged_m_s / wish_m_s) : Motion{};
  const pose_wall_planar_stop_motion motion = motion_of(measured, judged);
  require_ok(pose_wall_planar_stop_process(stop_, &cloud, &motion, now_ns, &result_), translatable("the stop"));
  const bool stops = result_.state == POSE_WALL_PLANAR_STOP_STOP;
  rim_m_s_ = stops ? 0.0 : std::min(wish_m_s, result_.allowed_speed_m_s);
  return wish_m_s > 0.0 ? scaled(wished, rim_m_s_ / wish_m_s) : Motion{};
}

}  // namespace pose_wall::tools

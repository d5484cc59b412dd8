// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/stop_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/language/both_languages.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kSPerNs = 1e-9, kCmPerM = 100.0;
constexpr double kFine_s = 100.0;  // longer times are told in whole seconds

// What would clear it.
const char* remedy_of(StopCause cause) {
  switch (cause) {
    case StopCause::kNothing:
      return "";
    case StopCause::kNoFrame:
    case StopCause::kStale:
      return translatable("Look after the sensor, its power and its cable.");
    case StopCause::kInvalid:
      return translatable("Look after the sensor's clock, its rate and its view.");
    case StopCause::kFrozen:
      return translatable("Start the sensor anew.");
    case StopCause::kRestart:
      return translatable("Wait: it ends by itself.");
    case StopCause::kNoFloor:
      return translatable("Check planar_floor_z and the mounting, and clean the sensor's window.");
    case StopCause::kThing:
      return translatable("Remove it, or steer clear of it.");
    case StopCause::kNearing:
      return translatable("Keep clear of the way, or let the machine creep past.");
    case StopCause::kBlind:
      return translatable("Look there and confirm, drive slower, or clean the sensor's window.");
    case StopCause::kSpeed:
      return translatable("Drive slower.");
    case StopCause::kMissing:
      return translatable("Let it be measured or commanded (planar_motion).");
    case StopCause::kDust:
      return translatable("Wait until the dust has settled, or look there.");
  }
  return "";
}

Eigen::Vector2d axis_of(const std::string& forward_axis) {
  const double sign = forward_axis.front() == '-' ? -1.0 : 1.0;
  return forward_axis.back() == 'Y' ? Eigen::Vector2d(0.0, sign) : Eigen::Vector2d(sign, 0.0);
}

}  // namespace

// What stops whatever the way looks like comes first, then what limits the speed most.
StopCause stop_cause(const pose_wall_planar_stop_result& result) {
  const auto has = [&](std::uint32_t reason) { return (result.reasons & reason) != 0; };
  if (has(POSE_WALL_PLANAR_STOP_R_STALE)) return result.frames == 0 ? StopCause::kNoFrame : StopCause::kStale;
  if (has(POSE_WALL_PLANAR_STOP_R_INVALID)) return StopCause::kInvalid;
  if (has(POSE_WALL_PLANAR_STOP_R_FROZEN)) return StopCause::kFrozen;
  if (result.state == POSE_WALL_PLANAR_STOP_GO) return StopCause::kNothing;
  if (has(POSE_WALL_PLANAR_STOP_R_RESTART)) return StopCause::kRestart;
  if (has(POSE_WALL_PLANAR_STOP_R_THING)) {
    return has(POSE_WALL_PLANAR_STOP_R_NEARING) ? StopCause::kNearing : StopCause::kThing;
  }
  // Without a floor most places are blind.
  if (has(POSE_WALL_PLANAR_STOP_R_NO_FLOOR)) return StopCause::kNoFloor;
  if (has(POSE_WALL_PLANAR_STOP_R_BLIND)) return StopCause::kBlind;
  if (has(POSE_WALL_PLANAR_STOP_R_SPEED)) return StopCause::kSpeed;
  if (has(POSE_WALL_PLANAR_STOP_R_MISSING)) return StopCause::kMissing;
  return has(POSE_WALL_PLANAR_STOP_R_DUST) ? StopCause::kDust : StopCause::kNothing;
}

StopLine::StopLine(const pose_wall_planar_stop_settings& settings, const std::string& forward_axis)
    : thing_height_m_(settings.thing_height_m),
      restart_s_(settings.restart_s),
      ahead_base_(axis_of(forward_axis)),
      left_base_(-ahead_base_.y(), ahead_base_.x()),
      rear_m_(0.0),
      front_m_(0.0),
      right_m_(0.0),
      left_m_(0.0) {
  // The footprint holds the origin of base.
  for (std::uint32_t k = 0; k < settings.corners; ++k) {
    const Eigen::Vector2d corner(settings.corner_m[k][0], settings.corner_m[k][1]);
    rear_m_ = std::min(rear_m_, corner.dot(ahead_base_)), front_m_ = std::max(front_m_, corner.dot(ahead_base_));
    right_m_ = std::min(right_m_, corner.dot(left_base_)), left_m_ = std::max(left_m_, corner.dot(left_base_));
  }
}

std::string StopLine::text(Language language, const pose_wall_planar_stop_result& result, double for_s) const {
  const StopCause cause = stop_cause(result);
  if (cause == StopCause::kNothing) return "";
  const std::string told = why(language, cause, result);
  std::string remedy = tr(language, remedy_of(cause));
  const bool is_place = cause == StopCause::kThing || cause == StopCause::kNearing || cause == StopCause::kBlind;
  if (is_place && (result.reasons & POSE_WALL_PLANAR_STOP_R_MISSING) != 0) {
    remedy += tr(language, translatable(" While the motion is not known, all directions count (planar_motion)."));
  }
  // Of a thing, since when it has been there.
  const bool is_thing = is_place && cause != StopCause::kBlind;
  const double since_s = is_thing && std::isfinite(result.nearest_age_s) ? result.nearest_age_s : for_s;
  if (!std::isfinite(since_s)) return say_in(language, translatable("{}. {}"), told, remedy);
  const std::string seconds = fmt::format("{:.{}f}", since_s, since_s < kFine_s ? 1 : 0);
  return say_in(language, translatable("{}, for {} s. {}"), told, seconds, remedy);
}

std::string StopLine::why(Language language, StopCause cause, const pose_wall_planar_stop_result& result) const {
  switch (cause) {
    case StopCause::kNothing:
      return "";
    case StopCause::kNoFrame:
      return tr(language, translatable("No frame of the sensor has come yet"));
    case StopCause::kStale:
      return say_in(language, translatable("The newest frame of the sensor is {:.1f} s old"),
                    static_cast<double>(result.now_ns - result.stamp_ns) * kSPerNs);
    case StopCause::kInvalid:
      return tr(language, translatable("A frame of the sensor, or its stamp, is not sound"));
    case StopCause::kFrozen:
      return tr(language, translatable("The sensor repeats a cloud, or a part of it"));
    case StopCause::kRestart:
      return say_in(language, translatable("The way is clear again, but not for {:g} s yet"), restart_s_);
    case StopCause::kNoFloor:
      return tr(language, translatable("The floor is not seen"));
    case StopCause::kThing:
      return thing(language, result) + place(language, result);
    case StopCause::kNearing:
      return thing(language, result) + place(language, result) +
             tr(language, translatable(", that may walk into the way"));
    case StopCause::kBlind:
      return tr(language, translatable("A place that was not seen free")) + place(language, result);
    case StopCause::kSpeed:
      return std::isfinite(result.rim_speed_m_s)
                 ? say_in(language, translatable("The machine drives {:.2f} m/s, faster than it can stop"),
                          result.rim_speed_m_s)
                 : tr(language, translatable("The machine drives faster than it can stop"));
    case StopCause::kMissing:
      return tr(language, translatable("The machine's motion is not known, so every motion must be free"));
    case StopCause::kDust:
      return tr(language, translatable("Doubtful returns near the way: dust, or a thin thing"));
  }
  return "";
}

std::string StopLine::thing(Language language, const pose_wall_planar_stop_result& result) const {
  const char* kind = translatable("A thing");
  if (result.nearest_height == POSE_WALL_PLANAR_STOP_LOW) kind = translatable("A low thing, below {:g} m");
  if (result.nearest_height == POSE_WALL_PLANAR_STOP_HIGH) {
    kind = translatable("A thing above {:g} m, perhaps hanging");
  }
  if (result.nearest_height == POSE_WALL_PLANAR_STOP_STANDING) kind = translatable("A thing higher than {:g} m");
  const std::string text = say_in(language, kind, thing_height_m_);
  const double size_m = result.nearest_size_m;
  return std::isfinite(size_m) ? text + say_in(language, translatable(", {:.1f} m across"), size_m) : text;
}

std::string StopLine::place(Language language, const pose_wall_planar_stop_result& result) const {
  const Eigen::Vector2d at_base(result.nearest_m[0], result.nearest_m[1]);
  if (!at_base.allFinite()) return "";
  return along(language, at_base.dot(ahead_base_)) + across(language, at_base.dot(left_base_));
}

// Counted from the machine's own end.
std::string StopLine::along(Language language, double ahead_m) const {
  if (ahead_m > front_m_) return say_in(language, translatable(", {:.1f} m ahead"), ahead_m - front_m_);
  if (ahead_m < rear_m_) return say_in(language, translatable(", {:.1f} m behind"), rear_m_ - ahead_m);
  return tr(language, translatable(", beside the machine"));
}

// The track is what the machine covers when it drives straight.
std::string StopLine::across(Language language, double left_m) const {
  if (left_m > left_m_) {
    return say_in(language, translatable(", {:.0f} cm left of the track"), (left_m - left_m_) * kCmPerM);
  }
  if (left_m < right_m_) {
    return say_in(language, translatable(", {:.0f} cm right of the track"), (right_m_ - left_m) * kCmPerM);
  }
  return tr(language, translatable(", in the track"));
}

}  // namespace pose_wall::tools

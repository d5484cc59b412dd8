// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Why the obstacle stop stops or slows, and what would clear it, in one line for people at the machine.

#pragma once

#include <Eigen/Core>
#include <string>

#include "io/language/language.hpp"
#include "pose_wall_planar_stop.h"

namespace pose_wall::tools {

// The reason that a person must know of first.
enum class StopCause {
  kNothing,
  kNoFrame,
  kStale,
  kInvalid,
  kFrozen,
  kRestart,
  kNoFloor,
  kThing,
  kNearing,
  kBlind,
  kSpeed,
  kMissing,
  kDust
};

StopCause stop_cause(const pose_wall_planar_stop_result& result);

class StopLine {
 public:
  // forward_axis: "+X", "-X", "+Y" or "-Y".
  StopLine(const pose_wall_planar_stop_settings& settings, const std::string& forward_axis);

  // "A thing higher than 0.3 m, 0.5 m across, 2.1 m ahead, 30 cm left of the track, for 1.2 s. Remove it or steer clear
  // of it." for_s: so long the cause has been the same, for what has no age of its own; NaN: not known, and left out.
  // Empty where nothing limits it.
  std::string text(Language language, const pose_wall_planar_stop_result& result, double for_s) const;

 private:
  std::string why(Language language, StopCause cause, const pose_wall_planar_stop_result& result) const;
  std::string thing(Language language, const pose_wall_planar_stop_result& result) const;
  std::string place(Language language, const pose_wall_planar_stop_result& result) const;
  std::string along(Language language, double ahead_m) const;
  std::string across(Language language, double left_m) const;

  double thing_height_m_, restart_s_;
  Eigen::Vector2d ahead_base_, left_base_;
  // Of the footprint, along these.
  double rear_m_, front_m_, right_m_, left_m_;
};

}  // namespace pose_wall::tools

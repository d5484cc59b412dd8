// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The classes of motion: a scene of the simulator, how the machine moves in it, and what is right then.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lab/sim/scenes.hpp"

namespace pose_wall::tools::campaign {

// What a run may come to. NaN: nothing is asked.
struct MotionLimits {
  double measured_min;      // least share of frames whose way along is measured
  double told_min;          // the same of measured or ambiguous ones
  double unobservable_min;  // the same of unobservable ones
  double along_share;       // error along the road at the end, as a share of the way that was driven
  double along_share_few;   // the same for sensors of few points: VLP-16, Mid-360
  double along_m;           // and that much whatever the way
  double across_m;          // largest error across, and up
  double turn_deg;          // largest angle of the whole turn's error
};

// How long a run is.
enum class MotionLength {
  kWay,    // as far as the size says
  kTime,   // as long as the size says, at most seconds_max
  kFrames  // so many frames as the size says: where many are missing
};

// target = factor x source, after the draw.
struct MotionLink {
  const char* target;
  const char* source;
  double factor;
};

struct MotionClass {
  const char* name;
  const char* scene;  // of the simulator, whose ranges are drawn before those of `values`
  const char* help;
  const char* expected;  // what a good instrument does in it
  MotionLength length;
  double seconds_max;
  bool rough;  // rough rock alone, seen well: here sigma must be true, too
  MotionLimits limits;
  std::vector<sim::SceneValue> values;
  std::vector<MotionLink> links;
};

const std::vector<MotionClass>& motion_classes();
// nullptr if there is none of this name.
const MotionClass* find_motion_class(std::string_view name);
// Throws std::runtime_error if there is none.
const MotionClass& motion_class_of_record(std::string_view name);

// Sizes drawn by the seed; rock that never comes again. Throws std::invalid_argument for an unknown sensor.
sim::Setup make_motion_setup(const MotionClass& one, std::string_view sensor, std::uint64_t seed);

// Whether along_share_few is the sensor's limit.
bool has_few_points(std::string_view sensor);

}  // namespace pose_wall::tools::campaign

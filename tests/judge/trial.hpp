// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A road, a sensor and some frames, all by one seed: the clouds, their truth, and the settings of who measures there.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "judge/scanner.hpp"
#include "judge/surveyed.hpp"
#include "pose_wall.h"
#include "pose_wall_motion.h"

namespace pose_wall::judge {

constexpr std::int64_t kPeriod_ns = 100000000;  // 10 Hz

struct Case {
  std::uint64_t seed = 0;
  Furnishing furnishing = Furnishing::kDrawn;
  int sensor = -1;  // row of kSensorTable; -1: drawn
  int frames = 4;
  int from_frame = 0;    // frames before it are measured and not judged
  bool no_bias = false;  // ranges without a constant error
  // Scans that take their time, while the machine drives or stands, by sensors with their own tables of beams. Else all
  // rays at one instant, and a machine that creeps.
  bool times = false;
  Going going = Going::kDrawn;
};

// Of the road's planes, and of the rock that is really there.
struct Truths {
  // Signed distance to what lies between both. Where they are further apart than twice the limit within which a value
  // counts as right, to the nearer one.
  double error(int quantity, double value, double alert_limit) const;

  Truth road, surveyed;
};

// With what a road is measured.
struct Setup {
  pose_wall_config config;
  pose_wall_motion_settings motion;
};

// Of a delivered file, or the defaults.
FloorRegion floor_region_in(const std::string& file);
// The keys of a delivered file; what the engine does not know belongs to other programs.
void read_settings(const std::string& file, pose_wall_config* config);

// Everything that a seed decides, in the order in which it is drawn.
class Trial {
 public:
  explicit Trial(const Case& tried);

  const Sensor& sensor() const { return sensor_at(sensor_); }
  int sensor_row() const { return sensor_; }
  const Road& road() const { return road_; }
  const Drive& drive() const { return drive_; }
  // Keys of this machine, over those of its sensor's file.
  std::vector<Setting> settings() const;
  Setup setup() const;

  Cloud next_frame(Truths* truths);

 private:
  Cloud creeping_frame(Truths* truths);
  Truths truths_at(const Pose& pose) const;

  Case tried_;
  FloorRegion floor_;
  Draw draw_, drive_draw_;
  Road road_;
  int sensor_;
  Machine machine_;
  Scanner scanner_;
  Stance stance_;
  bool stands_;
  Drive drive_;
  int frame_ = 0;
};

// The points of each frame and the settings, to look at a case with other tools: PCD files and a YAML file.
void write_frames(const Case& tried, const std::string& folder);

}  // namespace pose_wall::judge

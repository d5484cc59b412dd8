// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The engine before the judge: a road, a sensor and some frames through the C ABI, each value compared with the truth.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "judge/scanner.hpp"
#include "pose_wall.h"

namespace pose_wall::judge {

struct Case {
  std::uint64_t seed = 0;
  bool quiet = false;  // a road of flat whole walls without features
  int sensor = -1;     // row of kSensorTable; -1: drawn
  int frames = 4;
  bool no_bias = false;  // ranges without a constant error
};

// One value of one frame.
struct Finding {
  // Off by more than its level; raw likewise; valid, and off by more than its alert limit.
  bool beyond() const { return measured_or_held() && !(error_abs() <= level); }
  bool raw_beyond() const { return raw_state != POSE_WALL_INVALID && !(raw_error_abs() <= raw_level); }
  bool misleading() const { return state == POSE_WALL_VALID && !(error_abs() <= alert_limit); }
  bool measured_or_held() const { return state != POSE_WALL_INVALID; }
  double error_abs() const { return error < 0.0 ? -error : error; }
  double raw_error_abs() const { return raw_error < 0.0 ? -raw_error : raw_error; }

  int frame = 0, quantity = 0;
  std::uint32_t state = 0, raw_state = 0, reasons = 0, cause = 0;
  double error = 0.0, level = 0.0, raw_error = 0.0, raw_level = 0.0, sigma = 0.0, alert_limit = 0.0;
};

struct Verdict {
  // "road 17 (vlp16, pipes+body), frame 2: d_lf valid, off by 0.1203, level 0.0811 ..., and how to replay it"
  std::string text(const Finding& finding) const;

  Case tried;
  int sensor = 0;
  std::uint32_t features = 0;
  std::vector<Finding> findings;  // frames x quantities
};

// What measures the frames of a road, opened with its config.
using Process = std::function<pose_wall_result(const pose_wall_cloud&)>;
using Open = std::function<Process(const pose_wall_config&)>;

// Throws std::runtime_error where the engine refuses a call.
Verdict hear(const Case& tried, const Open& open);
// The delivered engine.
Verdict hear(const Case& tried);

// The points of one frame and the settings, to look at a case with other tools: PCD files and a YAML file.
void write_frames(const Case& tried, const std::string& folder);

// What many verdicts come to, for one quantity.
struct Tally {
  void add(const Finding& finding);
  double share_valid() const { return frames == 0 ? 0.0 : static_cast<double>(valid) / frames; }

  int frames = 0, valid = 0, degraded = 0, held = 0;
  int beyond_valid = 0, beyond_degraded = 0, beyond_held = 0, raw_beyond = 0, misleading = 0;
  double closest = 0.0;                                 // largest share of its level that an error took
  double z2_sum = 0.0;                                  // of their squared errors over squared sigma
  std::vector<double> errors, levels, levels_in_sigma;  // of measured values: raw ones
  std::vector<int> reasons = std::vector<int>(32, 0);   // of values that are not valid
};
using Tallies = std::vector<Tally>;  // one a quantity

void add(Tallies* tallies, const Verdict& verdict);
// A row a quantity: frames, valid share, errors, levels, what is beyond.
std::string table(const Tallies& tallies);
// Why values are not valid, most frequent first.
std::string reasons_table(const Tallies& tallies);

}  // namespace pose_wall::judge

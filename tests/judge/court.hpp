// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The engine before the judge: the frames of a trial through the C ABI, each value compared with the truth. Several
// treatments of the engine hear the very same clouds.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "judge/trial.hpp"
#include "pose_wall.h"

namespace pose_wall::judge {

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
  // Valid, and wrong by one truth alone.
  bool misleading_by(double one_error) const {
    return state == POSE_WALL_VALID && (one_error < 0.0 ? -one_error : one_error) > alert_limit;
  }

  // By each truth alone; the latter is NaN where no plane of the rock is that wall. The others are by both.
  double road_error = 0.0, surveyed_error = 0.0;
  double error = 0.0, level = 0.0, raw_error = 0.0, raw_level = 0.0, sigma = 0.0, alert_limit = 0.0;
};

// How the engine is used.
struct Treatment {
  bool motion = false;         // the motion library beside it
  std::uint32_t work_max = 0;  // the key; 0: by returns and voxels of the cloud
};

// What one frame took.
struct Work {
  std::uint64_t steps = 0;
  bool limited = false;  // the budget ended it
};

struct Verdict {
  // "road 17 (vlp16, pipes+body), frame 2: d_lf valid, off by 0.1203, level 0.0811 ..., and how to replay it"
  std::string text(const Finding& finding) const;

  Case tried;
  Treatment treatment;
  int sensor = 0;
  std::uint32_t features = 0;
  std::vector<Finding> findings;  // frames x quantities
  std::vector<Work> work;         // one a frame
};

// What measures the frames of a road, opened with what it is measured with.
using Process = std::function<pose_wall_result(const pose_wall_cloud&)>;
using Open = std::function<Process(const Setup&)>;

// The delivered libraries.
Open opened_as(const Treatment& treatment);

// One verdict for each. Throws std::runtime_error where the engine refuses a call.
std::vector<Verdict> hear(const Case& tried, const std::vector<Open>& each);
std::vector<Verdict> hear(const Case& tried, const std::vector<Treatment>& treatments);
Verdict hear(const Case& tried, const Treatment& treatment = {});

}  // namespace pose_wall::judge

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The card of motion: what the records of a campaign come to, per class and sensor.

#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "lab/campaign/manifest.hpp"
#include "lab/campaign/motion_classes.hpp"
#include "lab/campaign/motion_record.hpp"
#include "study/motion/motion_comparison.hpp"

namespace pose_wall::tools::campaign {

// 5 %, median and 95 % of numbers; NaN for none.
struct Spread {
  double low, middle, high;
};
Spread spread_of(const std::vector<double>& numbers);

using DirectionTotals = std::array<DirectionErrors, POSE_WALL_MOTION_DIRECTIONS>;

// One class as one sensor sees it. Errors are absolute.
struct MotionClassCard {
  const MotionClass* kind = nullptr;
  std::string sensor;
  std::size_t runs = 0, runs_without_pose = 0;
  std::size_t frames = 0;
  std::size_t judged = 0;  // frames but the first of each run, which has no step
  std::array<std::size_t, POSE_WALL_ALONG_MEASURED + 2> states{};  // of those; the last: unreadable
  std::vector<double> along_m, along_share;                        // at the end of each run; share: of the way it drove
  double along_excess = 0.0;                                       // the worst run's, over what is allowed to it
  double across_m = 0.0, up_m = 0.0, turn_rad = 0.0;               // largest
  Misleading poses, steps;
  DirectionTotals pose, step;
  std::vector<double> contrast, patches;
  double ms_sum = 0.0, ms_worst = 0.0;

  double share(std::uint32_t state) const;
};

// A frame worth a look.
struct MotionEvent {
  const char* what;
  double excess;  // over what was allowed
  Run run;
  std::uint64_t frame;
  bool is_misleading;

  bool misleads() const { return is_misleading; }
};

struct MotionCard {
  Manifest manifest;
  std::size_t runs = 0;  // with a record
  std::vector<MotionClassCard> classes;
  std::vector<MotionEvent> events;  // by keep_worst

  // In the order of for_each_record. Throws std::runtime_error for a class that does not exist.
  void add(const MotionRecord& record);
};

// Error along the road that is allowed at the end of a run; NaN: any.
double allowed_along_m(const MotionClassCard& one, double way_m);

// Over the classes of rough rock.
struct RoughTotals {
  std::size_t runs = 0;
  DirectionErrors along_step, along_pose;
};
RoughTotals rough_totals(const MotionCard& card);

}  // namespace pose_wall::tools::campaign

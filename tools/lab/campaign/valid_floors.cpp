// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/valid_floors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/campaign/event.hpp"
#include "lab/sim/scenes.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr double kPercent = 0.01;

constexpr ValidShare of_percent(double share, double spread) {
  return {kPercent * share, kPercent * spread};
}

}  // namespace

const std::vector<ClassShares>& valid_shares() {
  static const std::vector<ClassShares> table = {
#define VALID_SHARES(scene, sensor, roll, roll_spread, pitch, pitch_spread, yaw, yaw_spread, distances, \
                     distances_spread)                                                                  \
  {scene,                                                                                               \
   sensor,                                                                                              \
   {of_percent(roll, roll_spread), of_percent(pitch, pitch_spread), of_percent(yaw, yaw_spread),        \
    of_percent(distances, distances_spread)}},
#include "lab/campaign/valid_shares.def"
#undef VALID_SHARES
  };
  return table;
}

const ClassShares* find_valid_shares(std::string_view scene, std::string_view sensor) {
  for (const ClassShares& one : valid_shares()) {
    if (one.scene == scene && one.sensor == sensor) return &one;
  }
  return nullptr;
}

void ValidCount::add(const ValidShare& expected, std::size_t values, std::size_t valid, std::size_t runs) {
  if (values == 0 || runs == 0) return;
  const auto weight = static_cast<double>(values);
  values_ += values;
  valid_ += valid;
  runs_ += runs;
  expected_ += weight * expected.share;
  variance_ += weight * weight * expected.spread * expected.spread / static_cast<double>(runs);
}

void ValidCount::merge(const ValidCount& other) {
  values_ += other.values_;
  valid_ += other.valid_;
  runs_ += other.runs_;
  expected_ += other.expected_;
  variance_ += other.variance_;
}

double ValidCount::share() const {
  if (values_ == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(valid_) / static_cast<double>(values_);
}

double ValidCount::floor() const {
  if (values_ == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto all = static_cast<double>(values_);
  const double slack = kSlackSpreads * std::sqrt(variance_) / all + kSlackRuns / static_cast<double>(runs_);
  return std::max(expected_ / all - slack, 0.0);
}

bool ValidCount::holds() const {
  return values_ == 0 || share() >= floor();
}

bool is_cut(const Run& run) {
  return run.frames < frames_to_watch(sim::make_setup(*scene_of(run.scene), run.sensor, true, run.seed));
}

}  // namespace pose_wall::tools::campaign

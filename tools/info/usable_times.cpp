// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "info/usable_times.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "frames/field_aliases.hpp"
#include "frames/field_value.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kScansMost = 50;       // of a recording, all are of one driver
constexpr std::uint32_t kPointsLeast = 64;   // fewer may be of one moment
constexpr double kUnusableShareLeast = 0.2;  // single scans may be broken
constexpr TimeFault kUnusable[] = {TimeFault::kType, TimeFault::kOne, TimeFault::kUnit};

}  // namespace

TimeFault unusable_times(const Frame& frame) {
  const pose_wall_cloud& cloud = frame.cloud;
  if (cloud.time.type == POSE_WALL_FIELD_NONE) {
    const bool is_named = std::any_of(frame.fields.begin(), frame.fields.end(), [](const FrameField& field) {
      return field_role(field.name) == FieldRole::kTime;
    });
    return is_named ? TimeFault::kType : TimeFault::kNone;
  }
  if (std::uint64_t{cloud.width} * cloud.height < kPointsLeast) return TimeFault::kNone;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const double time = field_value(cloud, row, column, cloud.time);
      if (!std::isfinite(time)) continue;
      least = std::min(least, time);
      most = std::max(most, time);
    }
  }
  if (!(most > least)) return TimeFault::kOne;
  return time_unit_s(most - least) > 0.0 ? TimeFault::kNone : TimeFault::kUnit;
}

void UsableTimes::add(const Frame& frame) {
  if (scans_ == kScansMost) return;
  ++scans_;
  const TimeFault* const found = std::find(std::begin(kUnusable), std::end(kUnusable), unusable_times(frame));
  if (found != std::end(kUnusable)) ++faulty_[found - std::begin(kUnusable)];
}

std::string UsableTimes::doubt() const {
  const std::size_t* const most = std::max_element(std::begin(faulty_), std::end(faulty_));
  if (*most == 0 || static_cast<double>(*most) < kUnusableShareLeast * static_cast<double>(scans_)) return "";
  ScanTimeFacts facts;
  facts.fault = kUnusable[most - std::begin(faulty_)];
  facts.scans = scans_;
  facts.faulty = *most;
  return say("times: {}", times_doubt(facts));
}

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/usable_times.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "io/frames/field_aliases.hpp"
#include "io/frames/field_value.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kScansMost = 50;                // of a recording, all are of one driver
constexpr std::uint32_t kPointsLeast = 64;            // fewer may be of one moment
constexpr double kUnusableShareLeast = 0.2;           // single scans may be broken
constexpr double kBendSpeed_m_s = 0.2;                // 0.02 m of 0.10 m in 0.1 s; judgement, 2026-11-29
constexpr double kBendTurn_rad_s = 2.0 * kRadPerDeg;  // 0.2 of 1 degree in 0.1 s; judgement, 2026-11-29
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

bool has_times(const Frame& frame) {
  return frame.cloud.time.type != POSE_WALL_FIELD_NONE;
}

bool bends_scan(const pose_wall_motion_result& moved) {
  const double* const level = moved.step_protection_level;
  // Accepts inside: a step that is not known, or not beyond its level, is none.
  const auto is_fast = [&](const double* step, const double* levels, double rate) {
    const double size = std::hypot(step[0], step[1], step[2]);
    return size > std::hypot(levels[0], levels[1], levels[2]) && size >= rate * moved.step_s;
  };
  return is_fast(moved.step_m, level + POSE_WALL_MOTION_ALONG, kBendSpeed_m_s) ||
         is_fast(moved.step_rad, level + POSE_WALL_MOTION_ROLL, kBendTurn_rad_s);
}

void UsableTimes::add(const Frame& frame) {
  has_times_ = has_times(frame);
  ++all_scans_;
  if (scans_ == kScansMost) return;
  ++scans_;
  const TimeFault* const found = std::find(std::begin(kUnusable), std::end(kUnusable), unusable_times(frame));
  if (found != std::end(kUnusable)) ++faulty_[found - std::begin(kUnusable)];
}

void UsableTimes::add_motion(const pose_wall_motion_result& moved) {
  if (!has_times_ && bends_scan(moved)) ++bent_;
}

std::string UsableTimes::doubt() const {
  const std::size_t* const most = std::max_element(std::begin(faulty_), std::end(faulty_));
  ScanTimeFacts facts;
  if (*most > 0 && static_cast<double>(*most) >= kUnusableShareLeast * static_cast<double>(scans_)) {
    facts.fault = kUnusable[most - std::begin(faulty_)];
    facts.scans = scans_;
    facts.faulty = *most;
  } else if (bent_ >= kBentScansLeast) {
    facts.fault = TimeFault::kMissing;
    facts.scans = all_scans_;
    facts.faulty = bent_;
  } else {
    return "";
  }
  return say("times: {}", times_doubt(facts));
}

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What must hold of every result of a motion, whatever came in. Through the C ABI alone and without a test framework:
// tests ask for a null, fuzzers trap on any other.

#pragma once

#include <cmath>
#include <cstdint>

#include "pose_wall_motion.h"

namespace pose_wall::test {

inline bool all_finite(const double* values, int count) {
  for (int k = 0; k < count; ++k) {
    if (!std::isfinite(values[k])) return false;
  }
  return true;
}
inline bool all_nan(const double* values, int count) {
  for (int k = 0; k < count; ++k) {
    if (!std::isnan(values[k])) return false;
  }
  return true;
}

inline const char* broken_pose(const pose_wall_motion_result& r) {
  if (!all_finite(r.position_m, 3)) return "a place that is no number";
  if (!all_finite(r.quaternion, 4)) return "a turn that is no number";
  if (!std::isfinite(r.along_m)) return "a way along that is no number";
  double squares = 0.0;
  for (const double q : r.quaternion) squares += q * q;
  if (!(std::fabs(squares - 1.0) < 1e-9)) return "a quaternion that is not unit";
  if (!(r.quaternion[3] >= 0.0)) return "a quaternion with w < 0";
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    if (!(std::isfinite(r.sigma[k]) && r.sigma[k] >= 0.0)) return "a sigma that is none";
    if (!(std::isfinite(r.protection_level[k]) && r.protection_level[k] >= 0.0)) return "a level that is none";
  }
  return nullptr;
}

inline const char* broken_while_lost(const pose_wall_motion_result& r) {
  if (!all_nan(r.position_m, 3) || !all_nan(r.quaternion, 4) || !std::isnan(r.along_m)) return "a pose while lost";
  if (!all_nan(r.step_m, 3) || !all_nan(r.step_rad, 3)) return "a step while lost";
  for (const double level : r.protection_level) {
    if (!(std::isinf(level) && level > 0.0)) return "a finite level while lost";
  }
  // A stamp that stands still before there is any map: nothing was looked at, and there is no pose to keep.
  constexpr std::uint32_t kWhy = POSE_WALL_MOTION_R_FEW_POINTS | POSE_WALL_MOTION_R_FEW_MATCHES |
                                 POSE_WALL_MOTION_R_AT_EDGE | POSE_WALL_MOTION_R_STAMP | POSE_WALL_MOTION_R_REPEATED;
  return (r.reasons & kWhy) == 0 ? "lost for no reason" : nullptr;
}

inline const char* broken_step(const pose_wall_motion_result& r) {
  const bool none = all_nan(r.step_m, 3);
  if (none != all_nan(r.step_rad, 3) || none != all_nan(r.step_sigma, POSE_WALL_MOTION_DIRECTIONS) ||
      none != std::isnan(r.step_s)) {
    return "half a step";
  }
  if (none) return nullptr;
  if (!all_finite(r.step_m, 3) || !all_finite(r.step_rad, 3)) return "a step that is no number";
  if (!(r.step_s > 0.0)) return "a step in no time";
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    if (!(std::isfinite(r.step_sigma[k]) && r.step_sigma[k] >= 0.0)) return "a sigma of a step that is none";
    if (!(std::isfinite(r.step_protection_level[k]) && r.step_protection_level[k] >= 0.0)) {
      return "a level of a step that is none";
    }
  }
  return nullptr;
}

// By one result alone; null where it keeps the contract.
inline const char* broken_motion(const pose_wall_motion_result& r) {
  if (r.along_state > POSE_WALL_ALONG_MEASURED) return "no such state";
  if ((r.reasons >> POSE_WALL_MOTION_REASON_COUNT) != 0) return "no such reason";
  if (r.frame_index == 0 && !all_nan(r.step_m, 3)) return "a step to the first frame";
  double axis = 0.0;
  for (const double a : r.road_axis) axis += a * a;
  if (!(std::fabs(axis - 1.0) < 1e-6)) return "a road axis that is not unit";
  if (r.points_used > r.points_in) return "more points used than given";
  if (const char* broken = broken_step(r)) return broken;
  return r.along_state == POSE_WALL_ALONG_LOST ? broken_while_lost(r) : broken_pose(r);
}

// By two results, one after the other: what is not observed is not known better than before.
inline const char* broken_between(const pose_wall_motion_result& before, const pose_wall_motion_result& now) {
  if (now.frame_index != before.frame_index + 1) return "frames that do not count";
  const bool had_pose = before.along_state != POSE_WALL_ALONG_LOST;
  if (!had_pose || now.along_state != POSE_WALL_ALONG_UNOBSERVABLE) return nullptr;
  const double least = before.protection_level[POSE_WALL_MOTION_ALONG];
  return now.protection_level[POSE_WALL_MOTION_ALONG] < least - 1e-9 ? "a level along that shrinks while unobservable"
                                                                     : nullptr;
}

}  // namespace pose_wall::test

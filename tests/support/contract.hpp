// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What must hold of every result, whatever the cloud, the stamps and the order of calls were. Through the C ABI alone
// and without a test framework: tests ask for an empty text, fuzzers trap on any other.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "pose_wall.h"

namespace pose_wall::test {

inline bool is_live(const pose_wall_value& v) {
  return v.state == POSE_WALL_VALID || v.state == POSE_WALL_DEGRADED;
}

// Of what the config asks, as much as a result can be held to.
struct ContractLimits {
  double alert[POSE_WALL_QUANTITIES];
  double reach[POSE_WALL_QUANTITIES];  // no value's magnitude is larger
  double hold_max_s;
  std::uint32_t points_max;
};

inline double number_of(const pose_wall_config& config, const char* key) {
  double value = std::nan("");
  pose_wall_config_get_number(&config, key, &value);
  return value;
}

inline ContractLimits limits_of(const pose_wall_config& config) {
  constexpr double kPerDegree_rad = 0.017453292519943295, kRounding_rad = 1e-6;
  // Walls within this of each other are turned onto their mean, after each passed yaw_max_deg by itself.
  const double turned_rad = 2.0 * kPerDegree_rad * number_of(config, "wall_parallel_within_deg");
  const double tilt_rad = kPerDegree_rad * number_of(config, "ground_tilt_max_deg") + kRounding_rad;
  const double yaw_rad = kPerDegree_rad * number_of(config, "yaw_max_deg") + turned_rad + kRounding_rad;
  const double sensor_m =
      std::hypot(number_of(config, "extrinsic_x"), number_of(config, "extrinsic_y"), number_of(config, "extrinsic_z"));
  // A plane goes through points that the sensor saw; so it is no further from the sampling point than they are.
  const double seen_m = number_of(config, "range_max") + sensor_m + 1.0;
  ContractLimits limits{};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const bool front = q == POSE_WALL_D_LF || q == POSE_WALL_D_RF, left = q <= POSE_WALL_D_LB;
    const double sample_m = std::hypot(number_of(config, front ? "s_front" : "s_back"),
                                       number_of(config, left ? "lateral_offset_left" : "lateral_offset_right"));
    limits.alert[q] = q <= POSE_WALL_YAW ? kPerDegree_rad * number_of(config, "alert_limit_angle_deg")
                                         : number_of(config, "alert_limit_distance");
    limits.reach[q] = q < POSE_WALL_YAW ? tilt_rad : (q == POSE_WALL_YAW ? yaw_rad : seen_m + sample_m);
  }
  limits.hold_max_s = number_of(config, "hold_max");
  limits.points_max = static_cast<std::uint32_t>(number_of(config, "points_max"));
  return limits;
}

// Reasons that no valid value carries: each says that it was not measured, or not well.
constexpr std::uint32_t kNeverOfValid =
    POSE_WALL_R_NO_POINTS | POSE_WALL_R_LEAF_GROWN | POSE_WALL_R_STAMP_STILL | POSE_WALL_R_FROZEN |
    POSE_WALL_R_FLOOR_NOT_FOUND | POSE_WALL_R_FLOOR_FEW_INLIERS | POSE_WALL_R_FLOOR_THIN | POSE_WALL_R_FLOOR_AMBIGUOUS |
    POSE_WALL_R_WALL_NOT_FOUND | POSE_WALL_R_WALL_FEW_INLIERS | POSE_WALL_R_WALL_SHORT | POSE_WALL_R_WALL_LEANS |
    POSE_WALL_R_WALL_SEEN_THROUGH | POSE_WALL_R_WALL_AMBIGUOUS | POSE_WALL_R_YAW_OUT_OF_RANGE | POSE_WALL_R_CROSS_ROAD |
    POSE_WALL_R_CURVED | POSE_WALL_R_EXTRAPOLATED | POSE_WALL_R_LEVEL_MISSING | POSE_WALL_R_ALERT_LIMIT |
    POSE_WALL_R_INNOVATION | POSE_WALL_R_HOLD_EXPIRED | POSE_WALL_R_WALL_TOO_NEAR | POSE_WALL_R_NEVER_MEASURED |
    POSE_WALL_R_NO_FRAME;

// Empty where the value keeps the contract, else what it breaks. By the value alone, whatever the config.
inline const char* broken_promise(const pose_wall_value& v) {
  const bool live = is_live(v), invalid = v.state == POSE_WALL_INVALID;
  const bool never = (v.reasons & POSE_WALL_R_NEVER_MEASURED) != 0;
  if (v.state > POSE_WALL_VALID) return "no such state";
  if ((v.reasons >> POSE_WALL_REASON_COUNT) != 0) return "no such reason";
  if (!(v.confidence >= 0.0 && v.confidence <= 1.0)) return "confidence outside 0..1";
  if (invalid != (v.confidence == 0.0)) return "confidence 0 is for invalid alone";
  if (!(v.age_s >= 0.0) || !std::isfinite(v.age_s)) return "no age";
  if (live && v.age_s != 0.0) return "measured in this frame, and has an age";
  if (std::isnan(v.raw) == live) return "raw is there iff it was measured";
  if (v.state == POSE_WALL_VALID && (v.reasons & kNeverOfValid) != 0) return "valid in spite of a reason";
  if (v.state != POSE_WALL_VALID && v.reasons == 0) return "not valid, without a reason";
  if (never && !invalid) return "never measured, and told";
  if (never) return std::isnan(v.value) && std::isnan(v.protection_level) ? "" : "never measured, and a number";
  if (!std::isfinite(v.value)) return "value is no number";
  if (!(v.sigma > 0.0) || !std::isfinite(v.sigma)) return "sigma is no positive number";
  // A value that has long been held in vain may have any level; one that is told has a finite one.
  if (!(v.protection_level > 0.0)) return "level is no positive number";
  if (invalid) return "";
  if (!std::isfinite(v.protection_level)) return "level is not finite";
  if (live && !std::isfinite(v.raw)) return "raw is no number";
  if (live && !(std::fabs(v.value - v.raw) <= v.protection_level)) return "smoothed out of its own level";
  return "";
}

// The same with what the config says of quantity q.
inline const char* broken_promise(const pose_wall_value& v, std::uint32_t q, const ContractLimits& limits) {
  const char* const broken = broken_promise(v);
  if (broken[0] != '\0') return broken;
  const double alert = limits.alert[q], reach = limits.reach[q];
  if (!std::isnan(v.value)) {
    if (!(std::fabs(v.value) <= reach) || (q >= POSE_WALL_D_LF && v.value < 0.0)) return "value outside the geometry";
  }
  if (is_live(v) && (!(std::fabs(v.raw) <= reach) || (q >= POSE_WALL_D_LF && v.raw < 0.0))) {
    return "raw outside the geometry";
  }
  if (v.state == POSE_WALL_INVALID) return "";
  if (v.state != POSE_WALL_DEGRADED && !(v.protection_level <= alert)) return "told beyond its alert limit";
  if (v.state == POSE_WALL_HELD && !(v.age_s <= limits.hold_max_s)) return "held for longer than hold_max";
  const double confidence = alert / (alert + v.protection_level);
  if (!(std::fabs(v.confidence - confidence) <= 1e-12)) return "confidence does not follow from the level";
  return "";
}

inline std::uint64_t dropped(const pose_wall_result& r) {
  return std::uint64_t{r.dropped_not_finite} + r.dropped_zero + r.dropped_near + r.dropped_far + r.dropped_body;
}

inline bool is_plane(const pose_wall_plane& p) {
  const double norm = std::hypot(p.normal[0], p.normal[1], p.normal[2]);
  if (p.found == 0) return norm == 0.0 && p.d_m == 0.0 && p.inliers == 0;
  return p.found == 1 && std::fabs(norm - 1.0) <= 1e-9 && std::isfinite(p.d_m) && p.rms_m >= 0.0 &&
         std::isfinite(p.rms_m) && std::isfinite(p.lean_rad) && p.area_m2 >= 0.0 && p.extent_min_m <= p.extent_max_m;
}

inline bool is_rotation(const double (&R)[9]) {
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const double dot = R[3 * a] * R[3 * b] + R[3 * a + 1] * R[3 * b + 1] + R[3 * a + 2] * R[3 * b + 2];
      if (!(std::fabs(dot - (a == b ? 1.0 : 0.0)) <= 1e-9)) return false;
    }
  }
  return true;
}

// Of the frame apart from its values.
inline const char* broken_frame(const pose_wall_result& r, const ContractLimits& limits) {
  double least = 1.0;
  for (const pose_wall_value& v : r.quantity) least = std::min(least, v.confidence);
  if (r.confidence != least) return "confidence is not the least of the seven";
  if (r.struct_size != sizeof r) return "struct_size";
  if ((r.frame_reasons >> POSE_WALL_REASON_COUNT) != 0) return "no such reason of a frame";
  if (dropped(r) > r.points_in) return "more points dropped than came";
  if (r.voxels > limits.points_max || r.voxels > r.points_in) return "more voxels than room or points";
  if (r.outliers > r.voxels || r.wall_points > r.voxels) return "more of the voxels than there are";
  for (const pose_wall_plane* p : {&r.floor, &r.left, &r.right}) {
    if (!is_plane(*p)) return "a plane that is none";
  }
  if (!is_rotation(r.R_level_base)) return "R_level_base is no rotation";
  const bool floor = is_live(r.quantity[POSE_WALL_ROLL]), walls = is_live(r.quantity[POSE_WALL_YAW]);
  const bool left = is_live(r.quantity[POSE_WALL_D_LF]) || is_live(r.quantity[POSE_WALL_D_LB]);
  const bool right = is_live(r.quantity[POSE_WALL_D_RF]) || is_live(r.quantity[POSE_WALL_D_RB]);
  if ((floor && r.floor.found == 0) || (left && r.left.found == 0) || (right && r.right.found == 0)) {
    return "measured without a plane";
  }
  if ((left || right || walls) && r.floor.found == 0) return "walls without a floor";
  const double up[3] = {r.floor.normal[0], r.floor.normal[1], r.floor.normal[2]};
  const double roll = std::atan2(up[1], up[2]), pitch = std::atan2(-up[0], std::hypot(up[1], up[2]));
  if (floor && (!(std::fabs(roll - r.quantity[POSE_WALL_ROLL].raw) <= 1e-9) ||
                !(std::fabs(pitch - r.quantity[POSE_WALL_PITCH].raw) <= 1e-9))) {
    return "roll and pitch are not the floor's";
  }
  return "";
}

// Empty, or "yaw: told beyond its alert limit".
inline std::string broken_contract(const pose_wall_result& r, const ContractLimits& limits) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const char* const broken = broken_promise(r.quantity[q], q, limits);
    if (broken[0] != '\0') return std::string(pose_wall_quantity_name(q)) + ": " + broken;
  }
  return broken_frame(r, limits);
}

// Of clouds that show no road: "" where nothing is told to be valid.
inline std::string valid_from_garbage(const pose_wall_result& r) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (r.quantity[q].state == POSE_WALL_VALID) return std::string(pose_wall_quantity_name(q)) + ": valid from garbage";
  }
  return "";
}

// Follows one engine from call to call; what it remembers is forgotten with pose_wall_open, _reset and _load.
class ContractWatch {
 public:
  explicit ContractWatch(const pose_wall_config& config) : limits_(limits_of(config)) {}

  void forget() { *this = ContractWatch(limits_); }

  // After pose_wall_process. Empty, or what is broken.
  std::string processed(const pose_wall_result& r) {
    std::string broken = broken_contract(r, limits_);
    if (broken.empty() && r.frame_index != frames_) broken = "frame_index does not count the frames";
    ++frames_;
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES && broken.empty(); ++q) {
      const char* const link = broken_link(r.quantity[q], told_[q]);
      if (link[0] != '\0') broken = std::string(pose_wall_quantity_name(q)) + ": " + link;
      take(r.quantity[q], &told_[q]);
    }
    return broken;
  }

  // After pose_wall_age.
  std::string aged(const pose_wall_result& r) {
    std::string broken = broken_contract(r, limits_);
    if (broken.empty() && r.frame_index != frames_ - 1) broken = "frame_index is not the last";
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES && broken.empty(); ++q) {
      if (is_live(r.quantity[q])) broken = "measured without a frame";
      if (r.quantity[q].state == POSE_WALL_INVALID) told_[q].gave_up = true;
    }
    return broken;
  }

 private:
  struct Told {
    bool ever = false, gave_up = false, was_held = false;
    double last_live = 0.0, last_valid = 0.0, held_level = 0.0;
    bool has_valid = false;
  };

  explicit ContractWatch(const ContractLimits& limits) : limits_(limits) {}

  static const char* broken_link(const pose_wall_value& v, const Told& told) {
    if (is_live(v)) return "";
    if (((v.reasons & POSE_WALL_R_NEVER_MEASURED) != 0) == told.ever) return "never measured iff never measured";
    if (v.state != POSE_WALL_HELD) return "";
    if (told.gave_up) return "held after it was given up";
    if (v.value != told.last_live && !(told.has_valid && v.value == told.last_valid)) return "held, and never told";
    if (told.was_held && v.protection_level < told.held_level) return "surer while held";
    return "";
  }

  static void take(const pose_wall_value& v, Told* told) {
    told->was_held = v.state == POSE_WALL_HELD;
    told->held_level = v.protection_level;
    if (is_live(v)) {
      told->ever = true;
      told->last_live = v.value;
    }
    if (v.state == POSE_WALL_VALID) {
      told->has_valid = true;
      told->last_valid = v.value;
    }
    told->gave_up = v.state == POSE_WALL_INVALID;
  }

  ContractLimits limits_;
  Told told_[POSE_WALL_QUANTITIES];
  std::uint64_t frames_ = 0;
};

}  // namespace pose_wall::test

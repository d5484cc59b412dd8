// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Planar scans and poses by the bytes of an input: a hall with rough walls, seen from a machine that drives in it, or
// garbage.

#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>

#include "fuzz/fuzz_target.hpp"
#include "fuzz/garbage_from_input.hpp"
#include "pose_wall_planar_types.h"

namespace pose_wall::test {

constexpr std::uint32_t kBeamsMax = 256;  // more cost the fuzzer its rounds

// Walls at -length to length and -width to width about the origin of map.
struct Hall {
  double half_length_m = 9.0, half_width_m = 2.5, rough_m = 0.1;
  std::uint64_t rock = 1;
};

inline Hall hall_by(Input* input) {
  Hall hall;
  hall.half_length_m = input->between(2.0, 25.0);
  hall.half_width_m = input->between(1.0, 6.0);
  hall.rough_m = input->between(0.0, 0.4);
  hall.rock = input->byte();
  return hall;
}

// Relief in steps of 0.2 m along a wall.
inline double relief_m(const Hall& hall, std::uint32_t wall, double along_m) {
  const auto step = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(along_m / 0.2)) + 100000);
  return hall.rough_m * static_cast<double>(share_of(scramble(hall.rock * 7919 + wall * 104729 + step)));
}

inline double range_in(const Hall& hall, const pose_wall_planar_pose& from, double angle_rad) {
  const double cosine = std::cos(from.yaw_rad + angle_rad), sine = std::sin(from.yaw_rad + angle_rad);
  const double x_m = cosine > 0 ? hall.half_length_m : -hall.half_length_m;
  const double y_m = sine > 0 ? hall.half_width_m : -hall.half_width_m;
  const double to_end_m = std::fabs(cosine) > 1e-9 ? (x_m - from.x_m) / cosine : 1e9;
  const double to_side_m = std::fabs(sine) > 1e-9 ? (y_m - from.y_m) / sine : 1e9;
  const bool side = to_side_m < to_end_m;
  const double range_m = side ? to_side_m : to_end_m;
  const std::uint32_t wall = side ? (sine > 0 ? 2U : 3U) : (cosine > 0 ? 0U : 1U);
  const double along_m = side ? from.x_m + range_m * cosine : from.y_m + range_m * sine;
  return range_m + relief_m(hall, wall, along_m);
}

struct ScanOfInput {
  pose_wall_planar_scan scan;
  float range_m[kBeamsMax], free_m[kBeamsMax];
  bool is_hall;  // else garbage
};

// Beams as scanners have them.
inline void begin_scan(Input* input, ScanOfInput* out) {
  std::memset(&out->scan, 0, sizeof out->scan);
  out->scan.struct_size = sizeof out->scan;
  out->scan.beams = 90 + input->below(kBeamsMax - 89);
  out->scan.angle_min_rad = -3.1;
  out->scan.angle_step_rad = 6.2 / out->scan.beams;
  out->scan.range_min_m = 0.1;
  out->scan.range_max_m = 30.0;
  out->scan.sigma_m = 0.02;
  out->scan.range_m = out->range_m;
}

inline void see_hall(const Hall& hall, const pose_wall_planar_pose& base, ScanOfInput* out) {
  for (std::uint32_t k = 0; k < out->scan.beams; ++k) {
    out->range_m[k] = static_cast<float>(range_in(hall, base, out->scan.angle_min_rad + k * out->scan.angle_step_rad));
  }
  out->is_hall = true;
}

inline void see_garbage(Input* input, ScanOfInput* out) {
  const std::uint8_t how = input->byte();
  const std::uint64_t seed = std::uint64_t{input->byte()} << 32U;
  const float infinite = std::numeric_limits<float>::infinity();
  for (std::uint32_t k = 0; k < out->scan.beams; ++k) {
    const std::uint64_t chance = scramble(seed + k);
    float& range_m = out->range_m[k];
    if (how % 6U == 0U) range_m = float_of(chance);
    if (how % 6U == 1U) range_m = 15.0F * (1.0F + share_of(chance));
    if (how % 6U == 2U) range_m = infinite;
    if (how % 6U == 3U) range_m = std::numeric_limits<float>::quiet_NaN();
    if (how % 6U == 4U) range_m = 5.0F;
    if (how % 6U == 5U) range_m = input->take<float>();
  }
  out->is_hall = false;
}

// Some beams become any bits; the angles, the ranges' limits or the place of the scanner anything.
inline void damage_scan(Input* input, ScanOfInput* out) {
  const std::uint8_t how = input->byte();
  pose_wall_planar_scan& scan = out->scan;
  if ((how & 1U) != 0) {
    const std::uint32_t every = 1 + input->below(32);
    for (std::uint32_t k = 0; k < scan.beams; k += every) out->range_m[k] = float_of(scramble(k + every));
  }
  if ((how & 2U) != 0) {
    for (std::uint32_t k = 0; k < kBeamsMax; ++k) out->free_m[k] = float_of(scramble(k));
    scan.free_m = out->free_m;
  }
  if ((how & 4U) != 0) scan.angle_step_rad = input->take<double>();
  if ((how & 8U) != 0) scan.angle_min_rad = input->take<double>();
  if ((how & 16U) != 0) scan.range_max_m = input->between(0.0, 1100.0);
  if ((how & 32U) != 0) scan.sensor = {input->between(-3, 3), input->between(-3, 3), input->between(-4, 4)};
  if ((how & 64U) != 0) scan.sigma_m = input->between(0.0, 1.1);
  if ((how & 128U) != 0) scan.beams = input->below(kBeamsMax);
  if (how != 0) out->is_hall = false;
}

inline pose_wall_planar_pose any_pose(Input* input) {
  pose_wall_planar_pose pose;
  pose.x_m = input->take<double>();
  pose.y_m = input->take<double>();
  pose.yaw_rad = input->take<double>();
  return pose;
}

inline bool is_finite(const pose_wall_planar_pose& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad);
}
inline bool is_none(const pose_wall_planar_pose& pose) {
  return std::isnan(pose.x_m) && std::isnan(pose.y_m) && std::isnan(pose.yaw_rad);
}
inline bool is_result(const pose_wall_planar_pose& pose) {
  return is_finite(pose) && pose.yaw_rad > -3.1415926536 && pose.yaw_rad < 3.1415926536;
}

}  // namespace pose_wall::test

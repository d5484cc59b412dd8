// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Roads, garbage and configs by the bytes of an input: small numbers, from which the machinery of tests/digest makes
// thousands of points.

#pragma once

#include <string>

#include "fuzz/fuzz_target.hpp"

extern "C" {
#include "roadway.h"
}

namespace pose_wall::test {

struct KeyAndText {
  const char *key, *text;
};

// Of a contract; see support/contract.hpp.
inline void require_kept(const std::string& broken) {
  require(broken.empty(), broken.c_str());
}

// The largest scanner that an input can ask for has to fit; scan_road asserts it.
constexpr std::uint32_t kRoadPointsMax = 8192;

inline float (*road_points())[3] {
  static float points[kRoadPointsMax][3];
  return points;
}

// A frame of it, into road_points(). Returns how many points.
inline std::uint32_t scan_road(const roadway& road, std::uint32_t frame) {
  require(road.scanner.turns * (road.scanner.lines == 0 ? 1 : road.scanner.lines) <= kRoadPointsMax, "a small scanner");
  return roadway_scan(&road, frame, road_points());
}

inline roadway plain_road() {
  roadway road{};
  road.name = "plain";
  road.scanner = {14, 300, {-0.1317, 0.1317}};
  road.half_width_m = 2.5;
  road.height_m = 3.2;
  road.face_x_m = 12.0;
  road.noise_m = 0.01;
  road.sensor_z_m = 1.4;
  return road;
}

inline box box_by(Input* input) {
  const double x = input->between(-10.0, 10.0), y = input->between(-4.0, 4.0), z = input->between(0.0, 3.0);
  return {{x, x + input->between(0.05, 8.0)}, {y, y + input->between(0.05, 3.0)}, {z, z + input->between(0.05, 3.0)}};
}

// From a plain one to one that is hardly a road; whatever the bytes, the machine stands in it.
inline roadway road_by(Input* input) {
  roadway road = plain_road();
  const std::uint8_t with = input->byte();
  road.half_width_m = input->between(0.6, 6.0);
  road.height_m = input->between(1.6, 6.0);
  road.face_x_m = input->between(1.0, 40.0);
  road.sensor_y_m = road.half_width_m * input->between(-0.8, 0.8);
  road.sensor_z_m = road.height_m * input->between(0.1, 0.9);
  road.yaw_t = input->between(-0.5, 0.5);
  if ((with & 1U) != 0) road.rough_m = input->between(0.0, 0.3);
  if ((with & 2U) != 0) road.steel_m = input->between(0.0, 0.3);
  if ((with & 4U) != 0) road.noise_m = input->between(0.0, 0.1);
  if ((with & 8U) != 0) {
    const double from = input->between(-10.0, 10.0);
    road.door_x = {from, from + input->between(0.0, 6.0)};
  }
  if ((with & 16U) != 0) {
    road.roll_t = input->between(-0.3, 0.3);
    road.pitch_t = input->between(-0.3, 0.3);
  }
  if ((with & 32U) != 0) road.mount_yaw_t = input->between(-1.0, 1.0);
  if ((with & 64U) != 0) {
    const std::uint32_t lines = input->below(33);  // 0: every ray by chance
    road.scanner.lines = lines;
    road.scanner.turns = lines == 0 ? 6000 : 6400 / lines;
    road.scanner.elevation_t = {input->between(-0.41, 0.0), input->between(0.05, 0.41)};
  }
  if ((with & 128U) != 0) {
    road.box_count = input->below(ROADWAY_BOXES_MAX + 1);
    for (std::uint32_t i = 0; i < road.box_count; ++i) road.boxes[i] = box_by(input);
  }
  road.step_m = input->between(0.0, 0.5);
  return road;
}

}  // namespace pose_wall::test

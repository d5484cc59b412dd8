// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Clouds of a sensor on a mast in the middle of a wide hall: all around the machine is seen, and is free.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "frames/frame.hpp"
#include "live/live_frame.hpp"

namespace pose_wall::test {

struct Post {
  double x_m = 0.0, y_m = 0.0, radius_m = 0.2;
};

// The sensor stands 2.5 m above the floor, which is at z 0 of base; walls are 20 m off. number: clouds of two numbers
// differ by a millimetre. post: a round thing from the floor to the roof.
inline std::shared_ptr<tools::live::LiveFrame> hall_frame(std::int64_t stamp_ns, int number,
                                                          const Post* post = nullptr) {
  constexpr int kRings = 128, kColumns = 1024;
  constexpr double kHeight_m = 2.5, kRoof_m = 4.0, kWall_m = 20.0;
  std::vector<std::array<float, 4>> points;
  points.reserve(kRings * kColumns);
  for (int ring = 0; ring < kRings; ++ring) {
    for (int column = 0; column < kColumns; ++column) {
      const double elevation = (-80.0 + 95.0 * ring / (kRings - 1)) * M_PI / 180.0;
      const double azimuth = 2.0 * M_PI * column / kColumns;
      const double flat = std::cos(elevation);
      const double x = flat * std::cos(azimuth), y = flat * std::sin(azimuth), z = std::sin(elevation);
      double range = kWall_m / std::max({std::abs(x), std::abs(y), 1e-9});
      range = std::min(range, z < 0.0 ? kHeight_m / -z : kRoof_m / std::max(z, 1e-9));
      if (post != nullptr) {
        const double along = (post->x_m * x + post->y_m * y) / (flat * flat);
        const double aside = (post->x_m * y - post->y_m * x) / flat;
        if (along > 0.0 && std::abs(aside) < post->radius_m) range = std::min(range, along - post->radius_m);
      }
      range += 0.001 * (number % 7) / 7.0;
      points.push_back(
          {static_cast<float>(range * x), static_cast<float>(range * y), static_cast<float>(range * z), 9});
    }
  }
  tools::Bytes bytes(points.size() * sizeof points[0]);
  std::memcpy(bytes.data(), points.data(), bytes.size());
  tools::PointLayout layout;
  layout.count = static_cast<std::uint32_t>(points.size());
  layout.point_step = sizeof points[0];
  layout.fields = {
      {"x", {0, POSE_WALL_FIELD_FLOAT32}}, {"y", {4, POSE_WALL_FIELD_FLOAT32}}, {"z", {8, POSE_WALL_FIELD_FLOAT32}}};
  auto frame = std::make_shared<tools::live::LiveFrame>();
  frame->frame = tools::describe_frame(std::move(bytes), layout);
  frame->stamp_ns = stamp_ns + 7;
  frame->frame.cloud.stamp_ns = stamp_ns;
  return frame;
}

// The settings that fit: a small machine that is slow enough for what the sensor sees.
inline std::vector<std::string> hall_settings(const std::string& mode = "map") {
  return {"planar=" + mode,         "extrinsic_z=2.5",   "range_max=60",     "planar_x_min=-0.6",
          "planar_x_max=0.6",       "planar_y_min=-0.6", "planar_y_max=0.6", "planar_speed_max=0.3",
          "planar_turn_max_deg=10", "planar_scan_time=0"};
}

}  // namespace pose_wall::test

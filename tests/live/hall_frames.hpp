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

#include "apps/live/live_frame.hpp"
#include "io/frames/frame.hpp"

namespace pose_wall::test {

struct Post {
  double x_m = 0.0, y_m = 0.0, radius_m = 0.2;
};

// Round things from the floor to the roof, and where base stands.
struct Hall {
  std::vector<Post> posts;
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  double wall_m = 20.0;       // of the hall's middle, to all four sides
  double lowest_deg = -80.0;  // ray of the sensor

  // Along a level direction from base to the first thing.
  double range_m(double azimuth_rad) const {
    const double dx = std::cos(azimuth_rad + yaw_rad), dy = std::sin(azimuth_rad + yaw_rad);
    const auto to_wall = [this](double at, double step) {
      return std::abs(step) < 1e-9 ? 1e9 : ((step > 0.0 ? wall_m : -wall_m) - at) / step;
    };
    double range = std::min(to_wall(x_m, dx), to_wall(y_m, dy));
    for (const Post& post : posts) {
      const double px = post.x_m - x_m, py = post.y_m - y_m;
      const double along = px * dx + py * dy, aside = px * dy - py * dx;
      if (along <= 0.0 || std::abs(aside) >= post.radius_m) continue;
      range = std::min(range, along - std::sqrt(post.radius_m * post.radius_m - aside * aside));
    }
    return range;
  }
};

// The sensor stands 2.5 m above the floor, which is at z 0 of base. number: clouds of two numbers differ by a
// millimetre.
inline std::shared_ptr<tools::live::LiveFrame> hall_frame(std::int64_t stamp_ns, int number, const Hall& hall = {},
                                                          int rings = 128) {
  constexpr int kColumns = 1024;
  constexpr double kHeight_m = 2.5, kRoof_m = 4.0;
  std::vector<std::array<float, 4>> points;
  points.reserve(static_cast<std::size_t>(rings) * kColumns);
  for (int column = 0; column < kColumns; ++column) {
    const double azimuth = 2.0 * M_PI * column / kColumns, level_m = hall.range_m(azimuth);
    for (int ring = 0; ring < rings; ++ring) {
      const double elevation = (hall.lowest_deg + (15.0 - hall.lowest_deg) * ring / (rings - 1)) * M_PI / 180.0;
      const double flat = std::cos(elevation), z = std::sin(elevation);
      double range = std::min(level_m / flat, z < 0.0 ? kHeight_m / -z : kRoof_m / std::max(z, 1e-9));
      // Noise that never repeats: of what does, the guard of freshness says that it is old.
      range += 0.001 * std::fmod(0.618034 * number + 0.754878 * column + 0.569840 * ring, 1.0);
      points.push_back({static_cast<float>(range * flat * std::cos(azimuth)),
                        static_cast<float>(range * flat * std::sin(azimuth)), static_cast<float>(range * z), 9});
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

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Mounts that mines have: a sensor at the front edge of the machine or in the middle of its roof, there on a mast, too.
// The machine shades rays, and the settings have its height.

#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "planar/encounter/plans.hpp"

namespace pose_wall::test {

struct Mount {
  std::string name;  // sensor, place, height in m, degrees of nose down: os0_32-front-1.35-10
  Sensor sensor;
};

inline Mount mount_of(Pattern pattern, bool is_upside_down, bool is_at_front, double z_m, int down_deg) {
  constexpr double kDegree_rad = 3.14159265358979 / 180.0, kHalfTurn_rad = 3.14159265;
  constexpr double kBehindEdge_m = 0.25;  // the sensor's own foot
  const Machine machine;
  Mount mount;
  char name[64];
  (void)std::snprintf(name, sizeof(name), "%s%s-%s-%.2f-%d", row_of(pattern).name, is_upside_down ? "_down" : "",
                      is_at_front ? "front" : "middle", z_m, down_deg);
  mount.name = name;
  constexpr std::uint32_t kColumnsMost = 600;  // some more than the stop has steps of azimuth: frames are cast sooner
  mount.sensor =
      Sensor(pattern, is_at_front ? machine.front_m - kBehindEdge_m : 0.0, z_m, is_upside_down ? kHalfTurn_rad : 0.0,
             down_deg * kDegree_rad, kHalfTurn_rad + 0.01, std::min(row_of(pattern).columns, kColumnsMost));
  constexpr double kBody_m = 1.0;  // the roof, 0.2 m below the lowest sensor
  mount.sensor.body_m = {machine.back_m, machine.front_m, -machine.half_m, machine.half_m, 0.0, kBody_m};
  return mount;
}

// Those whose names hold this.
inline std::vector<Mount> mounts_named(const std::string& part) {
  std::vector<Mount> mounts;
  const auto add = [&](Pattern pattern, bool is_upside_down) {
    for (const bool is_at_front : {true, false}) {
      constexpr double kMast_m = 2.2;
      for (const double z_m : {1.2, 1.35, 1.5, 1.6, kMast_m}) {
        if (is_at_front && z_m == kMast_m) continue;  // nobody has a mast at the edge
        for (const int down_deg : {0, 10, 15, 20}) {
          Mount mount = mount_of(pattern, is_upside_down, is_at_front, z_m, down_deg);
          if (mount.name.find(part) != std::string::npos) mounts.push_back(std::move(mount));
        }
      }
    }
  };
  for (int k = 0; k < static_cast<int>(Pattern::patterns); ++k) add(static_cast<Pattern>(k), false);
  add(Pattern::mid360, true);
  return mounts;
}

// The machine ends a decimetre above its sensor, and the settings have as much clearance.
inline pose_wall_planar_stop_settings settings_of(const Mount& mount) {
  pose_wall_planar_stop_settings settings = encounter_settings();
  constexpr double kHousing_m = 0.1, kClearance_m = 0.1;
  settings.top_m = mount.sensor.z_m + kHousing_m + kClearance_m;
  return settings;
}

inline void put_on(const Mount& mount, Plan* plan) {
  const double noise_m = plan->sensor.noise_m, dropout = plan->sensor.dropout;
  plan->sensor = mount.sensor;
  plan->sensor.noise_m = noise_m, plan->sensor.dropout = dropout;
  plan->machine.top_m = mount.sensor.z_m + 0.1;
}

}  // namespace pose_wall::test

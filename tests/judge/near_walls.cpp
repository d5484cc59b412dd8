// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/near_walls.hpp"

#include <algorithm>
#include <cmath>

#include "judge/text.hpp"
#include "judge/trial.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::judge {
namespace {

constexpr double kOtherWall_m = 2.3, kRoof_m = 3.0;
constexpr double kRough_m = 0.006, kLongest_m = 1.5, kHurst = 0.7;  // the middle of what furnished roads have
constexpr double kFace_m = 25.0, kBack_m = -25.0;
constexpr double kTurned_rad = 1.5 * kRadPerDeg;  // along no ring's own direction

Road road_of(const NearWall& where, Draw* draw) {
  Road road;
  road.width_m = where.wall_m + kOtherWall_m;
  road.height_m = kRoof_m;
  road.floor = {Vector3d::UnitZ(), 0.0};
  road.left = {-Vector3d::UnitY(), where.wall_m};
  road.right = {Vector3d::UnitY(), kOtherWall_m};
  const auto add = [&](const Vector3d& normal, double offset_m, const Vector3d& along) {
    const Rock rock = where.rough ? Rock(draw, kRough_m, kLongest_m, kHurst) : Rock();
    road.panels.emplace_back(-offset_m * normal, normal, along, -1e3, 1e3, rock);
  };
  add(road.floor.normal, road.floor.offset_m, Vector3d::UnitX());
  add(-Vector3d::UnitZ(), kRoof_m, Vector3d::UnitX());
  add(road.left.normal, road.left.offset_m, Vector3d::UnitX());
  add(road.right.normal, road.right.offset_m, Vector3d::UnitX());
  add(-Vector3d::UnitX(), kFace_m, Vector3d::UnitY());
  add(Vector3d::UnitX(), -kBack_m, Vector3d::UnitY());
  return road;
}

pose_wall_result measured(const NearWall& where, bool offsets) {
  Draw draw(20261127);  // a date
  const Road road = road_of(where, &draw);
  Machine machine;
  machine.base_height_m = where.height_m;
  const Sensor& sensor = sensor_at(where.sensor);
  Scanner scanner(sensor, true, &draw);
  if (!offsets) scanner.leave_out_offsets();
  Stance stance;
  stance.turned_left_rad = kTurned_rad;
  const Cloud cloud = scanner.sweep(road, machine, Passage(road, machine, stance, stance), 0, &draw);
  pose_wall_config config = test::config_with();
  read_settings(sensor.config, &config);
  for (const Setting& setting : settings_of(machine)) test::set(&config, setting.first.c_str(), setting.second.c_str());
  return test::EngineUnderTest(config).process(cloud.described(kPeriod_ns));
}

const char* surface(const NearWall& where) {
  return where.rough ? "rough" : "flat";
}

}  // namespace

std::vector<NearWall> near_walls_of(int sensor) {
  std::vector<NearWall> walls;
  for (const bool rough : {false, true}) {
    for (const double wall_m : kNearWalls_m) {
      for (const double height_m : kSensorHeights_m) walls.push_back({sensor, rough, wall_m, height_m});
    }
  }
  return walls;
}

std::vector<NearWall> every_near_wall() {
  std::vector<NearWall> walls;
  for (int row = 0; row < kAllSensors; ++row) {
    if (sensor_at(row).beams == nullptr) continue;
    for (const NearWall& wall : near_walls_of(row)) walls.push_back(wall);
  }
  return walls;
}

NearWalls try_near_walls(const std::vector<NearWall>& walls) {
  NearWalls found;
  for (const NearWall& where : walls) {
    const pose_wall_result with = measured(where, true), without = measured(where, false);
    NearWalls::Tried tried{where, {}};
    Lost lost{where, {}, 0};
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      tried.valid[0].at(q) = with.quantity[q].state == POSE_WALL_VALID;
      tried.valid[1].at(q) = without.quantity[q].state == POSE_WALL_VALID;
      if (tried.valid[0].at(q) || !tried.valid[1].at(q)) continue;
      if (lost.quantities.empty()) lost.reasons = with.quantity[q].reasons;
      lost.quantities.push_back(q);
    }
    found.tried.push_back(tried);
    if (!lost.quantities.empty()) found.lost.push_back(lost);
  }
  return found;
}

std::string Lost::text() const {
  std::string text =
      format("%s, %s, wall %.1f m, sensor %.1f m high: lost by the offsets:", sensor_at(where.sensor).name,
             surface(where), where.wall_m, where.height_m);
  for (const std::uint32_t q : quantities) text += std::string(" ") + pose_wall_quantity_name(q);
  text += ";";
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) text += std::string(" ") + pose_wall_reason_name(bit);
  }
  return text;
}

std::string NearWalls::text() const {
  std::string text;
  for (const Lost& each : lost) text += each.text() + "\n";
  text += format("heights of %zu on which all values are valid: with offsets, without\n%-14s %-6s",
                 kSensorHeights_m.size(), "", "wall");
  for (const double wall_m : kNearWalls_m) text += format(" %6.1f m", wall_m);
  for (int row = 0; row < kAllSensors; ++row) {
    for (const bool rough : {false, true}) {
      std::string cells;
      for (const double wall_m : kNearWalls_m) {
        std::array<int, 2> all{};
        bool any = false;
        for (const Tried& each : tried) {
          if (each.where.sensor != row || each.where.rough != rough || each.where.wall_m != wall_m) continue;
          any = true;
          for (std::size_t k = 0; k < 2; ++k) {
            all[k] += std::all_of(each.valid[k].begin(), each.valid[k].end(), [](bool it) { return it; }) ? 1 : 0;
          }
        }
        if (any) cells += format("  %2d, %2d", all[0], all[1]);
      }
      if (!cells.empty())
        text += format("\n%-14s %-6s%s", sensor_at(row).name, rough ? "rough" : "flat", cells.c_str());
    }
  }
  return text + "\n";
}

}  // namespace pose_wall::judge

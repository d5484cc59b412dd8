// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/check_setup.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lab/sim/pose.hpp"

namespace pose_wall::tools::sim {
namespace {

void demand(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("scene contradicts itself: ") + rule);
}

}  // namespace

constexpr double kHalfMachine_m = 0.3;  // at least so much room on each side of the machine's centre line

void demand_room(const Setup& setup, double side_choice, double reach_out_of_wall_m, const char* rule) {
  for (const int side : {1, -1}) {
    if (!has_side(side_choice, side)) continue;
    const double to_wall = 0.5 * setup.road.width_m - side * start_lateral_m(setup);
    demand(to_wall - reach_out_of_wall_m >= kHalfMachine_m, rule);
  }
}

void demand_room_for_the_machine(const Setup& setup) {
  const Objects& o = setup.objects;
  const Floor& f = setup.floor;
  demand_room(setup, f.bench_side, f.bench_width_m, "the machine stands on the bench (bench_width_m, lateral_m)");
  demand_room(setup, f.muck_side, f.muck_width_m, "the machine stands in the muck (muck_width_m, lateral_m)");
  demand_room(setup, o.conveyor_side, o.conveyor_standoff_m + o.conveyor_width_m,
              "the machine stands in the conveyor (conveyor_standoff_m, conveyor_width_m, lateral_m)");
  demand_room(setup, o.vehicle_side, o.vehicle_standoff_m + o.vehicle_width_m,
              "the machine stands in the vehicle (vehicle_standoff_m, vehicle_width_m, lateral_m)");
  demand_room(setup, o.prop_side, o.prop_standoff_m, "the machine stands in the props (prop_standoff_m, lateral_m)");
  demand_room(setup, o.curtain_side, 0.5 * setup.road.width_m - o.curtain_distance_m,
              "the machine stands in the curtain (curtain_distance_m, lateral_m)");
}

// Upright walls and a flat roof: an arch and leaning walls leave it less room, and a tilted machine moves it.
void demand_sensor_in_the_road(const Setup& setup) {
  const Machine& m = setup.machine;
  const Mount& mount = setup.mount;
  const double turned = m.turned_left_deg * kRadPerDeg;
  const Vector forward = forward_axis(m), left = Vector::UnitZ().cross(forward);
  const Vector mounted = lidar_origin_base(mount);
  const double left_m =
      start_lateral_m(setup) + std::sin(turned) * mounted.dot(forward) + std::cos(turned) * mounted.dot(left);
  for (const int side : {1, -1}) {
    demand(!has_side(setup.road.walls, side) || side * left_m < 0.5 * setup.road.width_m,
           "the sensor is in the rock beside the road (mount_x_m, mount_y_m, lateral_m, width_m)");
  }
  const double height_m = m.base_height_m + mounted.z();
  demand(height_m > 0.0 && (setup.road.roof == 0.0 || height_m < setup.road.height_m),
         "the sensor is in the rock above or below the road (mount_z_m, base_height_m, height_m)");
}

void demand_the_sensors_own_beams(const Sensor& sensor) {
  demand(sensor.elevation_min_deg < sensor.elevation_max_deg, "elevation_min_deg must be below elevation_max_deg");
  if (sensor.beams == nullptr) return;
  demand(sensor.rings == static_cast<double>(sensor.beams->lasers.size()) &&
             sensor.elevation_min_deg == sensor.beams->lowest_deg() &&
             sensor.elevation_max_deg == sensor.beams->highest_deg(),
         "a real sensor has its own rings and elevations (rings, elevation_min_deg, elevation_max_deg)");
}

const Setup& checked(const Setup& setup) {
  const Road& r = setup.road;
  const Machine& m = setup.machine;
  const bool leans = r.lean_left_deg != 0.0 || r.lean_right_deg != 0.0;
  const bool splays = r.splay_left_deg != 0.0 || r.splay_right_deg != 0.0;
  const bool curved = r.curve_radius_m != 0.0;
  const bool arched = r.arch_springing_m > 0.0;
  demand(!arched || !leans,
         "an arch (arch_springing_m) stands on upright walls: lean_left_deg and lean_right_deg must be 0");
  demand(!arched || !splays, "an arch (arch_springing_m) cannot splay: splay_left_deg and splay_right_deg must be 0");
  demand(!arched || r.arch_springing_m < r.height_m, "arch_springing_m must be below height_m");
  demand(!curved || !(arched || splays), "a curve (curve_radius_m) has a flat roof and no splay");
  demand(!curved || r.ramp_deg == 0.0, "a ramp (ramp_deg) leads along a straight road");
  demand(setup.openings.niche_side == static_cast<double>(kSideNone) ||
             setup.openings.niche_width_m < 0.5 * setup.openings.niche_pitch_m,
         "niches (niche_width_m) must be narrower than half of niche_pitch_m");
  demand(!curved || std::abs(r.curve_radius_m) > r.width_m, "curve_radius_m must exceed width_m");
  demand(setup.floor.muck_side == static_cast<double>(kSideNone) || setup.floor.muck_width_m < 0.5 * r.width_m,
         "muck_width_m must be below half of width_m");
  demand(r.roof == 0.0 || m.base_height_m < r.height_m, "base_height_m must be below height_m");
  const double first_along_m = pose_at(setup, frame_time_s(setup, 0)).along_m;
  demand(
      r.rear_distance_m == 0.0 || -first_along_m < r.rear_distance_m,
      "the machine drives in from behind the road's end: drive_in_m, in whole frames, must be below rear_distance_m");
  demand(std::abs(start_lateral_m(setup)) < 0.5 * r.width_m,
         "lateral_m, or near_distance_m, must leave the machine between the walls");
  demand_room_for_the_machine(setup);
  demand_sensor_in_the_road(setup);
  demand(setup.sequence.scan_s <= 1.0 / setup.sequence.rate_hz, "scan_s must not exceed 1 / rate_hz");
  demand_the_sensors_own_beams(setup.sensor);
  return setup;
}

}  // namespace pose_wall::tools::sim

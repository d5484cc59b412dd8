// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What scanners see in a network of roads: planar scans and clouds.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/sim/network.hpp"
#include "lab/sim/setup.hpp"
#include "lab/sim/simulator.hpp"

namespace pose_wall::tools::sim {

// Of the machine and of what is mounted at its middle. Yaw from x to y.
struct PlanePose {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  Place place() const { return {x_m, y_m}; }
};

struct PlanarSensor {
  int beams = 360;
  double field_deg = 360.0;  // a whole turn: from straight behind; less: the middle is ahead, both ends are beams
  double range_min_m = 0.1;
  double range_max_m = 30.0;
  double noise_m = 0.015;
  double dropout = 0.01;     // share of beams that give nothing at all
  double grazing_deg = 1.5;  // flatter than this gives nothing
  double quantum_m = 0.0;    // steps of the range; 0: none

  double angle_min_rad() const { return -0.5 * field_deg * kRadPerDeg; }
  double angle_step_rad() const {
    return field_deg * kRadPerDeg / (field_deg < 360.0 && beams > 1 ? beams - 1.0 : static_cast<double>(beams));
  }
};

// `ranges` has room for sensor.beams. A finite range: the first thing; plus infinity: nothing up to range_max_m; NaN:
// unknown. The same seed gives the same ranges.
void planar_scan(const Network& network, const PlanarSensor& sensor, const PlanePose& at, std::uint64_t seed,
                 float* ranges);
// Without noise and dropouts, whatever the sensor.
void true_scan(const Network& network, const PlanarSensor& sensor, const PlanePose& at, float* ranges);

// How a machine stands in space.
struct StandingPose {
  PlanePose at;
  double height_m = 1.4;                   // of the sensor above the floor's mean plane
  double roll_rad = 0.0, pitch_rad = 0.0;  // R = Rz(yaw) Ry(pitch) Rx(roll)
};

// Someone or something upright on the floor: a cylinder.
struct Pillar {
  Place at = Place::Zero();
  double radius_m = 0.2;
  double height_m = 1.75;
};

// What is not part of the network, for the moment of a frame.
struct CloudScene {
  std::vector<Pillar> pillars;
  // Walls in this circle give no return; 0: none.
  Place dark_at = Place::Zero();
  double dark_radius_m = 0.0;
  double dropout = 0.0;  // share of all beams that give no return
};

// A frame of one of sensor_models() in the network, x ahead, z up. The roads have flat floors and roofs with relief,
// and walls that are the same at every height.
Frame network_cloud(const Network& network, const Sensor& sensor, const StandingPose& pose, std::uint32_t frame_index,
                    std::uint64_t seed, const CloudScene& scene = {});

}  // namespace pose_wall::tools::sim

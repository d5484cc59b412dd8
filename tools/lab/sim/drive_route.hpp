// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A driver who keeps to a route, and whole drives: truth, odometry and scans of a machine under way in a network.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/sim/drive_tracks.hpp"
#include "lab/sim/network_scan.hpp"

namespace pose_wall::tools::sim {

// Aims at a point of the route ahead (pure pursuit), slows in bends, and turns on the spot between legs.
class RouteDriver {
 public:
  // The route must outlive it.
  RouteDriver(const Route& route, const TrackSettings& tracks, double speed_mps);

  TrackSpeeds command(const PlanePose& at);
  bool has_arrived() const { return leg_ >= route_.legs.size(); }

 private:
  Place aim(const PlanePose& at);

  const Route& route_;
  double turn_gauge_m_;  // the gauge at which the machine turns
  double speed_mps_;
  std::size_t leg_ = 0, nearest_ = 0;
  bool is_turning_ = true;
};

// Where the machine begins: at the route's first point, looking along it.
PlanePose start_of(const Route& route);

struct RunSettings {
  PlanarSensor sensor;
  TrackSettings tracks;
  double speed_mps = 0.5;
  double step_s = 0.05;
  double scan_every_m = 0.25;
  double scan_every_rad = 0.1;
};

struct RunStep {
  double time_s = 0.0;
  PlanePose truth;
  PlanePose odometry;
  double roll_rad = 0.0, pitch_rad = 0.0, height_m = 0.0;
};

struct NetworkRun {
  std::vector<RunStep> steps;          // every step of the drive
  std::vector<std::size_t> scan_step;  // of each scan: when it was taken
  std::vector<float> ranges;           // sensor.beams of each scan
  PlanarSensor sensor;
  double driven_m = 0.0;
  bool has_arrived = false;  // false: stuck, and given up

  std::size_t scans() const { return scan_step.size(); }
  const RunStep& at_scan(std::size_t i) const { return steps[scan_step[i]]; }
  const float* ranges_of(std::size_t i) const { return &ranges[i * static_cast<std::size_t>(sensor.beams)]; }
};

// The same network, route, settings and seed give the same bits.
NetworkRun drive(const Network& network, const Route& route, const RunSettings& settings, std::uint64_t seed);

}  // namespace pose_wall::tools::sim

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/drive_route.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr double kAim_m = 1.6;
constexpr double kArrived_m = 0.4;
// Turns on the spot from the first error on until the second is reached.
constexpr double kTurnFrom_rad = 0.9;
constexpr double kTurnUntil_rad = 0.12;
constexpr double kTurn_radps = 0.35;
// A bend of this radius is driven at half the speed.
constexpr double kSlowRadius_m = 3.0;
// How far the nearest point of the route can move on in a step.
constexpr std::size_t kAheadPoints = 12;
// A drive takes at most this many times as long as at full speed, and a minute for each turn on the spot.
constexpr double kPatience = 4.0;
constexpr double kPatienceTurn_s = 60.0;

PlanePose looking(const Place& from, const Place& to) {
  return {from.x(), from.y(), std::atan2(to.y() - from.y(), to.x() - from.x())};
}

}  // namespace

RouteDriver::RouteDriver(const Route& route, const TrackSettings& tracks, double speed_mps)
    : route_(route),
      turn_gauge_m_(tracks.gauge_m * tracks.turn_resistance / std::max(1.0 - tracks.slip, 0.1)),
      speed_mps_(speed_mps) {}

// The first point of the leg from the nearest one on that is far enough.
Place RouteDriver::aim(const PlanePose& at) {
  const std::vector<Place>& line = route_.legs[leg_].line;
  const std::size_t end = std::min(line.size(), nearest_ + kAheadPoints);
  for (std::size_t i = nearest_; i < end; ++i) {
    if ((line[i] - at.place()).squaredNorm() < (line[nearest_] - at.place()).squaredNorm()) nearest_ = i;
  }
  for (std::size_t i = nearest_; i < line.size(); ++i) {
    if ((line[i] - at.place()).norm() >= kAim_m) return line[i];
  }
  // Beyond the end, so that the last stretch is driven straight.
  const Place ahead = (line.back() - line[line.size() - 2]).normalized();
  return line.back() + kAim_m * ahead;
}

TrackSpeeds RouteDriver::command(const PlanePose& at) {
  while (!has_arrived()) {
    const std::vector<Place>& line = route_.legs[leg_].line;
    const Place ahead = (line.back() - line[line.size() - 2]).normalized();
    if (!(nearest_ + kAheadPoints >= line.size() && (line.back() - at.place()).dot(ahead) < kArrived_m)) break;
    ++leg_;
    nearest_ = 0;
    is_turning_ = true;
  }
  if (has_arrived()) return {};
  const Place to = aim(at) - at.place();
  const double c = std::cos(at.yaw_rad), s = std::sin(at.yaw_rad);
  const double ahead_m = c * to.x() + s * to.y(), left_m = c * to.y() - s * to.x();
  const double error_rad = std::atan2(left_m, ahead_m);
  is_turning_ = std::abs(error_rad) > (is_turning_ ? kTurnUntil_rad : kTurnFrom_rad);
  if (is_turning_) {
    // Slower towards the end of the turn.
    const double turn_radps = std::clamp(1.5 * error_rad, -kTurn_radps, kTurn_radps);
    return {-0.5 * turn_radps * turn_gauge_m_, 0.5 * turn_radps * turn_gauge_m_};
  }
  const double curvature_per_m = 2.0 * left_m / to.squaredNorm();
  const double speed_mps = speed_mps_ / (1.0 + kSlowRadius_m * std::abs(curvature_per_m));
  const double half_turn_mps = 0.5 * speed_mps * curvature_per_m * turn_gauge_m_;
  return {speed_mps - half_turn_mps, speed_mps + half_turn_mps};
}

PlanePose start_of(const Route& route) {
  if (route.legs.empty()) return {};
  const std::vector<Place>& line = route.legs.front().line;
  return looking(line[0], line[1]);
}

NetworkRun drive(const Network& network, const Route& route, const RunSettings& settings, std::uint64_t seed) {
  NetworkRun run;
  run.sensor = settings.sensor;
  TrackDrive machine(settings.tracks, &network, start_of(route), seed);
  RouteDriver driver(route, settings.tracks, settings.speed_mps);
  const double time_max_s =
      kPatience * route.length_m / settings.speed_mps + kPatienceTurn_s * static_cast<double>(route.legs.size());
  const auto beams = static_cast<std::size_t>(settings.sensor.beams);
  double scan_at_m = 0.0, scan_at_rad = 0.0;
  while (machine.time_s() < time_max_s) {
    run.steps.push_back({machine.time_s(), machine.truth(), machine.odometry(), machine.roll_rad(), machine.pitch_rad(),
                         machine.height_m()});
    const TrackSpeeds command = driver.command(machine.truth());
    run.has_arrived = driver.has_arrived();
    if (machine.driven_m() >= scan_at_m || machine.turned_rad() >= scan_at_rad || run.has_arrived) {
      scan_at_m = machine.driven_m() + settings.scan_every_m;
      scan_at_rad = machine.turned_rad() + settings.scan_every_rad;
      run.ranges.resize(run.ranges.size() + beams);
      planar_scan(network, settings.sensor, machine.truth(), mix(seed ^ 0x5ca9u) + run.scans(),
                  &run.ranges[run.ranges.size() - beams]);
      run.scan_step.push_back(run.steps.size() - 1);
    }
    if (run.has_arrived) break;
    machine.step(command, settings.step_s);
  }
  run.driven_m = machine.driven_m();
  return run;
}

}  // namespace pose_wall::tools::sim

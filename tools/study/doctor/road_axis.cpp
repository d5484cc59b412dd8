// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/road_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "io/numbers/angles.hpp"
#include "study/doctor/statistics.hpp"
#include "study/doctor/trial.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr double kNoWall_m = std::numeric_limits<double>::quiet_NaN();
// Below this the walls are seen in less than every third frame, or one of them alone in less than two thirds.
constexpr double kScoreMin = 0.3;
constexpr double kAmbiguousShare = 0.7;

struct Direction {
  RoadAxis road;
  double yaw_rad = 0.0;
};

// Half a point for each wall, a little more where the engine trusts it.
double score_of(const Trial& trial) {
  double score = 0.0;
  for (const bool left : {true, false}) {
    const std::uint32_t front = left ? POSE_WALL_D_LF : POSE_WALL_D_RF;
    score += 0.45 * trial.wall_measured(left) + 0.05 * std::max(trial.valid(front), trial.valid(front + 1));
  }
  return score;
}

void take_walls(const Trial& trial, Direction& direction) {
  std::vector<double> yaws, sigmas, lefts, rights, distance_sigmas;
  for (const pose_wall_result& r : trial.results()) {
    const pose_wall_value& yaw = r.quantity[POSE_WALL_YAW];
    if (!is_measured(yaw)) continue;
    yaws.push_back(yaw.raw);
    sigmas.push_back(yaw.sigma);
    const bool left = is_measured(r.quantity[POSE_WALL_D_LF]) || is_measured(r.quantity[POSE_WALL_D_LB]);
    const bool right = is_measured(r.quantity[POSE_WALL_D_RF]) || is_measured(r.quantity[POSE_WALL_D_RB]);
    if (left) lefts.push_back(std::fabs(r.left.d_m));
    if (right) rights.push_back(std::fabs(r.right.d_m));
    const std::uint32_t front = left ? POSE_WALL_D_LF : POSE_WALL_D_RF;
    if (is_measured(r.quantity[front])) distance_sigmas.push_back(r.quantity[front].sigma);
  }
  RoadAxis& road = direction.road;
  road.is_found = !yaws.empty();
  if (yaws.empty()) return;
  direction.yaw_rad = median(yaws);
  road.azimuth_spread_rad = spread90(yaws);
  road.azimuth_sigma_rad = median(sigmas);
  road.left_m = lefts.empty() ? kNoWall_m : median(lefts);
  road.right_m = rights.empty() ? kNoWall_m : median(rights);
  road.distance_spread_m = std::max(lefts.empty() ? 0.0 : spread90(lefts), rights.empty() ? 0.0 : spread90(rights));
  road.distance_sigma_m = distance_sigmas.empty() ? 0.0 : median(distance_sigmas);
}

// Base turned by `turn_deg` about +Z, the road looked for along its forward axis.
Direction try_direction(const api::Config& config, const char* forward_axis, double turn_deg,
                        const std::vector<KeptFrame>& frames, std::size_t frames_max) {
  api::Config turned = config;
  turned.set("forward_axis", forward_axis);
  turned.set("extrinsic_yaw", std::remainder(config.number("extrinsic_yaw") + turn_deg / kDegPerRad, 2.0 * M_PI));
  const Trial trial(turned, frames, frames_max);
  Direction direction;
  direction.road.score = score_of(trial);
  take_walls(trial, direction);
  const double axis_rad = forward_axis[1] == 'X' ? 0.0 : 0.5 * M_PI;
  direction.road.azimuth_base_rad = axis_rad + direction.yaw_rad - turn_deg / kDegPerRad;
  return direction;
}

// Nearest of the lines X and Y, and of the road's two directions the one that points along it.
void name_line(RoadAxis& road) {
  const double azimuth = std::remainder(road.azimuth_base_rad, M_PI);  // in [-90, 90] degrees
  road.line = std::fabs(azimuth) <= 0.25 * M_PI ? 'X' : 'Y';
  const double line_rad = road.line == 'X' ? 0.0 : 0.5 * M_PI;
  road.off_line_rad = std::remainder(azimuth - line_rad, M_PI);
  const double named_rad = line_rad + road.off_line_rad;
  if (std::cos(named_rad - road.azimuth_base_rad) < 0.0) std::swap(road.left_m, road.right_m);
  road.azimuth_base_rad = named_rad;
}

bool is_across(const RoadAxis& a, const RoadAxis& b) {
  return std::fabs(std::remainder(a.azimuth_base_rad - b.azimuth_base_rad, M_PI)) > 0.25 * M_PI;
}

}  // namespace

RoadAxis look_along_road(const api::Config& config, const std::vector<KeptFrame>& frames, std::size_t frames_max) {
  std::vector<Direction> tried = {try_direction(config, "+X", 0.0, frames, frames_max),
                                  try_direction(config, "+Y", 0.0, frames, frames_max)};
  // A road between the axes: the engine refuses what stands 45 degrees to its forward axis, or nearly so.
  const bool between = std::all_of(tried.begin(), tried.end(), [](const Direction& direction) {
    return direction.road.score < 0.5 || std::fabs(direction.yaw_rad) * kDegPerRad > 30.0;
  });
  if (between) {
    tried.push_back(try_direction(config, "+X", 45.0, frames, frames_max));
    tried.push_back(try_direction(config, "+Y", 45.0, frames, frames_max));
  }
  // Where two see the same road, the one that it lies nearer to.
  const auto better = [](const Direction& a, const Direction& b) {
    if (std::fabs(a.road.score - b.road.score) > 0.05) return a.road.score > b.road.score;
    return std::fabs(a.yaw_rad) < std::fabs(b.yaw_rad);
  };
  RoadAxis best = std::min_element(tried.begin(), tried.end(), better)->road;
  for (const Direction& direction : tried) {
    if (is_across(direction.road, best)) best.rival_score = std::max(best.rival_score, direction.road.score);
  }
  best.is_found = best.is_found && best.score >= kScoreMin;
  best.is_ambiguous = best.is_found && best.rival_score >= kAmbiguousShare * best.score;
  name_line(best);
  return best;
}

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Logs of CARMEN of a machine in a drawn room, whose poses are known.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools::test {

// A line FLASER of 180 beams over half a turn. Robot at `at`, scanner offset_m ahead of it; range_m(scanner,
// angle_rad).
template <typename Range>
std::string flaser_line(const Range& range_m, const std::string& stamp, const pose_wall_planar_pose& at,
                        double offset_m = 0.0) {
  constexpr double kHalfTurn_rad = 3.14159265358979323846;
  const pose_wall_planar_pose laser{at.x_m + offset_m * std::cos(at.yaw_rad), at.y_m + offset_m * std::sin(at.yaw_rad),
                                    at.yaw_rad};
  std::string text = "FLASER 180";
  for (int beam = 0; beam < 180; ++beam) {
    text += fmt::format(" {:.3f}", range_m(laser, (beam - 90) * kHalfTurn_rad / 180.0));
  }
  for (const auto& pose : {laser, at}) text += fmt::format(" {:.6f} {:.6f} {:.6f}", pose.x_m, pose.y_m, pose.yaw_rad);
  return text + " " + stamp + " host 0.1\n";
}

// A room of 12 x 8 m with a pillar, seen from inside by 180 beams over half a turn.
struct DrawnRoom {
  static double range_m(const pose_wall_planar_pose& at, double angle_rad) {
    const double c = std::cos(at.yaw_rad + angle_rad);
    const double s = std::sin(at.yaw_rad + angle_rad);
    double range_m = 1e9;
    const auto wall = [&](double place, double from, double along) {
      const double t = along == 0.0 ? -1.0 : (place - from) / along;
      if (t > 0.0) range_m = std::min(range_m, t);
    };
    wall(8.0, at.x_m, c);
    wall(-4.0, at.x_m, c);
    wall(5.0, at.y_m, s);
    wall(-3.0, at.y_m, s);
    // A round pillar of 0.5 m at (3, 2).
    const double dx = 3.0 - at.x_m;
    const double dy = 2.0 - at.y_m;
    const double nearest = dx * c + dy * s;
    const double beside_2 = dx * dx + dy * dy - nearest * nearest;
    if (nearest > 0.0 && beside_2 < 0.25) range_m = std::min(range_m, nearest - std::sqrt(0.25 - beside_2));
    return range_m;
  }

  // Robot at `at`, scanner offset_m ahead of it.
  static std::string line(const std::string& stamp, const pose_wall_planar_pose& at, double offset_m = 0.0) {
    return flaser_line(range_m, stamp, at, offset_m);
  }

  // Scan `number` of a drive along a bend, 0.1 m a scan.
  static pose_wall_planar_pose pose(int number) {
    const double angle_rad = 0.05 * number;
    return {2.0 * std::sin(angle_rad), 2.0 - 2.0 * std::cos(angle_rad), angle_rad};
  }
  static std::string stamp(int number) { return fmt::format("9760528{:02}.4{:05}", number / 10, number % 10); }

  // The same scans again and again, under stamps that rise.
  static std::string long_log(int scans) {
    constexpr int kDrawn = 126;  // once round
    std::vector<std::string> drawn;
    for (int k = 0; k < kDrawn; ++k) drawn.push_back(line("{}", pose(k)));
    std::string text;
    for (int k = 0; k < scans; ++k) text += fmt::format(fmt::runtime(drawn[static_cast<std::size_t>(k % kDrawn)]), k);
    return text;
  }

  static std::string log(int scans, double offset_m = 0.0) {
    std::string text = "# made for a test\n";
    for (int k = 0; k < scans; ++k) text += line(stamp(k), pose(k), offset_m);
    return text;
  }
};

// A chamber of 12 x 7 m with a niche, a slanted wall and a pillar: no two places of it look alike.
struct DrawnChamber {
  static double range_m(const pose_wall_planar_pose& at, double angle_rad) {
    constexpr double kWalls[][4] = {{-6, -3.5, 6, -3.5},  {6, -3.5, 6, 1},       {6, 1, 4.5, 1},    {4.5, 1, 4.5, 3.5},
                                    {4.5, 3.5, -2, 3.5},  {-2, 3.5, -2, 5},      {-2, 5, -4, 5},    {-4, 5, -4, 3.5},
                                    {-4, 3.5, -4.5, 3.5}, {-4.5, 3.5, -6, -3.5}, {-1, -1, 0, -1.4}, {0, -1.4, 0, -0.4},
                                    {0, -0.4, -1, -1}};
    double range_m = 1e9;
    const double c = std::cos(at.yaw_rad + angle_rad), s = std::sin(at.yaw_rad + angle_rad);
    for (const auto& wall : kWalls) {
      const double ex = wall[2] - wall[0], ey = wall[3] - wall[1], det = c * ey - s * ex;
      if (std::abs(det) < 1e-12) continue;
      const double dx = wall[0] - at.x_m, dy = wall[1] - at.y_m;
      const double t = (dx * ey - dy * ex) / det, u = (dx * s - dy * c) / det;
      if (t > 0 && u >= 0 && u <= 1) range_m = std::min(range_m, t);
    }
    return range_m;
  }
  // Round in it, 0.075 m a scan.
  static pose_wall_planar_pose pose(int number) {
    const double angle_rad = 0.05 * number;
    return {2.0 + 1.5 * std::sin(angle_rad), -1.5 * std::cos(angle_rad), angle_rad};
  }
  static std::string log(int scans) {
    std::string text;
    for (int k = 0; k < scans; ++k) text += flaser_line(range_m, DrawnRoom::stamp(k), pose(k));
    return text;
  }
};

}  // namespace pose_wall::tools::test

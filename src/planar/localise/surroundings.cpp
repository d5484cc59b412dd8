// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/surroundings.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::planar {

void Surroundings::lay_out(Arena& arena) {
  PatchedPoints::lay_out(arena, kSurroundingsMost);
  room = arena.take<ScanPoint>(kSurroundingsMost);
  sights = arena.take<ScanPoint>(kSightsMost);
}

void Surroundings::take(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m, double scan_sigma_m) {
  const std::uint32_t count = std::min(kSurroundingsMost, scan_points.size());
  std::copy(scan_points.begin(), scan_points.begin() + count, room.begin());
  sort(room.first(count), scan_sigma_m);
  take_sights(scan_points, origin_m);
}

void Surroundings::take_sights(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m) {
  const std::uint32_t stride = (scan_points.size() + kSightsMost - 1) / kSightsMost;
  sight_count = 0;
  for (std::uint32_t k = 0; k < scan_points.size(); k += stride) sights[sight_count++] = scan_points[k];
  sight_from = {static_cast<float>(origin_m.x()), static_cast<float>(origin_m.y())};
}

double seen_through(const PlaceMap& map, const Surroundings& around, const Pose2& pose) {
  constexpr double kStep_m = 0.5 * kSurfaceCell_m;  // no cell is stepped over
  // A line ends so far before its wall, and this share of its range more: a wall met at a low angle.
  constexpr double kBefore_m = 0.5, kBefore = 0.05;
  constexpr std::uint32_t kStepsMost = 600;  // 30 m: the cost of a line has a bound
  constexpr std::uint32_t kFirst = 6;        // steps: 0.3 m, where the machine itself may have been mapped
  constexpr std::uint32_t kHitsLeast = 2;    // steps within surfaces: a corner that is grazed is no wall
  std::uint32_t through = 0;
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = turn * as_double(around.sight_from) + pose.place() - map.middle_m();
  for (std::uint32_t k = 0; k < around.sight_count; ++k) {
    const Eigen::Vector2d way = turn * (as_double(around.sights[k]) - as_double(around.sight_from));
    const double range_m = way.norm(), end_m = range_m * (1.0 - kBefore) - kBefore_m;
    if (!(end_m > kStep_m)) continue;
    const Eigen::Vector2d unit = way / range_m;
    const std::uint32_t steps = std::min(kStepsMost, static_cast<std::uint32_t>(end_m / kStep_m));
    std::uint32_t hits = 0;
    for (std::uint32_t i = kFirst; i <= steps && hits < kHitsLeast; ++i) {
      const Eigen::Vector2d p = place + unit * (kStep_m * i);
      hits += map.is_surface(p.x(), p.y()) ? 1U : 0U;
    }
    through += hits >= kHitsLeast ? 1U : 0U;
  }
  return around.sight_count > 0 ? static_cast<double>(through) / around.sight_count : 0.0;
}

namespace {

void find_walls(const Surroundings& around, const Turn2& turn, Span<PatchWall> walls) {
  std::fill(walls.begin(), walls.end(), PatchWall{});
  for (std::uint32_t k = 0; k < around.points.size(); ++k) {
    if (around.patch[k] == kPatchesMost) continue;
    const ScanPoint& point = around.points[k];
    walls[around.patch[k]].points.add(point.x_m - std::floor(point.x_m), point.y_m - std::floor(point.y_m));
  }
  for (std::uint32_t at = 0; at < around.patches; ++at) {
    SurfaceSums sums;
    sums.add(walls[at].points, 0.0, 0.0);
    const Surface wall = sums.surface(0.0, 0.0);
    const Eigen::Vector2d along =
        turn * Eigen::Vector2d(static_cast<double>(wall.normal_y), -static_cast<double>(wall.normal_x));
    walls[at].along_x = static_cast<float>(along.x());
    walls[at].along_y = static_cast<float>(along.y());
  }
}

void move_along_walls(const PlaceMap& map, const Surroundings& around, const Turn2& turn, const Eigen::Vector2d& place,
                      Span<PatchWall> walls) {
  constexpr double kShift_m = 0.4;  // a bump of rock and its hollow; README.md
  const double noise_m2 = around.sigma_m * around.sigma_m;
  for (std::uint32_t k = 0; k < around.points.size(); ++k) {
    if (around.patch[k] == kPatchesMost) continue;
    PatchWall& own = walls[around.patch[k]];
    const Eigen::Vector2d p = turn * as_double(around.points[k]) + place;
    const Eigen::Vector2d shift =
        kShift_m * Eigen::Vector2d(static_cast<double>(own.along_x), static_cast<double>(own.along_y));
    bool seen = false;
    own.ahead += static_cast<float>(cost_of(map, p + shift, noise_m2, &seen));
    own.behind += static_cast<float>(cost_of(map, p - shift, noise_m2, &seen));
  }
}

}  // namespace

std::uint32_t relief_patches(const PlaceMap& map, const Surroundings& around, const Pose2& pose,
                             Span<PatchWall> walls) {
  const Turn2 turn(pose.yaw_rad);
  find_walls(around, turn, walls);
  PatchCosts costs;
  judge_patches(map, around, pose, &costs);
  move_along_walls(map, around, turn, pose.place() - map.middle_m(), walls);
  constexpr double kWorse = 0.4;  // noise makes less of it
  std::uint32_t count = 0;
  for (std::uint32_t at = 0; at < around.patches; ++at) {
    if (!around.is_judged(at)) continue;
    const double here = costs.cost[at] * (kCostMost / 255.0);
    const double moved = static_cast<double>(std::min(walls[at].ahead, walls[at].behind)) / around.in_patch[at];
    if (moved > here + kWorse) ++count;
  }
  return count;
}

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/surveyed.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "judge/text.hpp"

namespace pose_wall::judge {
namespace {

// Coarser than the simulator's probes, as far: what both find must not hang on the grid.
constexpr double kStep_m = 0.08, kFarthest_m = 30.0;
// The definition's regions: surveyed.hpp.
constexpr double kFloorAlong_m = 3.0, kFloorAcross_m = 1.1, kWallAlong_m = 2.5, kWallLow_m = 0.25, kWallHigh_m = 2.5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double rock_m(const Road& road, const Ray& ray) {
  double nearest_m = kFarthest_m;
  for (const Panel& panel : road.panels) nearest_m = panel.hit_m(ray, nearest_m);
  return nearest_m < kFarthest_m ? nearest_m : kNone;
}

// Which way probes go from a plane about the machine, and how far it reaches.
struct Region {
  Vector3d middle_m, along, across, out;
  double half_along_m, low_m, high_m;
};

// The plane that lies within a width of most of the hits: the width in which a half of them lies about the road's own
// plane, which the judge knows; then Tukey's weights, whose influence ends at 4.685 of its standard deviations.
std::optional<Plane> fit(const Road& road, const Region& region, const Plane& ideal) {
  std::vector<Vector3d> hits;
  int sent = 0;
  for (double a = -region.half_along_m; a <= region.half_along_m; a += kStep_m) {
    for (double b = region.low_m; b <= region.high_m; b += kStep_m, ++sent) {
      const Ray ray = {region.middle_m + a * region.along + b * region.across, region.out};
      const double at_m = rock_m(road, ray);
      if (std::isfinite(at_m)) hits.emplace_back(a, b, at_m);
    }
  }
  // The end of a crosscut is no wall of this road.
  std::vector<double> depths;
  for (const Vector3d& hit : hits) depths.push_back(hit.z());
  const double deepest_m = quantile(depths, 0.1) + 3.0;
  hits.erase(std::remove_if(hits.begin(), hits.end(), [&](const Vector3d& hit) { return hit.z() > deepest_m; }),
             hits.end());
  if (2 * static_cast<int>(hits.size()) < sent) return std::nullopt;
  const double slant = -ideal.normal.dot(region.out);
  Vector3d plane(ideal.distance_m(region.middle_m), ideal.normal.dot(region.along), ideal.normal.dot(region.across));
  plane /= slant;
  const auto off = [&](const Vector3d& hit) { return hit.z() - plane.dot(Vector3d(1.0, hit.x(), hit.y())); };
  std::vector<double> offs;
  for (const Vector3d& hit : hits) offs.push_back(off(hit));
  plane.x() += quantile(offs, 0.5);
  for (std::size_t k = 0; k < hits.size(); ++k) offs[k] = std::abs(off(hits[k]));
  const double width_m = 4.685 * std::max(1.4826 * quantile(offs, 0.5), 0.02);
  int near = 0;
  for (int round = 0; round < 30; ++round) {
    Matrix3d squares = Matrix3d::Zero();
    Vector3d sums = Vector3d::Zero();
    near = 0;
    for (const Vector3d& hit : hits) {
      const double share = off(hit) / width_m;
      if (std::abs(share) >= 1.0) continue;
      ++near;
      const Vector3d row(1.0, hit.x(), hit.y());
      const double weight = std::pow(1.0 - share * share, 2.0);
      squares += weight * row * row.transpose();
      sums += weight * hit.z() * row;
    }
    plane = squares.ldlt().solve(sums);
  }
  if (2 * near < sent || !plane.allFinite()) return std::nullopt;
  Plane found;
  found.normal = (plane.y() * region.along + plane.z() * region.across - region.out).normalized();
  found.offset_m = -found.normal.dot(region.middle_m + plane.x() * region.out);
  return found;
}

}  // namespace

Truth surveyed_truth(const Road& road, const Machine& machine, const Pose& pose) {
  Truth truth;
  truth.low.fill(kNone), truth.high.fill(kNone);
  const Vector3d up = Vector3d::UnitZ();
  const Vector3d forward = pose.turn * machine.base_from_machine.col(0);
  const Vector3d level = (forward - forward.z() * up).normalized();
  const auto floor = fit(
      road, {pose.position_m, level, up.cross(level), -up, kFloorAlong_m, -kFloorAcross_m, kFloorAcross_m}, road.floor);
  if (!floor) return truth;
  Road found = road;
  found.floor = *floor;
  const Vector3d ahead = (forward - forward.dot(floor->normal) * floor->normal).normalized();
  const Vector3d left = floor->normal.cross(ahead);
  const double height_m = floor->distance_m(pose.position_m);
  const auto wall = [&](double side, const Plane& ideal) {
    return fit(road,
               {pose.position_m, ahead, floor->normal, side * left, kWallAlong_m, kWallLow_m - height_m,
                kWallHigh_m - height_m},
               ideal);
  };
  const auto left_wall = wall(1.0, road.left), right_wall = wall(-1.0, road.right);
  if (left_wall) found.left = *left_wall;
  if (right_wall) found.right = *right_wall;
  if (!left_wall && right_wall) found.left = {-right_wall->normal, 0.0};  // for yaw: by the other wall alone
  if (!right_wall && left_wall) found.right = {-left_wall->normal, 0.0};
  truth = truth_of(found, machine, pose);
  for (std::size_t k = 0; k < 2; ++k) {
    if (!left_wall) truth.low[POSE_WALL_D_LF + k] = truth.high[POSE_WALL_D_LF + k] = kNone;
    if (!right_wall) truth.low[POSE_WALL_D_RF + k] = truth.high[POSE_WALL_D_RF + k] = kNone;
  }
  if (!left_wall && !right_wall) truth.low[POSE_WALL_YAW] = truth.high[POSE_WALL_YAW] = kNone;
  return truth;
}

}  // namespace pose_wall::judge

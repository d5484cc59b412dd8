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
// The regions of include/DEFINITIONS.md.
constexpr double kFloorAcross_m = 1.125, kWallAlong_m = 2.5, kWallLow_m = 0.25, kWallHigh_m = 2.5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double rock_m(const Road& road, const Ray& ray) {
  double nearest_m = kFarthest_m;
  for (const Panel& panel : road.panels) nearest_m = panel.hit_m(ray, nearest_m);
  return nearest_m < kFarthest_m ? nearest_m : kNone;
}

// Which way probes go from a plane about the machine, and how far it reaches.
struct Region {
  Vector3d middle_m, along, across, out;
  double from_m, to_m, low_m, high_m;  // along, ahead and behind; across
};

struct Hit {
  double along_m, across_m, out_m;
};

// h = x + y along + z across, and the definition's sums over the hits.
struct Surface {
  Vector3d plane;
  double weights = 0.0, loss = 0.0;
};

double share_off(const Hit& hit, const Vector3d& plane) {
  return hit.out_m - plane.dot(Vector3d(1.0, hit.along_m, hit.across_m));
}

// Least squares through the hits that count, then Cauchy's weights of an ever smaller width down to the definition's.
template <typename Counts>
Surface settle(const std::vector<Hit>& hits, double width_m, const Counts& counts) {
  constexpr double kWidth_m = 0.15, kBefore = 4.0;  // c and k of include/DEFINITIONS.md
  constexpr int kRounds = 80;
  Surface out;
  for (int round = 0; round <= kRounds; ++round) {
    Matrix3d squares = Matrix3d::Zero();
    Vector3d sums = Vector3d::Zero();
    out.weights = out.loss = 0.0;
    for (const Hit& hit : hits) {
      if (round == 0 && !counts(hit)) continue;
      const double off = round == 0 ? 0.0 : share_off(hit, out.plane) / width_m;
      const double parts = 1.0 + (off < 0.0 ? kBefore : 1.0) * off * off;
      const Vector3d row(1.0, hit.along_m, hit.across_m);
      squares += row * row.transpose() / parts;
      sums += hit.out_m * row / parts;
      out.weights += 1.0 / parts;
      out.loss += std::log(parts);
    }
    if (round == kRounds) break;  // the sums are those of the plane as it is
    out.plane = squares.ldlt().solve(sums);
    if (round > 0) width_m = std::max(width_m / std::sqrt(2.0), kWidth_m);
  }
  return out;
}

// The plane of a region by include/DEFINITIONS.md.
std::optional<Plane> fit(const Road& road, const Region& region) {
  std::vector<Hit> hits;
  int sent = 0;
  for (double a = -region.to_m; a <= region.to_m; a += kStep_m) {
    if (std::abs(a) < region.from_m) continue;
    for (double b = region.low_m; b <= region.high_m; b += kStep_m, ++sent) {
      const Ray ray = {region.middle_m + a * region.along + b * region.across, region.out};
      const double at_m = rock_m(road, ray);
      if (std::isfinite(at_m)) hits.push_back({a, b, at_m});
    }
  }
  // What ends 3 m behind the nearest tenth is seen through an opening.
  std::vector<double> depths_m;
  for (const Hit& hit : hits) depths_m.push_back(hit.out_m);
  const double deepest_m = quantile(depths_m, 0.1) + 3.0;
  hits.erase(std::remove_if(hits.begin(), hits.end(), [&](const Hit& hit) { return hit.out_m > deepest_m; }),
             hits.end());
  if (2 * static_cast<int>(hits.size()) < sent) return std::nullopt;
  const double middle_m = 0.5 * (region.low_m + region.high_m);
  const Surface surfaces[] = {
      settle(hits, 2.0, [](const Hit&) { return true; }),
      settle(hits, 0.15, [](const Hit& h) { return h.along_m < 0.0; }),
      settle(hits, 0.15, [](const Hit& h) { return h.along_m > 0.0; }),
      settle(hits, 0.15, [=](const Hit& h) { return h.across_m < middle_m; }),
      settle(hits, 0.15, [=](const Hit& h) { return h.across_m > middle_m; }),
      settle(hits, 0.15, [&](const Hit& h) { return std::abs(h.along_m) > 0.5 * (region.from_m + region.to_m); })};
  const Surface* best = nullptr;
  for (const Surface& surface : surfaces) {
    if (surface.plane.allFinite() && (best == nullptr || surface.loss < best->loss)) best = &surface;
  }
  if (best == nullptr || 2.0 * best->weights < sent) return std::nullopt;
  Plane found;
  found.normal = (best->plane.y() * region.along + best->plane.z() * region.across - region.out).normalized();
  found.offset_m = -found.normal.dot(region.middle_m + best->plane.x() * region.out);
  return found;
}

}  // namespace

Truth surveyed_truth(const Road& road, const Machine& machine, const Pose& pose, const FloorRegion& region) {
  Truth truth;
  truth.low.fill(kNone), truth.high.fill(kNone);
  const Vector3d up = Vector3d::UnitZ();
  const Vector3d forward = pose.turn * machine.base_from_machine.col(0);
  const Vector3d level = (forward - forward.z() * up).normalized();
  const auto floor = fit(road, {pose.position_m, level, up.cross(level), -up, region.from_m, region.to_m,
                                -kFloorAcross_m, kFloorAcross_m});
  if (!floor) return truth;
  Road found = road;
  found.floor = *floor;
  const Vector3d ahead = (forward - forward.dot(floor->normal) * floor->normal).normalized();
  const Vector3d left = floor->normal.cross(ahead);
  const double height_m = floor->distance_m(pose.position_m);
  const auto wall = [&](double side) {
    return fit(road, {pose.position_m, ahead, floor->normal, side * left, 0.0, kWallAlong_m, kWallLow_m - height_m,
                      kWallHigh_m - height_m});
  };
  const auto left_wall = wall(1.0), right_wall = wall(-1.0);
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

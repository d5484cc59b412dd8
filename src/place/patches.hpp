// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Points of one surface err alike, so evidence is counted in patches of a square metre, never in points. The patches
// belong to the points, not to the place: two places are compared patch by patch.

#pragma once

#include <cstdint>

#include "place/fit.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kPatchesMost = 128;     // a road of 5 m seen over 50 m of both walls, with a quarter to spare
constexpr std::uint32_t kPatchPointsLeast = 3;  // patches with fewer points say nothing

// Points by their patches, and the room that this takes.
struct PatchedPoints {
  Span<const ScanPoint> points;
  Span<std::uint8_t> patch;      // of each point; kPatchesMost: of none
  Span<std::uint32_t> in_patch;  // points of each patch
  std::uint32_t patches = 0;
  double sigma_m = 0.0;  // of a point about its surface

  void lay_out(Arena& arena, std::uint32_t points_most);
  // Keeps the span, and sorts it.
  void sort(Span<const ScanPoint> from, double noise_m);
  bool is_judged(std::uint32_t at) const { return in_patch[at] >= kPatchPointsLeast; }
};

// The mean cost of each patch: squared residuals over their variance, 9 at most. 255 stands for 9.
struct PatchCosts {
  std::uint8_t cost[kPatchesMost];
};
// A surface ends there: the cells that it is made of reach 0.15 m from their middle, and a point lies up to a cell off.
constexpr double kSurfaceEnd_m = 0.25;
constexpr double kCostMost = 9.0;    // three sigmas: what lies farther off is no nearer to another place
constexpr double kCostUnseen = 4.5;  // a new surface is no contradiction, and no agreement

struct PatchVerdict {
  double cost = 0.0;         // sum over patches
  double fits = 0.0;         // share of the seen patches that fit at the level of noise
  std::uint32_t seen = 0;    // patches in seen parts
  std::uint32_t judged = 0;  // patches with enough points
};

// Sums over the points of each patch.
struct PatchSums {
  float cost[kPatchesMost] = {};
  std::uint32_t seen[kPatchesMost] = {};
};
PatchVerdict verdict_of(const PatchedPoints& view, const PatchSums& sums, PatchCosts* costs);

// Of one point; seen: whether the map knows its place.
template <typename Map>
double cost_of(const Map& map, const Eigen::Vector2d& p, double noise_m2, bool* seen) {
  const Surface* const surface = map.near(p.x(), p.y());
  *seen = true;
  if (surface != nullptr) {
    const double dx = p.x() - static_cast<double>(surface->x_m), dy = p.y() - static_cast<double>(surface->y_m);
    if (dx * dx + dy * dy < kSurfaceEnd_m * kSurfaceEnd_m) {
      const double across = static_cast<double>(surface->normal_x) * dx + static_cast<double>(surface->normal_y) * dy;
      const double cost = across * across / (noise_m2 + static_cast<double>(surface->across_m2));
      return cost < kCostMost ? cost : kCostMost;
    }
  }
  *seen = map.is_seen(p.x(), p.y());
  return *seen ? kCostMost : kCostUnseen;
}

template <typename Map>
PatchVerdict judge_patches(const Map& map, const PatchedPoints& view, const Pose2& pose, PatchCosts* costs) {
  PatchSums sums;
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - map.middle_m();
  for (std::uint32_t k = 0; k < view.points.size(); ++k) {
    const std::uint32_t at = view.patch[k];
    if (at == kPatchesMost) continue;
    bool seen = false;
    const Eigen::Vector2d p = turn * as_double(view.points[k]) + place;
    sums.cost[at] += static_cast<float>(cost_of(map, p, view.sigma_m * view.sigma_m, &seen));
    sums.seen[at] += seen ? 1U : 0U;
  }
  return verdict_of(view, sums, costs);
}

// By how many of its standard errors the mean patch fits worse at `other`.
double worse_by(const PatchedPoints& view, const PatchCosts& best, const PatchCosts& other);

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "floor/search.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "base/estimation/mlesac.hpp"
#include "base/math/elementary.hpp"
#include "floor/notes.hpp"

namespace pose_wall {
namespace {

constexpr double kTriangleMin_m2 = 0.10;  // twice the area of the three points: slivers give wild normals
constexpr std::uint32_t kDrawsPerIteration = 8;

// One of the low points, or of all.
std::uint32_t drawn(const FloorDraw& in, bool of_low, Random* random) {
  return of_low ? in.low[random->below(in.low.size())] : random->below(in.open_base.count);
}

// Half from the low points, half from all, so that a floor counts as a whole even where the machine leans and the
// lowest points are one side of it only.
void fill_subset(const FloorDraw& in, Random* random, PointSet* subset) {
  for (std::uint32_t k = 0; k < kFloorSubset; ++k) {
    const std::uint32_t i = drawn(in, k % 2 == 0, random);
    subset->x[k] = in.open_base.x[i];
    subset->y[k] = in.open_base.y[i];
    subset->z[k] = in.open_base.z[i];
  }
  subset->count = kFloorSubset;
}

// The plane through three drawn points, normal up; false for slivers.
bool draw_plane(const FloorDraw& in, bool of_low, Random* random, Plane* plane) {
  const Eigen::Vector3d a = in.open_base.at(drawn(in, of_low, random));
  const Eigen::Vector3d b = in.open_base.at(drawn(in, of_low, random));
  const Eigen::Vector3d c = in.open_base.at(drawn(in, of_low, random));
  const Eigen::Vector3d cross = (b - a).cross(c - a);
  const double area = std::sqrt(cross.squaredNorm());
  if (!(area >= kTriangleMin_m2)) return false;
  plane->n = cross.z() >= 0.0 ? Eigen::Vector3d(cross / area) : Eigen::Vector3d(cross / -area);
  plane->d = -plane->n.dot(a);
  return true;
}

}  // namespace

FloorLimits::FloorLimits(const Settings& settings)
    : up_min(cosine(radians(settings.ground_tilt_max_deg))),
      height_min_m(settings.ground_height_min),
      height_max_m(settings.ground_height_max) {}

bool may_be_floor(const Plane& plane, const FloorLimits& limits, const Eigen::Vector3d& sensor_base_m) {
  const double height_m = plane.signed_distance(sensor_base_m);
  return plane.n.z() >= limits.up_min && height_m >= limits.height_min_m && height_m <= limits.height_max_m;
}

bool same_floor(const Plane& a, const Plane& b) {
  constexpr double kReach_m = 2.0;
  constexpr double kApart_m = 0.08;
  const double places[][2] = {{0.0, 0.0}, {kReach_m, 0.0}, {-kReach_m, 0.0}, {0.0, kReach_m}, {0.0, -kReach_m}};
  for (const auto& p : places) {
    const double za = -(a.n.x() * p[0] + a.n.y() * p[1] + a.d) / a.n.z();
    const double zb = -(b.n.x() * p[0] + b.n.y() * p[1] + b.d) / b.n.z();
    if (!(std::fabs(za - zb) <= kApart_m)) return false;
  }
  return true;
}

std::uint32_t search_floor(const FloorDraw& in, const Settings& settings, Random* random, PointSet* subset,
                           FloorShortlist* list) {
  list->clear();
  if (in.low.size() < 3) return 0;
  fill_subset(in, random, subset);
  const double thresh_m = settings.ground_ransac_thresh;
  const FloorLimits limits(settings);
  std::uint32_t scored = 0;
  const auto score = [&](const Plane& plane) {
    list->offer({plane, truncated_cost(*subset, plane, thresh_m, list->too_much())}, same_floor);
    ++scored;
  };
  if (in.last_floor != nullptr) score(*in.last_floor);
  const std::uint32_t draws = settings.ground_iterations * kDrawsPerIteration;
  POSE_WALL_NOTE(BestOutside outside(*subset, settings, in.sensor_base_m));
  for (std::uint32_t draw = 0; draw < draws && scored < settings.ground_iterations; ++draw) {
    Plane plane;
    // Every other draw from all points: where reflections lie lowest, the low points hold no floor.
    if (!draw_plane(in, draw % 2 == 0, random, &plane)) continue;
    POSE_WALL_NOTE(outside.offer(plane));
    if (may_be_floor(plane, limits, in.sensor_base_m)) score(plane);
  }
  POSE_WALL_NOTE(outside.note());
  return scored;
}

}  // namespace pose_wall

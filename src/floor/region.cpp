// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "floor/region.hpp"

#include <cmath>

#include "base/math/rotation.hpp"
#include "gates/gate.hpp"

namespace pose_wall {
namespace {

constexpr double kAlong_m = 3.0, kAcross_m = 1.125;  // of the definition, in whole cells
constexpr double kNearest_m = 0.2;                   // below base: what is nearer is the machine
// Half the second derivative: a ramp of 11 degrees that begins over 2 m.
constexpr double kBend_per_m = 0.05;
// Of the cells that lie ahead and of those behind, the lesser share that is seen: a ramp ahead says nothing of the
// ground that the machine stands on.
constexpr double kSeenAtEnds = 0.3;
constexpr double kStep_m = 0.3;  // a floor that lies higher or lower by more is another one: a bench, a deck

Region region_of(const FloorScene& scene, const Plane& floor) {
  Region region;
  const Eigen::Vector3d& ahead = scene.axes.forward_base;
  region.u = (ahead - floor.n * floor.n.dot(ahead)).normalized();
  region.v = floor.n.cross(region.u);
  region.h = -floor.n;
  region.u_min_m = -kAlong_m;
  region.u_max_m = kAlong_m;
  region.v_min_m = -kAcross_m;
  region.v_max_m = kAcross_m;
  region.h_min_m = kNearest_m;
  region.sensor_m = scene.sensor_base_m;
  region.bend_per_m = kBend_per_m;
  return region;
}

}  // namespace

void measure_floor_region(const FloorScene& scene, FloorScratch* scratch, FloorResult* floor) {
  const Settings& s = scene.settings;
  if (floor->fit.refused) return;
  if (scratch->work.stops()) {
    demand_work_left(scratch->work, &floor->fit);
    return;
  }
  const Region region = region_of(scene, floor->fit.plane);
  const RegionPlane found = scratch->region.fit(scene.cloud_base, region, s, &scratch->patches.waves(), &scratch->work);
  if (!found.is_there() || !(found.seen_at_ends >= kSeenAtEnds) ||
      !(std::fabs(found.at[0] - floor->fit.plane.d) < kStep_m))
    return;
  FloorResult taken = *floor;
  taken.fit.reasons &= ~static_cast<std::uint32_t>(POSE_WALL_R_FLOOR_AMBIGUOUS);  // of what lies elsewhere
  taken.fit.plane = found.plane_in(region);
  taken.area_m2 = found.area_m2;
  taken.roi_radius_m = kAlong_m;
  const RollPitchGradients gradients(taken.fit.plane.n);
  const auto set = [&](const Eigen::Vector3d& gradient, double* sigma_rad, ProtectionParts* bound_rad) {
    const Eigen::Vector3d of(0.0, gradient.dot(region.u), gradient.dot(region.v));
    *sigma_rad = found.sigma(of);
    *bound_rad = found.bound(of, s.range_bias_max);
  };
  set(gradients.roll, &taken.roll_sigma_rad, &taken.roll_bound_rad);
  set(gradients.pitch, &taken.pitch_sigma_rad, &taken.pitch_bound_rad);
  taken.dof = found.dof;
  if (protections_of(taken, s).worse() < protections_of(*floor, s).worse()) *floor = taken;
}

}  // namespace pose_wall

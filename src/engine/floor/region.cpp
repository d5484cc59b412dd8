// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/floor/region.hpp"

#include <cmath>

#include "base/math/rotation.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

constexpr double kAcross_m = 1.125;  // of the definition, in whole cells
constexpr double kNearest_m = 0.2;   // below base: what is nearer is the machine
// How steep the floor may have become against the machine's where the region ends: 17 degrees, as a ramp begins; and
// half the second derivative across, a camber of 6 cm over the lane.
constexpr double kRamp = 0.3, kCamber_per_m = 0.05;
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
  region.u_from_m = scene.settings.floor_region_min;
  region.u_to_m = scene.settings.floor_region_max;
  region.v_min_m = -kAcross_m;
  region.v_max_m = kAcross_m;
  region.h_min_m = kNearest_m;
  region.sensor_m = scene.sensor_base_m;
  region.bend_per_m = {0.5 * kRamp / region.u_to_m, kCamber_per_m};
  return region;
}

Eigen::Vector3d of(const Eigen::Vector3d& gradient, const Region& region) {
  return {0.0, gradient.dot(region.u), gradient.dot(region.v)};
}

FloorResult floor_of(const Region& region, const RegionPlane& found, const Settings& s, const FloorResult& before) {
  FloorResult floor = before;
  floor.fit.reasons &= ~static_cast<std::uint32_t>(POSE_WALL_R_FLOOR_AMBIGUOUS);  // of what lies elsewhere
  floor.fit.plane = found.plane_in(region);
  floor.area_m2 = found.area_m2;
  floor.roi_radius_m = region.u_to_m;
  const RollPitchGradients gradients(floor.fit.plane.n);
  const auto set = [&](const Eigen::Vector3d& gradient, double* sigma_rad, ProtectionParts* bound_rad) {
    *sigma_rad = found.sigma(of(gradient, region));
    *bound_rad = found.bound(of(gradient, region), s.range_bias_max);
  };
  set(gradients.roll, &floor.roll_sigma_rad, &floor.roll_bound_rad);
  set(gradients.pitch, &floor.pitch_sigma_rad, &floor.pitch_bound_rad);
  floor.dof = found.dof;
  return floor;
}

// An endless floor as that of the region. Further on the region has other waves.
void widen_by_waves(const Region& region, const RegionPlane& found, FloorResult* floor) {
  const RollPitchGradients gradients(floor->fit.plane.n);
  const auto widen = [&](const Eigen::Vector3d& gradient, double* sigma_rad, double* waves_rad) {
    *waves_rad = found.sigma_about_endless(of(gradient, region));
    *sigma_rad = with_waves(*sigma_rad, *waves_rad);
  };
  widen(gradients.roll, &floor->roll_sigma_rad, &floor->roll_waves_rad);
  widen(gradients.pitch, &floor->pitch_sigma_rad, &floor->pitch_waves_rad);
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
  if (!found.found || found.is_none() || !(found.seen_at_ends >= kSeenAtEnds)) return;
  widen_by_waves(region, found, floor);
  const FloorResult near = floor_of(region, found, s, *floor);
  const RollPitch at = roll_pitch_of_up(floor->fit.plane.n), to = roll_pitch_of_up(near.fit.plane.n);
  const Protections before = protections_of(*floor, s), known = protections_of(near, s);
  const bool both_agree = agree({at.roll_rad, before.roll_rad}, {to.roll_rad, known.roll_rad}) &&
                          agree({at.pitch_rad, before.pitch_rad}, {to.pitch_rad, known.pitch_rad});
  const bool is_same = std::fabs(found.at[0] - floor->fit.plane.d) < kStep_m;
  if (found.is_there() && is_same) {
    if (both_agree && !(known.worse() < before.worse())) return;
    *floor = near;
    POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_FLOOR));
    POSE_WALL_NOTE(trace::answered(POSE_WALL_TRACE_DOUBTS));
    return;
  }
  // Most of it may be no floor, or another one. Then either plane may be the right one.
  floor->reach_to_rival(std::fabs(at.roll_rad - to.roll_rad) + known.roll_rad,
                        std::fabs(at.pitch_rad - to.pitch_rad) + known.pitch_rad);
}

}  // namespace pose_wall

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

// Roll or pitch by one plane.
struct Angle : AngleErrors {
  double rad = 0.0;
  bool of_endless = false;

  Angle() = default;
  Angle(double angle_rad, const AngleErrors& errors) : AngleErrors(errors), rad(angle_rad) {}
  // The level holds that angle as well.
  void reach_to(const Angle& other, const Settings& s) {
    bound_rad[POSE_WALL_PART_RIVAL] += larger(std::fabs(rad - other.rad) - level_rad(s), 0.0);
  }
};

struct Angles {
  Angle roll, pitch;

  void reach_to(const Angles& other, const Settings& s) {
    roll.reach_to(other.roll, s);
    pitch.reach_to(other.pitch, s);
  }
};

Angles angles_of(const Region& region, const RegionPlane& found, const Settings& s) {
  const Eigen::Vector3d n = found.plane_in(region).n;
  const RollPitch at = roll_pitch_of_up(n);
  const RollPitchGradients gradients(n);
  const auto angle = [&](double rad, const Eigen::Vector3d& gradient) {
    const Eigen::Vector3d by = of(gradient, region);
    return Angle(rad, {found.sigma(by), found.dof, found.bound(by, s), found.sigma_about_endless(by)});
  };
  return {angle(at.roll_rad, gradients.roll), angle(at.pitch_rad, gradients.pitch)};
}

// The endless floor's angles as those of the region: the waves turn the region's about it.
Angles widened_by_waves(const FloorResult& endless, const Angles& region) {
  const RollPitch at = roll_pitch_of_up(endless.fit.plane.n);
  Angles out{{at.roll_rad, endless.roll}, {at.pitch_rad, endless.pitch}};
  const auto widen = [](const Angle& by, Angle* angle) {
    angle->of_endless = true;
    angle->waves_rad = by.waves_rad;
    angle->sigma_rad = with_waves(angle->sigma_rad, by.waves_rad);
  };
  widen(region.roll, &out.roll);
  widen(region.pitch, &out.pitch);
  return out;
}

// Of the region, by itself and predicted from the endless floor.
struct Planes {
  const RegionPlane &alone, &on_endless;
};

// What may be wrong with the endless floor moves what is predicted from it, as far as that follows it.
void reach_by_share(const Region& region, const Planes& planes, const FloorResult& endless, Angles* angles) {
  const RegionPlane& found = planes.on_endless;
  const RollPitchGradients gradients(found.plane_in(region).n);
  const double height_m = std::fabs(planes.alone.at[0] - endless.fit.plane.d);  // by as much as the region tells
  const Eigen::Vector3d roll = of(gradients.roll, region), pitch = of(gradients.pitch, region);
  Eigen::Matrix2d by_slopes;
  by_slopes << roll.tail<2>().transpose(), pitch.tail<2>().transpose();
  const Eigen::Matrix2d slopes = by_slopes.inverse();
  const auto reach = [&](const Eigen::Vector3d& by, ProtectionParts* bound_rad) {
    const Eigen::Vector2d share = slopes.transpose() * found.share_of_endless(by).tail<2>();
    ProtectionParts of_endless;
    of_endless.add(endless.roll.bound_rad, std::fabs(share[0]));
    of_endless.add(endless.pitch.bound_rad, std::fabs(share[1]));
    of_endless[POSE_WALL_PART_RANGE_BIAS] = 0.0;  // its response is known, with its sign
    of_endless[POSE_WALL_PART_BEND] += std::fabs(found.share_of_endless(by)[0]) * height_m;
    bound_rad->add(of_endless);
  };
  reach(roll, &angles->roll.bound_rad);
  reach(pitch, &angles->pitch.bound_rad);
}

bool rides_on(const Angles& endless, const Angles& region) {
  const auto may_be = [](const Angle& a, const Angle& b) {
    return may_be_waves(a.rad - b.rad, a.sigma_rad, b.sigma_rad);
  };
  return may_be(endless.roll, region.roll) && may_be(endless.pitch, region.pitch);
}

void take_narrower(const Angles& other, const Settings& s, Angles* best) {
  if (other.roll.level_rad(s) < best->roll.level_rad(s)) best->roll = other.roll;
  if (other.pitch.level_rad(s) < best->pitch.level_rad(s)) best->pitch = other.pitch;
}

struct Answers {
  Angles alone, endless;
};

// Of each angle the answer that is known best: by the region alone, by it on the endless floor, or by that floor.
Angles narrowest_of(const Region& region, const Planes& planes, const FloorResult& floor, const Answers& answers,
                    const Settings& s) {
  Angles best = answers.alone, endless = answers.endless;
  const bool rides = rides_on(endless, best);
  if (planes.alone.may_be_endless && !rides) {
    // Either is a plane of the region's cells, and no waves lead from one to the other.
    best.reach_to(answers.endless, s);
    endless.reach_to(answers.alone, s);
  }
  if (planes.on_endless.found && rides) {
    Angles predicted = angles_of(region, planes.on_endless, s);
    reach_by_share(region, planes, floor, &predicted);
    take_narrower(predicted, s, &best);
  }
  if (planes.alone.may_be_endless) take_narrower(endless, s, &best);
  return best;
}

void set(const Angles& angles, FloorResult* floor) {
  const AngleErrors &roll = angles.roll, &pitch = angles.pitch;
  floor->roll = roll;
  floor->pitch = pitch;
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
  RegionPlane by_endless;
  const RegionPlane found =
      scratch->region.fit(scene.cloud_base, region, s, &scratch->patches.waves(), &scratch->work,
                          over_region(region, floor->fit.plane, floor->frame, floor->uneven), &by_endless);
  if (!found.found || found.is_none() || !(found.seen_at_ends >= kSeenAtEnds)) return;
  const Angles near = angles_of(region, found, s);
  const Angles endless = widened_by_waves(*floor, near);
  const bool is_same = std::fabs(found.at[0] - floor->fit.plane.d) < kStep_m;
  if (!found.is_there() || !is_same) {
    // Most of it may be no floor, or another one. Then either plane may be the right one.
    set(endless, floor);
    floor->reach_to_rival(std::fabs(endless.roll.rad - near.roll.rad) + near.roll.level_rad(s),
                          std::fabs(endless.pitch.rad - near.pitch.rad) + near.pitch.level_rad(s));
    return;
  }
  const Angles best = narrowest_of(region, {found, by_endless}, *floor, {near, endless}, s);
  set(best, floor);
  if (best.roll.of_endless && best.pitch.of_endless) return;
  floor->fit.plane = found.plane_in(region);
  floor->fit.plane.n = up_of_roll_pitch({best.roll.rad, best.pitch.rad});
  if (!best.roll.of_endless && !best.pitch.of_endless) {
    floor->fit.reasons &= ~static_cast<std::uint32_t>(POSE_WALL_R_FLOOR_AMBIGUOUS);  // of what lies elsewhere
  }
  floor->area_m2 = found.area_m2;
  floor->roi_radius_m = region.u_to_m;
  POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_FLOOR));
  POSE_WALL_NOTE(trace::answered(POSE_WALL_TRACE_DOUBTS));
}

}  // namespace pose_wall

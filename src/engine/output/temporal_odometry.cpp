// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/temporal_odometry.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"
#include "engine/output/standing_surfaces.hpp"

namespace pose_wall {
namespace {

constexpr double kNobodyKnows = std::numeric_limits<double>::infinity();  // a level without bound

enum Direction { kAlong = 0, kAcross = 1, kUp = 2, kTurns = 3 };  // and turns about the three

Eigen::Vector3d vector_of(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

Place place_of(const pose_wall_odometry& o) {
  const double x = o.quaternion[0], y = o.quaternion[1], z = o.quaternion[2], w = o.quaternion[3];
  return {vector_of(o.position_m), Eigen::Quaterniond(w, x, y, z).toRotationMatrix()};
}

bool is_unit(const Eigen::Vector3d& v) {
  return std::fabs(v.squaredNorm() - 1.0) < 1e-5;
}

bool all_within(const double* numbers, int count, double least, double most) {
  for (int i = 0; i < count; ++i) {
    if (!(numbers[i] >= least && numbers[i] <= most)) return false;
  }
  return true;
}

// Response of one quantity to errors of a place in the odometry's directions.
struct Response {
  double of[POSE_WALL_ODOMETRY_DIRECTIONS] = {};

  double level(const double (&levels)[POSE_WALL_ODOMETRY_DIRECTIONS]) const {
    double sum = 0.0;
    for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
      if (of[k] > 0.0) sum += of[k] * levels[k];
    }
    return sum;
  }
  double variance(const double (&variances)[POSE_WALL_ODOMETRY_DIRECTIONS]) const {
    double sum = 0.0;
    for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
      if (of[k] > 0.0) sum += of[k] * of[k] * variances[k];
    }
    return sum;
  }
};

// Largest distance of a point beyond the seen part of a surface.
double beyond_m(const SeenSurface& wall, const Eigen::Vector3d& at_m, double unknown_m) {
  const double along_m = wall.along.dot(at_m);
  return larger(0.0, larger(wall.from_m - along_m, along_m - wall.to_m) + unknown_m);
}

double beyond_floor_m(const SeenSurface& floor, const Eigen::Vector3d& at_m, double unknown_m) {
  return larger(0.0, std::sqrt((at_m - floor.centre_m).squaredNorm()) + unknown_m - floor.radius_m);
}

// Yaw refers to the walls as last seen: of two, to the longer one.
const SeenSurface* surface_of(std::uint32_t quantity, const OdometryMemory& seen) {
  if (!seen.has_up) return nullptr;
  if (quantity < POSE_WALL_YAW) return &seen.floor;
  if (quantity != POSE_WALL_YAW) return &seen.wall[side_of(quantity)];
  const SeenSurface &left = seen.wall[0], &right = seen.wall[1];
  if (!left.exists || !right.exists) return left.exists ? &left : &right;
  return left.to_m - left.from_m > right.to_m - right.from_m ? &left : &right;
}

// The quantities at one place, relative to the surfaces that were seen.
class View {
 public:
  View(const pose_wall_odometry& o, const OdometryMemory& seen, const Settings& s, const Axes& axes)
      : odometry_(o),
        along_(vector_of(o.along)),
        across_(vector_of(o.across)),
        at_(place_of(o)),
        seen_(seen),
        settings_(s),
        axes_(axes) {}

  // Response of one quantity to errors of the place in the odometry's directions.
  Response response(std::uint32_t quantity) const {
    Response r;
    if (quantity == POSE_WALL_YAW) {
      r.of[kTurns + kUp] = 1.0;
    } else if (quantity < POSE_WALL_YAW) {
      const Eigen::Vector3d about = at_.R.col(quantity == POSE_WALL_ROLL ? 0 : 1);
      r.of[kTurns + kAlong] = std::fabs(about.dot(along_));
      r.of[kTurns + kAcross] = std::fabs(about.dot(across_));
    } else {
      const SeenSurface& wall = seen_.wall[side_of(quantity)];
      // The place along the wall matters as far as the wall's direction is unknown.
      r.of[kAlong] = std::fabs(wall.normal.dot(along_)) + wall.slope_level;
      r.of[kAcross] = std::fabs(wall.normal.dot(across_));
      r.of[kUp] = std::fabs(wall.normal.dot(along_.cross(across_)));
      r.of[kTurns + kUp] = std::sqrt(sample_base(quantity, settings_, axes_).squaredNorm());
    }
    return r;
  }

  // Infinite if the place may lie beyond the seen part of the surface: a road may turn there by any angle. A distance
  // changes by no more than the way beyond.
  double level(std::uint32_t quantity) const {
    const double unknown_m = odometry_.level[kAlong], told = response(quantity).level(odometry_.level);
    if (quantity < POSE_WALL_YAW) {
      return beyond_floor_m(seen_.floor, at_.position_m, unknown_m) > 0.0 ? kNobodyKnows : told;
    }
    const SeenSurface& wall = *surface_of(quantity, seen_);
    const double beyond = beyond_m(wall, point_m(quantity), unknown_m);
    if (quantity == POSE_WALL_YAW) return beyond > 0.0 ? kNobodyKnows : told;
    return told + beyond;
  }

  // The machine, or a quantity's sampling point, in the run's frame.
  Eigen::Vector3d point_m(std::uint32_t quantity) const {
    if (quantity < POSE_WALL_D_LF) return at_.position_m;
    return at_.position_m + at_.R * sample_base(quantity, settings_, axes_);
  }

 private:
  const pose_wall_odometry& odometry_;
  Eigen::Vector3d along_, across_;
  Place at_;
  const OdometryMemory& seen_;
  const Settings& settings_;
  const Axes& axes_;
};

// Error of a surface's direction over the way along it. One radius further on, a floor's level is doubled.
double by_way(std::uint32_t quantity, const SeenSurface& surface, const Place& from, const Place& to,
              const Eigen::Vector3d& to_m, const Settings& s, const Axes& axes) {
  if (quantity == POSE_WALL_YAW) return 0.0;
  if (quantity < POSE_WALL_YAW) {
    return surface.slope_level * std::sqrt((to.position_m - from.position_m).squaredNorm()) / surface.radius_m;
  }
  const Eigen::Vector3d from_m = from.position_m + from.R * sample_base(quantity, s, axes);
  return surface.slope_level * std::fabs(surface.along.dot(to_m - from_m));
}

// Over which the rock behind a value is replaced by other rock, by half of its length along the road. Of long ones the
// rock nearby counts most.
double rock_length_m(double half_m) {
  // Raw values 1, 2, 3 and 5 m apart have errors in common: correlations of 0.4 to 0.8, 0.35 to 0.6, 0.2 to 0.45 and at
  // most 0.35. Scenes were nominal, steel_sets, humps and mine_cut by its survey, with five sensors (2026-11-29). This
  // length tells 0.8, 0.67, 0.55 and 0.37.
  constexpr double kMost_m = 5.0;
  return half_m < kMost_m ? half_m : kMost_m;
}

void see_floor(const FloorResult& floor, const Place& at, const Settings& s, SeenSurface* seen) {
  seen->exists = true;
  seen->normal = at.R * floor.fit.plane.n;
  seen->centre_m = at.position_m;
  seen->radius_m = floor.roi_radius_m;
  seen->slope_level = larger(floor.roll.bound_rad.sum(), floor.pitch.bound_rad.sum()) +
                      s.protection_sigmas * larger(floor.roll.sigma_rad, floor.pitch.sigma_rad);
  seen->rock_m = rock_length_m(seen->radius_m);
  seen->waves[0] = floor.roll.waves_rad;
  seen->waves[1] = floor.pitch.waves_rad;
}

void see_wall(const JudgedWall& wall, const Place& at, const Levelling& levelling, const Settings& s,
              SeenSurface* seen) {
  const Eigen::Matrix3d R_run_level = at.R * levelling.R_level_base.transpose();
  const WallAhead ahead = ahead_of(wall, s);
  seen->exists = true;
  seen->normal = R_run_level * ahead.normal_level;
  seen->along = R_run_level * ahead.along_level;
  const double here_m = seen->along.dot(at.position_m);
  seen->from_m = here_m + ahead.from_m;
  seen->to_m = here_m + ahead.to_m;
  seen->slope_level = ahead.slope_level;
  seen->rock_m = rock_length_m(0.5 * (wall.along_max_m - wall.along_min_m));
  seen->waves[0] = wall.distance_waves_m;
  seen->waves[1] = wall.yaw_waves_rad;
}

// By which other rock moves a value. Yaw is of both walls, whichever is remembered for it.
double waves_of(std::uint32_t quantity, const SeenSurface& surface, const OdometryMemory& memory) {
  if (quantity == POSE_WALL_YAW) return larger(memory.wall[0].waves[1], memory.wall[1].waves[1]);
  return surface.waves[quantity == POSE_WALL_PITCH ? 1 : 0];
}

}  // namespace

bool is_sound(const pose_wall_odometry& o) {
  // Sane inputs: a double resolves nanometres at 10,000 km; no drift comes near 1e12.
  constexpr double kFar_m = 1e7, kLarge = 1e12;
  const double* q = o.quaternion;
  const double norm2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const Eigen::Vector3d along = vector_of(o.along), across = vector_of(o.across);
  constexpr int kAll = POSE_WALL_ODOMETRY_DIRECTIONS;  // directions of the interface, each with its drift
  return o.run != OdometryMemory::kNoRun && all_within(o.position_m, 3, -kFar_m, kFar_m) &&
         std::fabs(norm2 - 1.0) < 1e-5 && is_unit(along) && is_unit(across) && std::fabs(along.dot(across)) < 1e-3 &&
         all_within(o.level, kAll, 0.0, kNobodyKnows) && all_within(o.drift_variance, kAll, 0.0, kLarge) &&
         all_within(o.drift, kAll, 0.0, kLarge) && all_within(o.velocity_m_s, 3, -kSpeedMost_m_s, kSpeedMost_m_s) &&
         all_within(o.turn_rate_rad_s, 3, -kTurnRateMost_rad_s, kTurnRateMost_rad_s) &&
         all_within(o.rate_level, kAll, 0.0, kNobodyKnows);
}

bool change_by_odometry(const pose_wall_odometry& o, const OdometryMemory& memory, const Settings& s, const Axes& axes,
                        Change* change) {
  const Place from = {memory.position_m, memory.R_run_base}, to = place_of(o);
  const View view(o, memory, s, axes);
  double drift[POSE_WALL_ODOMETRY_DIRECTIONS], variance[POSE_WALL_ODOMETRY_DIRECTIONS];
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
    drift[k] = o.drift[k] - memory.drift[k];
    variance[k] = o.drift_variance[k] - memory.drift_variance[k];
    if (!(drift[k] >= 0.0 && variance[k] >= 0.0)) return false;
  }
  change->by_odometry = true;
  const double way_m = std::sqrt((to.position_m - from.position_m).squaredNorm());
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const SeenSurface* const surface = surface_of(q, memory);
    if (surface == nullptr || !surface->exists) continue;
    const double level = view.level(q);
    if (!(level < kNobodyKnows && memory.place_level[q] < kNobodyKnows)) continue;
    const Response response = view.response(q);
    const Eigen::Vector3d& wall_normal = memory.wall[side_of(q)].normal;
    change->carry[q] = change_between(q, from, to, memory.up, wall_normal, s, axes);
    change->by_way[q] = by_way(q, *surface, from, to, view.point_m(q), s, axes);
    change->growth[q] = response.level(drift) + change->by_way[q];
    change->new_rock[q] = 1.0 - exponential(-way_m / surface->rock_m);
    change->by_places[q] = true;
    change->place_level_before[q] = memory.place_level[q];
    change->place_level[q] = level;
    // Values of the rock beside the machine differ by the waves of both places, where these are far apart.
    const double waves = waves_of(q, *surface, memory);
    const double unknown = response.variance(variance) + 2.0 * change->new_rock[q] * waves * waves;
    change->drift2[q] = s.protection_sigmas * s.protection_sigmas * unknown;
  }
  return true;
}

void remember_place(const pose_wall_odometry& o, const FloorResult& floor, const Levelling& levelling,
                    const JudgedWall (&walls)[2], const Measurements& measured, const Settings& s, const Axes& axes,
                    OdometryMemory* memory) {
  if (o.run != memory->run) {
    memory->has_up = memory->floor.exists = memory->wall[0].exists = memory->wall[1].exists = false;
  }
  const Place at = place_of(o);
  memory->run = o.run;
  memory->position_m = at.position_m;
  memory->R_run_base = at.R;
  const auto is_good = [&measured](std::uint32_t quantity) {
    const Measurement& m = measured.quantity[quantity];
    return m.measured && !m.stale && (m.reasons & kDoubts) == 0;  // whatever the width of its level
  };
  const Measurement& roll = measured.quantity[POSE_WALL_ROLL];
  if (roll.measured && !roll.stale) {
    memory->has_up = true;
    memory->up = at.R * floor.fit.plane.n;
  }
  if (is_good(POSE_WALL_ROLL)) see_floor(floor, at, s, &memory->floor);
  for (int side = 0; side < 2; ++side) {
    const std::uint32_t front = side == 0 ? POSE_WALL_D_LF : POSE_WALL_D_RF;
    if (!is_good(front) && !is_good(front + 1)) continue;  // a rival, a thing before the wall
    see_wall(walls[side], at, levelling, s, &memory->wall[side]);
  }
  const View view(o, *memory, s, axes);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const SeenSurface* const surface = surface_of(q, *memory);
    memory->place_level[q] = surface != nullptr && surface->exists ? view.level(q) : kNobodyKnows;
  }
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
    memory->drift_variance[k] = o.drift_variance[k];
    memory->drift[k] = o.drift[k];
  }
}

}  // namespace pose_wall

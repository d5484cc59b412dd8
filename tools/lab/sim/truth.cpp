// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/truth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr double kSearchReach_m = 200.0;

bool is_plane_at(const Setup& setup, double height_m) {
  const bool below_arch = setup.road.arch_springing_m <= 0.0 || height_m < setup.road.arch_springing_m;
  return setup.road.curve_radius_m == 0.0 && below_arch;
}

// Beyond the face there is nothing but the walls' planes prolonged.
bool beside_niche(const Road& road, const Vector& P_road) {
  return road.face_extra_width_m > 0.0 && CentreLine(road.curve_radius_m).s_of(P_road) < road.face_distance_m;
}

bool has_steps(const Setup& setup, int side, const Vector& P_road) {
  return has_side(setup.openings.widening_side, side) || has_side(setup.openings.narrow_side, side) ||
         beside_niche(setup.road, P_road);
}

Plane wall_plane(const Setup& setup, int side) {
  const Surface wall = wall_mean(setup.road, side, 0.5 * setup.road.width_m, wall_lean_tangent(setup.road, side));
  return std::get<Plane>(wall.shape);
}

// |n . P + d| with the wall's plane; of the planes that a stepped wall has, the one square to which P lies.
double distance_to_plane(const Setup& setup, const World& rock, int side, const Vector& P_road) {
  const Plane plane = wall_plane(setup, side);
  if (!has_steps(setup, side, P_road)) return std::abs(plane.clearance(P_road));
  const double t = rock.trace({P_road, -plane.n}, kSearchReach_m, rock.objects(), {rock.objects(), P_road}).t_m;
  return t == kNever ? kNoTruth : t;
}

// The nearest point by direction: every degree first, then closer around the best one.
double distance_to_rock(const World& rock, const SectorIndex& index, const Vector& from, const Vector& along,
                        const Vector& sideways) {
  const auto range = [&](double angle) {
    const Vector direction = std::cos(angle) * sideways + std::sin(angle) * along;
    return rock.trace({from, direction}, kSearchReach_m, rock.objects(), index).t_m;
  };
  double best_angle = 0.0;
  double best = kNever;
  double step = kRadPerDeg;
  for (double reach = 85.0 * kRadPerDeg; reach > 1e-5; reach = step, step = reach / 10.0) {
    const double middle = best_angle;
    for (double angle = middle - reach; angle <= middle + reach + 1e-12; angle += step) {
      const double r = range(angle);
      if (r < best) {
        best = r;
        best_angle = angle;
      }
    }
  }
  return best == kNever ? kNoTruth : best;
}

// From the levelled forward axis to the walls' mean direction along the road.
double yaw_by_walls(const Setup& setup, const MachinePose& pose, const Matrix& R_road_level, const Vector& ahead) {
  if (setup.road.walls == static_cast<double>(kSideNone)) return kNoTruth;
  if (setup.road.curve_radius_m != 0.0) return 0.0 - pose.turned_left_rad;
  Vector along = Vector::Zero();
  for (const int side : {1, -1}) {
    if (!has_side(setup.road.walls, side)) continue;
    const Vector t = Vector::UnitZ().cross(R_road_level.transpose() * wall_plane(setup, side).n).normalized();
    along += t.dot(R_road_level.transpose() * Vector::UnitX()) > 0.0 ? t : -t;
  }
  return std::atan2(ahead.cross(along).z(), ahead.dot(along));
}

double wall_distance(const Setup& setup, const World& rock, int side, const Vector& P_road, double height_m,
                     const Vector& along_road, const Vector& left_road, StepRule rule) {
  if (!has_side(setup.road.walls, side)) return kNoTruth;
  const bool nearest = rule == StepRule::kNearest && has_steps(setup, side, P_road);
  if (is_plane_at(setup, height_m) && !nearest) return distance_to_plane(setup, rock, side, P_road);
  return distance_to_rock(rock, {rock.objects(), P_road}, P_road, along_road, side * left_road);
}

}  // namespace

TruthRow truth_of(const Setup& setup, const World& mean_rock, const MachinePose& pose, StepRule rule) {
  const Machine& m = setup.machine;
  const Placement at = place(setup, pose);
  const Matrix R_level = R_level_base(pose.roll_rad, pose.pitch_rad);
  const Matrix R_road_level = at.R_road_base * R_level.transpose();
  const Vector ahead_level = (R_level * forward_axis(m)).cwiseProduct(Vector(1.0, 1.0, 0.0)).normalized();
  TruthRow row;
  row.value[0] = pose.roll_rad;
  row.value[1] = pose.pitch_rad;
  row.value[2] = yaw_by_walls(setup, pose, R_road_level, ahead_level);
  // Sides are the road's: a machine that is turned far looks at one wall over its other side.
  const double turn_rad = std::isnan(row.value[2]) ? 0.0 : row.value[2];
  const Vector along_level = Eigen::AngleAxisd(turn_rad, Vector::UnitZ()) * ahead_level;
  const Vector along_road = R_road_level * along_level;
  const Vector left_road = R_road_level * Vector::UnitZ().cross(along_level);
  std::size_t quantity = 3;
  for (const int side : {1, -1}) {
    for (const double s : {m.s_front_m, m.s_back_m}) {
      const Vector P_base = s * forward_axis(m);
      const double height_m = pose.base_height_m + (R_level * P_base).z();
      const Vector P_road = at.origin_road + at.R_road_base * P_base;
      row.value[quantity++] = wall_distance(setup, mean_rock, side, P_road, height_m, along_road, left_road, rule);
    }
  }
  return row;
}

}  // namespace pose_wall::tools::sim

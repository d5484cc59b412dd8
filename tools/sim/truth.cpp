// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "sim/truth.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr double kSearchReach_m = 200.0;

bool is_plane_at(const Setup& setup, int side, double height_m) {
  const Openings& o = setup.openings;
  const bool below_arch = setup.road.arch_springing_m <= 0.0 || height_m < setup.road.arch_springing_m;
  return setup.road.curve_radius_m == 0.0 && below_arch && !has_side(o.widening_side, side) &&
         !has_side(o.narrow_side, side);
}

// |n . P + d| with the wall's plane and the sampling point in the levelled frame.
double distance_to_plane(const Setup& setup, int side, const Placement& at, const Matrix& R_level, const Vector& P) {
  const Surface wall = wall_mean(setup.road, side, 0.5 * setup.road.width_m, wall_lean_tangent(setup.road, side));
  const auto& plane = std::get<Plane>(wall.shape);
  const Vector n_level = R_level * at.R_road_base.transpose() * plane.n;
  return std::abs(n_level.dot(P) + plane.clearance(at.origin_road));
}

// The nearest point by direction: every degree first, then closer around the best one.
double distance_to_rock(const World& rock, const SectorIndex& index, const Vector& from, const Vector& ahead,
                        const Vector& sideways) {
  const auto range = [&](double angle) {
    const Vector direction = std::cos(angle) * sideways + std::sin(angle) * ahead;
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

}  // namespace

TruthRow truth_of(const Setup& setup, const World& mean_rock, const MachinePose& pose) {
  const Machine& m = setup.machine;
  const Placement at = place(setup, pose);
  const Matrix R_level = R_level_base(pose.roll_rad, pose.pitch_rad);
  const Matrix R_road_level = at.R_road_base * R_level.transpose();
  const Vector ahead_level = (R_level * forward_axis(m)).cwiseProduct(Vector(1.0, 1.0, 0.0)).normalized();
  const Vector left_level = Vector::UnitZ().cross(ahead_level);

  TruthRow row;
  row.value[0] = pose.roll_rad;
  row.value[1] = pose.pitch_rad;
  row.value[2] = 0.0 - pose.turned_left_rad;
  std::size_t quantity = 3;
  for (const int side : {1, -1}) {
    for (const double s : {m.s_front_m, m.s_back_m}) {
      const Vector P = R_level * (s * forward_axis(m));
      double distance = kNoTruth;
      if (has_side(setup.road.walls, side)) {
        if (is_plane_at(setup, side, pose.base_height_m + P.z())) {
          distance = distance_to_plane(setup, side, at, R_level, P);
        } else {
          const Vector from = at.origin_road + R_road_level * P;
          const SectorIndex index(mean_rock.objects(), from);
          distance =
              distance_to_rock(mean_rock, index, from, R_road_level * ahead_level, side * (R_road_level * left_level));
        }
      }
      row.value[quantity++] = distance;
    }
  }
  return row;
}

}  // namespace pose_wall::tools::sim

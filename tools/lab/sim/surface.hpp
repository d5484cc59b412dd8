// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The large surfaces of a road: planes (floor, roof, faces, straight walls), cones about the centre of a curve (walls
// of a curved road), elliptic arches. A ray meets the mean surface in closed form; over relief it marches through the
// slab that the relief stays in.
#pragma once

#include <limits>
#include <variant>

#include "lab/sim/centre_line.hpp"
#include "lab/sim/relief.hpp"

namespace pose_wall::tools::sim {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

struct Ray {
  Vector origin;
  Vector direction;  // unit
  Vector at(double t_m) const { return origin + t_m * direction; }
};

// n . p + d, positive inside the road; (u, v) are coordinates on it.
struct Plane {
  Vector n;
  double d_m;
  Vector u;
  Vector v;
  double clearance(const Vector& p) const { return n.dot(p) + d_m; }
  double enter(const Ray& ray, double offset_m) const;
  Eigen::Vector2d coordinates(const Vector& p) const { return {u.dot(p), v.dot(p)}; }
};

// Radius radius_m + slope * z about the vertical through (0, centre_y_m).
struct Cone {
  CentreLine line;
  double radius_m;
  double slope;
  double inside;  // +1: the road lies at smaller radii
  double clearance(const Vector& p) const;
  double enter(const Ray& ray, double offset_m) const;
  Eigen::Vector2d coordinates(const Vector& p) const { return {line.s_of(p), p.z()}; }
};

// Upper half of an elliptic cylinder along x.
struct Arch {
  double half_width_m;
  double rise_m;
  double springing_m;
  double clearance(const Vector& p) const;
  double enter(const Ray& ray, double offset_m) const;
  Eigen::Vector2d coordinates(const Vector& p) const;
};

struct Surface {
  std::variant<Plane, Cone, Arch> shape;
  Relief relief;

  // Distance inwards from the mean surface; exact for planes, first order for the others.
  double clearance(const Vector& p) const;
  // First t >= 0 at which the ray, from inside, comes down to this clearance; 0 if it starts below; kNever if never.
  double enter(const Ray& ray, double offset_m) const;
  // Where the ray meets the relief, not before t_start (from enter(ray, relief.reach_m())).
  double hit(const Ray& ray, double t_start_m) const;
  // Mean surface's unit normal towards the road, by which light falls.
  Vector normal(const Vector& p) const;
};

}  // namespace pose_wall::tools::sim

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a ray can meet: rough planes of rock, and smooth or crumbly bodies that stand in front of them.

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "judge/draw.hpp"

namespace pose_wall::judge {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Ray {
  Vector3d origin_m;
  Vector3d direction;  // unit
};

// Heights of zero mean over a plane: octaves of value noise, each turned by an angle of its own.
class Rock {
 public:
  Rock() = default;  // flat
  // An octave's height grows with its wavelength to the power of hurst; the shortest is about 6 cm.
  Rock(Draw* draw, double rms_m, double longest_m, double hurst);

  double height_m(double u_m, double v_m) const;
  double reach_m() const { return reach_m_; }  // no height is greater

 private:
  static constexpr int kOctaves = 6;
  struct Octave {
    double amplitude_m = 0.0, cos_per_m = 0.0, sin_per_m = 0.0, u_shift = 0.0, v_shift = 0.0;
  };

  std::array<Octave, kOctaves> octave_;
  double reach_m_ = 0.0;
};

// A plane of rock, whole across v, between two bounds along u. Only its front, where the normal points, can be hit.
struct Panel {
  Panel(const Vector3d& point_m, const Vector3d& normal, const Vector3d& along, double u_min_m, double u_max_m,
        const Rock& rock);

  // The distance along the ray, or nearest_m where nothing nearer is hit.
  double hit_m(const Ray& ray, double nearest_m) const;

  Vector3d point_m, normal, u, v;
  double u_min_m, u_max_m;
  Rock rock;
  // Only what lies on the negative side of clip_normal . p + clip_offset_m is there.
  Vector3d clip_normal = Vector3d::Zero();
  double clip_offset_m = -1.0;

 private:
  double height_over_rock_m(const Vector3d& at_m) const;
};

enum class Shape { kBox, kCylinder, kEllipsoid };

// A body by its centre, its axes (columns, to the frame of the rays) and half of its sizes. A cylinder's third size
// lies along its third axis.
struct Solid {
  double hit_m(const Ray& ray, double nearest_m) const;

  Shape shape = Shape::kBox;
  Vector3d centre_m = Vector3d::Zero();
  Matrix3d axes = Matrix3d::Identity();
  Vector3d half_m = Vector3d::Ones();
  Rock crumbs;  // moves the hit along the ray
};

Solid box(const Vector3d& centre_m, const Vector3d& half_m, double turn_rad);
// From one end to the other.
Solid cylinder(const Vector3d& from_m, const Vector3d& to_m, double radius_m);

}  // namespace pose_wall::judge

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/primitives.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

double hit_box(const Vector& half, const Vector& origin, const Vector& direction, double* cosine) {
  double enter = -kNever;
  double leave = kNever;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / direction[axis];
    const double a = (-half[axis] - origin[axis]) * inverse;
    const double b = (half[axis] - origin[axis]) * inverse;
    const double near = std::min(a, b);
    if (near > enter) {
      enter = near;
      *cosine = std::abs(direction[axis]);
    }
    leave = std::min(leave, std::max(a, b));
  }
  return enter > 0.0 && enter <= leave ? enter : kNever;
}

double hit_sphere(const Vector& to_origin, const Vector& direction, double radius) {
  const double b = to_origin.dot(direction);
  const double discriminant = b * b - to_origin.squaredNorm() + radius * radius;
  return discriminant < 0.0 ? kNever : -b - std::sqrt(discriminant);
}

// The axis is local x. A hit beyond an end can only be one on that end's sphere.
double hit_capsule(double half_length, double radius, const Vector& o, const Vector& e, double* cosine) {
  const double a = e.y() * e.y() + e.z() * e.z();
  const double b = o.y() * e.y() + o.z() * e.z();
  const double c = o.y() * o.y() + o.z() * o.z() - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return kNever;
  double t = a > 0.0 ? (-b - std::sqrt(discriminant)) / a : 0.0;
  double along = o.x() + t * e.x();
  if (std::abs(along) > half_length || a == 0.0) {
    along = std::copysign(half_length, a > 0.0 ? along : -e.x());
    t = hit_sphere(o - Vector(along, 0.0, 0.0), e, radius);
  }
  if (!(t > 0.0) || t == kNever) return kNever;
  *cosine = std::abs(e.dot(o + t * e - Vector(along, 0.0, 0.0))) / radius;
  return t;
}

}  // namespace

Primitive Primitive::box(Label label, const Vector& centre, const Matrix& axes, const Vector& half) {
  return {Kind::kBox, label, centre, axes, half};
}

Primitive Primitive::capsule(Label label, const Vector& from, const Vector& to, double radius_m) {
  Matrix axes;
  axes.col(0) = (to - from).normalized();
  const Vector other = std::abs(axes(2, 0)) < 0.9 ? Vector::UnitZ() : Vector::UnitX();
  axes.col(1) = other.cross(axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return {Kind::kCapsule, label, 0.5 * (from + to), axes, {0.5 * (to - from).norm(), radius_m, radius_m}};
}

double Primitive::hit(const Ray& ray, double* cosine) const {
  const Vector origin = axes.transpose() * (ray.origin - centre);
  const Vector direction = axes.transpose() * ray.direction;
  return kind == Kind::kBox ? hit_box(half, origin, direction, cosine)
                            : hit_capsule(half.x(), half.y(), origin, direction, cosine);
}

// Grows with the azimuth from 0 to kSectors without a trigonometric function: the diamond angle.
std::size_t SectorIndex::sector(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  if (!(sum > 0.0)) return 0;
  double turn = y / sum;
  if (x < 0.0) turn = 2.0 - turn;
  if (turn < 0.0) turn += 4.0;
  return static_cast<std::size_t>(turn * (kSectors / 4.0)) % kSectors;
}

// A ray that begins beside the origin meets what one from the origin does, for things that are larger by as much.
SectorIndex::SectorIndex(const std::vector<Primitive>& primitives, const Vector& origin, double reach_m)
    : empty_(primitives.empty()) {
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const Vector offset = primitives[i].centre - origin;
    const double distance = std::hypot(offset.x(), offset.y());
    const double bound = primitives[i].bound_m() + reach_m;
    std::size_t first = 0;
    std::size_t count = kSectors;
    if (distance > bound) {
      const double azimuth = std::atan2(offset.y(), offset.x());
      const double spread = std::asin(bound / distance);
      first = sector(std::cos(azimuth - spread), std::sin(azimuth - spread));
      const std::size_t last = sector(std::cos(azimuth + spread), std::sin(azimuth + spread));
      count = (last + kSectors - first) % kSectors + 1;
    }
    for (std::size_t k = 0; k < count; ++k) {
      sectors_[(first + k) % kSectors].push_back(static_cast<std::uint16_t>(i));
    }
  }
}

}  // namespace pose_wall::tools::sim

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/surface.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr int kMarchSteps = 96, kMarchStepsManyScales = 400;
constexpr int kRefineSteps = 2;

// How far the ray stands above the relief.
template <typename Shape>
double gap(const Shape& shape, const Relief& relief, double reach_m, const Ray& ray, double t) {
  const Vector p = ray.at(t);
  const Eigen::Vector2d on = shape.coordinates(p);
  return shape.clearance(p) - relief.height(on.x(), on.y(), reach_m);
}

// Regula falsi between a point above and one below the relief.
template <typename Shape>
double refine(const Shape& shape, const Relief& relief, double reach, const Ray& ray, double above, double gap_above,
              double below, double gap_below) {
  for (int i = 0; i < kRefineSteps; ++i) {
    const double t = above + (below - above) * gap_above / (gap_above - gap_below);
    const double g = gap(shape, relief, reach, ray, t);
    (g > 0.0 ? above : below) = t;
    (g > 0.0 ? gap_above : gap_below) = g;
  }
  return above + (below - above) * gap_above / (gap_above - gap_below);
}

// Steps shrink with the gap, so that a ray neither jumps over a bump nor crawls where it is far from all of them.
template <typename Shape>
double march(const Shape& shape, const Relief& relief, const Ray& ray, double t_start, double t_end) {
  const double reach = relief.reach_m();
  const double span = std::min(t_end - t_start, 50.0);
  const double descent = std::min(1.0, 2.0 * reach / span);
  const double advance = 1.0 / (descent + relief.slope());
  const double stride = relief.scales.stride_m();
  const int steps = relief.scales.flat() ? kMarchSteps : kMarchStepsManyScales;
  const double shortest = std::max(relief.step_m(), span / (0.5 * steps));
  double t = t_start;
  double g = gap(shape, relief, reach, ray, t);
  // At the slab's top the ray can only touch a summit; a start below the relief is a start in the rock.
  if (g <= 0.0) return t_start > 0.0 ? t_start : kNever;
  for (int i = 0; i < steps && t < t_start + span; ++i) {
    const double next = t + std::max(std::min(g * advance, stride), shortest);
    const double next_g = gap(shape, relief, reach, ray, next);
    if (next_g <= 0.0) return refine(shape, relief, reach, ray, t, g, next, next_g);
    t = next;
    g = next_g;
  }
  return kNever;
}

}  // namespace

double Plane::enter(const Ray& ray, double offset_m) const {
  const double above = clearance(ray.origin) - offset_m;
  if (above <= 0.0) return 0.0;
  const double descent = -n.dot(ray.direction);
  return descent > 0.0 ? above / descent : kNever;
}

double Cone::clearance(const Vector& p) const {
  const double r = std::hypot(p.x(), p.y() - line.centre_y_m());
  return inside * (radius_m + slope * p.z() - r) / std::sqrt(1.0 + slope * slope);
}

// |q + t e|^2 = (w + t slope e_z)^2 with q, e seen from the axis.
double Cone::enter(const Ray& ray, double offset_m) const {
  if (clearance(ray.origin) <= offset_m) return 0.0;
  const double qx = ray.origin.x();
  const double qy = ray.origin.y() - line.centre_y_m();
  const double growth = slope * ray.direction.z();
  const double w = radius_m + slope * ray.origin.z() - inside * offset_m * std::sqrt(1.0 + slope * slope);
  const double ex = ray.direction.x();
  const double ey = ray.direction.y();
  const double a = ex * ex + ey * ey - growth * growth;
  const double b = qx * ex + qy * ey - growth * w;
  const double c = qx * qx + qy * qy - w * w;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return kNever;
  // Stable for a near 0, too: the two roots are r / a and c / r.
  const double r = -(b + std::copysign(std::sqrt(discriminant), b));
  double first = r != 0.0 ? c / r : kNever;
  double second = a != 0.0 ? r / a : kNever;
  if (first > second) std::swap(first, second);
  return first > 0.0 ? first : (second > 0.0 ? second : kNever);
}

double Arch::clearance(const Vector& p) const {
  const double y = p.y() / half_width_m;
  const double z = (p.z() - springing_m) / rise_m;
  const double rho = std::hypot(y, z);
  if (rho <= 0.0) return std::min(half_width_m, rise_m);
  return (1.0 - rho) * rho / std::hypot(y / half_width_m, z / rise_m);
}

// A ray may start below the springing line outside the ellipse's lower half, so the last crossing counts.
double Arch::enter(const Ray& ray, double offset_m) const {
  const double a_y = half_width_m - offset_m;
  const double a_z = rise_m - offset_m;
  const double y = ray.origin.y() / a_y;
  const double z = (ray.origin.z() - springing_m) / a_z;
  const double ey = ray.direction.y() / a_y;
  const double ez = ray.direction.z() / a_z;
  const double a = ey * ey + ez * ez;
  const double b = y * ey + z * ez;
  const double discriminant = b * b - a * (y * y + z * z - 1.0);
  if (discriminant < 0.0 || a <= 0.0) return kNever;
  const double t = (std::sqrt(discriminant) - b) / a;
  return t > 0.0 && ray.origin.z() + t * ray.direction.z() >= springing_m ? t : kNever;
}

Eigen::Vector2d Arch::coordinates(const Vector& p) const {
  const double angle = std::atan2((p.z() - springing_m) / rise_m, p.y() / half_width_m);
  return {p.x(), angle * 0.5 * (half_width_m + rise_m)};
}

double Surface::clearance(const Vector& p) const {
  return std::visit([&p](const auto& s) { return s.clearance(p); }, shape);
}

double Surface::enter(const Ray& ray, double offset_m) const {
  return std::visit([&](const auto& s) { return s.enter(ray, offset_m); }, shape);
}

double Surface::hit(const Ray& ray, double t_start_m) const {
  if (relief.flat()) return t_start_m > 0.0 ? t_start_m : kNever;
  return std::visit([&](const auto& s) { return march(s, relief, ray, t_start_m, s.enter(ray, -relief.reach_m())); },
                    shape);
}

Vector Surface::normal(const Vector& p) const {
  if (const auto* plane = std::get_if<Plane>(&shape)) return plane->n;
  constexpr double kStep = 1e-4;
  Vector gradient;
  for (int axis = 0; axis < 3; ++axis) {
    gradient[axis] = clearance(p + kStep * Vector::Unit(axis)) - clearance(p - kStep * Vector::Unit(axis));
  }
  return gradient.normalized();
}

}  // namespace pose_wall::tools::sim

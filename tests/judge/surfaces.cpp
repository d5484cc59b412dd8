// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pose_wall::judge {
namespace {

constexpr int kTableSide = 256;
constexpr double kFarFromZero = 8192.0;  // lattice cells: positions stay positive, so that a cast rounds down
constexpr double kShortest_m = 0.06;
constexpr double kReachInRms = 4.0;
constexpr double kStepAlongRock_m = 0.04;  // below the shortest wave
constexpr int kStepsMax = 64;

const std::vector<float>& lattice() {
  static const std::vector<float> table = [] {
    Draw draw(20261126);
    std::vector<float> values(kTableSide * kTableSide);
    for (float& value : values) value = static_cast<float>(draw.uniform(-1.0, 1.0));
    return values;
  }();
  return table;
}

// Between -1 and 1; the cells are 1 wide. Its root mean square is kNoiseRms.
double value_noise(const float* table, double x, double y) {
  const auto column = static_cast<unsigned>(x), row = static_cast<unsigned>(y);
  const double fx = x - column, fy = y - row;
  const double sx = fx * fx * (3.0 - 2.0 * fx), sy = fy * fy * (3.0 - 2.0 * fy);
  constexpr unsigned kMask = kTableSide - 1;
  const float* low = table + (row & kMask) * kTableSide;
  const float* high = table + ((row + 1) & kMask) * kTableSide;
  const unsigned left = column & kMask, right = (column + 1) & kMask;
  const double bottom = low[left] + sx * (low[right] - low[left]);
  const double top = high[left] + sx * (high[right] - high[left]);
  return bottom + sy * (top - bottom);
}
// Lattice values have the variance 1/3; smoothstep keeps the mean of squared weights 26/35 along each of two axes.
constexpr double kNoiseRms = 0.42890;

struct Interval {
  double enter_m, leave_m;
};

Interval meet(Interval a, Interval b) {
  return {std::max(a.enter_m, b.enter_m), std::min(a.leave_m, b.leave_m)};
}

constexpr double kFar_m = 1e9;
constexpr Interval kNothing = {kFar_m, -kFar_m};

Interval slab(double origin_m, double direction, double half_m) {
  if (std::abs(direction) < 1e-12) return std::abs(origin_m) <= half_m ? Interval{-kFar_m, kFar_m} : kNothing;
  const double a = (-half_m - origin_m) / direction, b = (half_m - origin_m) / direction;
  return {std::min(a, b), std::max(a, b)};
}

// |o + t d| <= 1 in as many dimensions as the vectors have.
template <int N>
Interval ball(const Eigen::Matrix<double, N, 1>& o, const Eigen::Matrix<double, N, 1>& d) {
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - 1.0;
  if (a < 1e-18) return c <= 0.0 ? Interval{-kFar_m, kFar_m} : kNothing;
  const double root = b * b - a * c;
  if (root <= 0.0) return kNothing;
  return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
}

}  // namespace

Rock::Rock(Draw* draw, double rms_m, double longest_m, double hurst) {
  const double ratio = std::pow(kShortest_m / longest_m, 1.0 / (kOctaves - 1));
  std::array<double, kOctaves> share{};
  double squares = 0.0;
  for (std::size_t k = 0; k < kOctaves; ++k) {
    share[k] = std::pow(ratio, static_cast<double>(k) * hurst);
    squares += share[k] * share[k];
  }
  for (std::size_t k = 0; k < kOctaves; ++k) {
    const double per_m = 1.0 / (longest_m * std::pow(ratio, static_cast<double>(k))),
                 turn_rad = draw->uniform(0.0, 2.0 * kPi);
    octave_[k] = {rms_m * share[k] / std::sqrt(squares) / kNoiseRms, per_m * std::cos(turn_rad),
                  per_m * std::sin(turn_rad), kFarFromZero + draw->uniform(0.0, kTableSide),
                  kFarFromZero + draw->uniform(0.0, kTableSide)};
  }
  reach_m_ = kReachInRms * rms_m;
}

double Rock::height_m(double u_m, double v_m) const {
  if (reach_m_ == 0.0) return 0.0;
  static const float* const table = lattice().data();
  double sum_m = 0.0;
  for (const Octave& octave : octave_) {
    sum_m += octave.amplitude_m * value_noise(table, octave.cos_per_m * u_m - octave.sin_per_m * v_m + octave.u_shift,
                                              octave.sin_per_m * u_m + octave.cos_per_m * v_m + octave.v_shift);
  }
  return std::clamp(sum_m, -reach_m_, reach_m_);
}

Panel::Panel(const Vector3d& point, const Vector3d& towards_rays, const Vector3d& along, double u_min, double u_max,
             const Rock& surface)
    : point_m(point), normal(towards_rays.normalized()), u_min_m(u_min), u_max_m(u_max), rock(surface) {
  u = (along - along.dot(normal) * normal).normalized();
  v = normal.cross(u);
}

double Panel::height_over_rock_m(const Vector3d& at_m) const {
  const Vector3d from_point_m = at_m - point_m;
  return normal.dot(from_point_m) - rock.height_m(u.dot(from_point_m), v.dot(from_point_m));
}

double Panel::hit_m(const Ray& ray, double nearest_m) const {
  const double towards = -normal.dot(ray.direction);
  if (towards < 1e-6) return nearest_m;
  const Vector3d start_m = ray.origin_m - point_m;
  const double height_m = normal.dot(start_m), reach_m = rock.reach_m();
  const double enter_m = std::max(0.0, (height_m - reach_m) / towards);
  const double leave_m = (height_m + reach_m) / towards;
  if (enter_m >= nearest_m || leave_m <= 0.0) return nearest_m;
  const double u_start_m = u.dot(start_m), u_slope = u.dot(ray.direction);
  const double u_enter_m = u_start_m + u_slope * enter_m, u_leave_m = u_start_m + u_slope * leave_m;
  if (std::max(u_enter_m, u_leave_m) < u_min_m || std::min(u_enter_m, u_leave_m) > u_max_m) return nearest_m;

  double hit_m = enter_m;
  if (reach_m > 0.0) {
    const double along_rock_m = (leave_m - enter_m) * std::sqrt(std::max(0.0, 1.0 - towards * towards));
    const int steps = std::clamp(static_cast<int>(along_rock_m / kStepAlongRock_m), 2, kStepsMax);
    const double step_m = (leave_m - enter_m) / steps;
    double above_m = height_over_rock_m(ray.origin_m + enter_m * ray.direction);
    for (int k = 1; k <= steps && above_m > 0.0; ++k) {
      const double next_m = height_over_rock_m(ray.origin_m + (enter_m + k * step_m) * ray.direction);
      if (next_m <= 0.0) hit_m = enter_m + (k - 1 + above_m / (above_m - next_m)) * step_m;
      above_m = next_m;
    }
  }
  const double u_hit_m = u_start_m + u_slope * hit_m;
  const bool inside = u_hit_m >= u_min_m && u_hit_m <= u_max_m;
  const bool clipped = clip_normal.dot(ray.origin_m + hit_m * ray.direction) + clip_offset_m > 0.0;
  return hit_m < nearest_m && inside && !clipped ? hit_m : nearest_m;
}

double Solid::hit_m(const Ray& ray, double nearest_m) const {
  const Vector3d offset_m = ray.origin_m - centre_m;
  const double along_m = offset_m.dot(ray.direction);
  if (offset_m.squaredNorm() - along_m * along_m > half_m.squaredNorm()) return nearest_m;
  const Vector3d o_m = axes.transpose() * offset_m, d = axes.transpose() * ray.direction;
  Interval inside = {0.0, nearest_m};
  if (shape == Shape::kBox) {
    for (int i = 0; i < 3; ++i) inside = meet(inside, slab(o_m[i], d[i], half_m[i]));
  } else if (shape == Shape::kCylinder) {
    inside = meet(inside, slab(o_m.z(), d.z(), half_m.z()));
    inside = meet(inside,
                  ball<2>(o_m.head<2>().cwiseQuotient(half_m.head<2>()), d.head<2>().cwiseQuotient(half_m.head<2>())));
  } else {
    inside = meet(inside, ball<3>(o_m.cwiseQuotient(half_m), d.cwiseQuotient(half_m)));
  }
  if (inside.enter_m >= inside.leave_m) return nearest_m;
  const Vector3d at_m = ray.origin_m + inside.enter_m * ray.direction;
  return inside.enter_m + crumbs.height_m(at_m.x() + at_m.z(), at_m.y() - at_m.z());
}

Solid box(const Vector3d& centre_m, const Vector3d& half_m, double turn_rad) {
  Solid solid;
  solid.centre_m = centre_m;
  solid.half_m = half_m;
  solid.axes = Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ()).toRotationMatrix();
  return solid;
}

Solid cylinder(const Vector3d& from_m, const Vector3d& to_m, double radius_m) {
  Solid solid;
  solid.shape = Shape::kCylinder;
  solid.centre_m = 0.5 * (from_m + to_m);
  solid.half_m = {radius_m, radius_m, 0.5 * (to_m - from_m).norm()};
  solid.axes = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), to_m - from_m).toRotationMatrix();
  return solid;
}

}  // namespace pose_wall::judge

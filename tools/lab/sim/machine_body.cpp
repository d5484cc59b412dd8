// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/machine_body.hpp"

#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr double kGroundClearance_m = 0.15;
constexpr double kBoxMargin_m = 0.1;
constexpr double kBoomPivot_m = 0.2;  // above the body's top, at 60 % of its front half

double body_bottom_m(const Machine& m) {
  return -m.base_height_m + kGroundClearance_m;
}

struct Boom {
  Vector from_base;
  Vector to_base;
};

Boom boom_at(const Machine& m, double time_s) {
  const double swing = m.boom_sweep_deg * kRadPerDeg * std::sin(2.0 * M_PI * time_s / m.boom_period_s);
  const double rise = m.boom_elevation_deg * kRadPerDeg;
  const Vector reach = std::cos(rise) * (std::cos(swing) * forward_axis(m) + std::sin(swing) * left_axis(m)) +
                       std::sin(rise) * Vector::UnitZ();
  const Vector from = 0.3 * m.body_length_m * forward_axis(m) + (m.body_top_m + kBoomPivot_m) * Vector::UnitZ();
  return {from, from + m.boom_length_m * reach};
}

}  // namespace

std::vector<Primitive> machine_body(const Setup& setup, const MachinePose& pose, const Placement& at) {
  const Machine& m = setup.machine;
  std::vector<Primitive> out;
  if (m.body != 0.0) {
    Matrix axes_base;
    axes_base << forward_axis(m), left_axis(m), Vector::UnitZ();
    const double bottom = body_bottom_m(m);
    const Vector centre = 0.5 * (m.body_top_m + bottom) * Vector::UnitZ();
    const Vector half(0.5 * m.body_length_m, 0.5 * m.body_width_m, 0.5 * (m.body_top_m - bottom));
    out.push_back(
        Primitive::box(Label::kBody, at.R_road_base * centre + at.origin_road, at.R_road_base * axes_base, half));
  }
  if (m.boom != 0.0) {
    const Boom boom = boom_at(m, pose.time_s);
    out.push_back(Primitive::capsule(Label::kBody, at.R_road_base * boom.from_base + at.origin_road,
                                     at.R_road_base * boom.to_base + at.origin_road, m.boom_radius_m));
  }
  return out;
}

std::array<double, 6> body_box_base_m(const Machine& m) {
  const Vector half = (0.5 * m.body_length_m * forward_axis(m) + 0.5 * m.body_width_m * left_axis(m)).cwiseAbs();
  const double x = half.x() + kBoxMargin_m;
  const double y = half.y() + kBoxMargin_m;
  return {-x, x, -y, y, body_bottom_m(m) - kBoxMargin_m, m.body_top_m + kBoxMargin_m};
}

std::array<double, 6> boom_box_base_m(const Machine& m) {
  const Boom boom = boom_at(m, 0.0);
  const Vector margin = Vector::Constant(m.boom_radius_m + kBoxMargin_m);
  const Vector low = boom.from_base.cwiseMin(boom.to_base) - margin;
  const Vector high = boom.from_base.cwiseMax(boom.to_base) + margin;
  return {low.x(), high.x(), low.y(), high.y(), low.z(), high.z()};
}

}  // namespace pose_wall::tools::sim

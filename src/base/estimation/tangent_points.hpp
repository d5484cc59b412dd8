// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Points near a plane, in the plane's own coordinates.
//
// A fit reads the same points many times, each time from a plane that is turned and moved a little. In the tangent
// frame of the first plane every later one is a height over it, a + b u + c v. The distance of a point is then exactly
// (r - a - b u - c v) / sqrt(1 + b^2 + c^2): two products instead of a turn in space.

#pragma once

#include <cmath>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/point_set.hpp"
#include "base/estimation/plane.hpp"
#include "base/estimation/tangent_frame.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// A plane as its height over another one.
struct PlaneOver {
  double offset_m = 0.0, slope_u = 0.0, slope_v = 0.0;

  // By which heights over the first plane are multiplied to become distances from this one.
  double foreshortening() const { return 1.0 / std::sqrt(1.0 + slope_u * slope_u + slope_v * slope_v); }
  void add(const Eigen::Vector3d& correction) {
    offset_m += correction[0];
    slope_u += correction[1];
    slope_v += correction[2];
  }
  Eigen::Vector3d as_correction() const { return {offset_m, slope_u, slope_v}; }
};

struct TangentPoints {
  Span<float> u, v, r, weight;  // metres; weight as PointSet's, and rows go on for a four as its do
  std::uint32_t count = 0;
  Plane plane;
  TangentFrame frame;

  void lay_out(Arena& arena, std::uint32_t points_max) {
    for (Span<float>* row : {&u, &v, &r, &weight}) *row = arena.take<float>(points_max + kFour);
    count = 0;
  }

  std::uint32_t capacity() const { return u.size() < kFour ? 0 : u.size() - kFour; }

  // Around a plane, with the origin's foot as origin and u along the hint.
  void begin(const Plane& around, const Eigen::Vector3d& origin, const Eigen::Vector3d& u_hint) {
    plane = around;
    frame = tangent_frame(around, origin, u_hint);
    count = 0;
  }

  // u, v, r.
  Eigen::Vector3d in_frame(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = p - frame.origin;
    return {frame.u.dot(q), frame.v.dot(q), plane.n.dot(q)};
  }

  // Those of a cloud that a list names; of more than there is room for the first. In floats: to some micrometres within
  // 30 m, tens of them at 200 m.
  void add(const PointSet& cloud, Span<const std::uint32_t> list);

  Plane plane_of(const PlaneOver& over) const { return corrected(plane, frame, over.as_correction()); }
  double distance(std::uint32_t k, const PlaneOver& over, double foreshortening) const {
    return (static_cast<double>(r[k]) - over.offset_m - over.slope_u * static_cast<double>(u[k]) -
            over.slope_v * static_cast<double>(v[k])) *
           foreshortening;
  }
  // Of the points k to k + 3; those behind the last one are whatever the rows hold there.
  FourFloats four_distances(std::uint32_t k, const PlaneOver& over, double foreshortening) const {
    return (load_four(&r[k]) - static_cast<float>(over.offset_m) - static_cast<float>(over.slope_u) * load_four(&u[k]) -
            static_cast<float>(over.slope_v) * load_four(&v[k])) *
           static_cast<float>(foreshortening);
  }
};

}  // namespace pose_wall

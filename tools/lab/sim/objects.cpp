// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/objects.hpp"

#include <algorithm>
#include <cmath>

#include "lab/sim/random.hpp"
#include "lab/sim/section.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr double kReach_m = 60.0;        // long objects run this far ahead and behind
constexpr double kCurveSegment_m = 1.5;  // and follow a curve in pieces of this length
constexpr double kIntoRock_m = 0.5;      // what touches a wall goes this far into it, so that no gap shows

// Places things beside the wall of one side.
class Wallside {
 public:
  Wallside(const Setup& setup, int side) : road_(setup.road), line_(road_.curve_radius_m), side_(side) {}

  // standoff: horizontal distance from the mean wall at height z over the floor.
  Vector point(double s_m, double standoff_m, double z_m) const {
    const double half = 0.5 * road_.width_m + std::tan(splay_rad()) * s_m + z_m * wall_lean_tangent(road_, side_);
    Vector p = line_.point(s_m, side_ * (half - standoff_m), 0.0);
    p.z() = z_m + floor_height_m(road_, p);
    return p;
  }
  // Columns: along the wall, to the left, up.
  Matrix axes(double s_m) const {
    const double heading = line_.heading_rad(s_m) + side_ * splay_rad();
    Matrix m;
    m.col(0) << std::cos(heading), std::sin(heading), 0.0;
    m.col(1) << -std::sin(heading), std::cos(heading), 0.0;
    m.col(2) = Vector::UnitZ();
    return m;
  }
  Vector upright(double s_m) const {
    const double slope = road_.slope_deg * kRadPerDeg;
    return std::sin(slope) * line_.tangent(s_m) + std::cos(slope) * Vector::UnitZ();
  }
  double segment_m() const { return line_.curved() ? kCurveSegment_m : 2.0 * kReach_m; }
  double roof_m() const { return road_.height_m; }

  // A solid between two standoffs (near the wall, near the road), two heights and two places along the road.
  void add_solid(Label label, double from_m, double to_m, double near_wall_m, double near_road_m, double bottom_m,
                 double top_m, std::vector<Primitive>& out) const {
    const int pieces = std::max(1, static_cast<int>(std::ceil((to_m - from_m) / segment_m() - 1e-9)));
    const double length = (to_m - from_m) / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double s = from_m + (i + 0.5) * length;
      const Vector half(0.5 * length, 0.5 * (near_road_m - near_wall_m), 0.5 * (top_m - bottom_m));
      const Vector centre = point(s, 0.5 * (near_road_m + near_wall_m), 0.5 * (top_m + bottom_m));
      out.push_back(Primitive::box(label, centre, axes(s), half));
    }
  }
  void add_pipe(double height_m, double radius_m, double standoff_m, std::vector<Primitive>& out) const {
    const double step = segment_m();
    for (double s = -kReach_m; s < kReach_m - 1e-9; s += step) {
      out.push_back(Primitive::capsule(Label::kObject, point(s, standoff_m, height_m),
                                       point(s + step, standoff_m, height_m), radius_m));
    }
  }
  void add_post(double s_m, double standoff_m, double radius_m, double height_m, std::vector<Primitive>& out) const {
    const Vector foot = point(s_m, standoff_m, 0.0);
    const Vector top = foot + (height_m - radius_m) * upright(s_m);
    out.push_back(Primitive::capsule(Label::kObject, foot, top, radius_m));
  }

 private:
  double splay_rad() const { return (side_ > 0 ? road_.splay_left_deg : road_.splay_right_deg) * kRadPerDeg; }
  const Road& road_;
  CentreLine line_;
  int side_;
};

void add_fixtures(const Setup& setup, const Wallside& wall, int side, std::vector<Primitive>& out) {
  const Objects& o = setup.objects;
  if (has_side(o.pipe_side, side)) {
    for (int i = 0; i < static_cast<int>(o.pipe_count); ++i) {
      wall.add_pipe(o.pipe_height_m + i * o.pipe_spacing_m, o.pipe_radius_m, o.pipe_standoff_m, out);
    }
  }
  if (has_side(o.prop_side, side)) {
    const int reach = static_cast<int>(0.5 * kReach_m / o.prop_pitch_m);
    for (int i = -reach; i <= reach; ++i) {
      wall.add_post((i + 0.3) * o.prop_pitch_m, o.prop_standoff_m, o.prop_radius_m, wall.roof_m() + 0.5, out);
    }
  }
  if (has_side(o.conveyor_side, side)) {
    wall.add_solid(Label::kObject, -kReach_m, kReach_m, o.conveyor_standoff_m,
                   o.conveyor_standoff_m + o.conveyor_width_m, o.conveyor_bottom_m, o.conveyor_top_m, out);
  }
}

void add_visitors(const Setup& setup, const Wallside& wall, int side, Random& random, std::vector<Primitive>& out) {
  const Objects& o = setup.objects;
  const auto moves = [&](std::size_t from, double speed_mps) {
    for (std::size_t i = from; i < out.size(); ++i) out[i].velocity_mps.x() = speed_mps;
  };
  std::size_t first = out.size();
  if (has_side(o.vehicle_side, side)) {
    wall.add_solid(Label::kObject, o.vehicle_at_m - 0.5 * o.vehicle_length_m, o.vehicle_at_m + 0.5 * o.vehicle_length_m,
                   o.vehicle_standoff_m, o.vehicle_standoff_m + o.vehicle_width_m, 0.2, o.vehicle_height_m, out);
  }
  moves(first, o.vehicle_speed_mps);
  first = out.size();
  if (has_side(o.people_side, side)) {
    for (int i = 0; i < static_cast<int>(o.people_count); ++i) {
      const double s = random.uniform(o.people_from_m, o.people_to_m);
      wall.add_post(s, o.people_standoff_m + random.uniform(-0.2, 0.2), 0.25, random.uniform(1.6, 1.9), out);
    }
  }
  moves(first, o.people_speed_mps);
  if (has_side(o.curtain_side, side)) {
    const double standoff = 0.5 * setup.road.width_m - o.curtain_distance_m;
    wall.add_solid(Label::kObject, o.curtain_from_m, o.curtain_to_m, standoff - 0.01, standoff + 0.01, 0.0,
                   o.curtain_height_m, out);
  }
}

void add_clutter(const Setup& setup, Random& random, std::vector<Primitive>& out) {
  for (int i = 0; i < static_cast<int>(setup.objects.clutter_count); ++i) {
    const double azimuth = random.uniform(-M_PI, M_PI);
    const double distance = random.uniform(6.0, 25.0);
    const double turn = random.uniform(-M_PI, M_PI);
    Vector half(random.uniform(0.3, 1.5), random.uniform(0.3, 1.5), random.uniform(0.3, 1.2));
    Matrix axes = Matrix::Identity();
    axes.topLeftCorner<2, 2>() << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
    Vector centre(distance * std::cos(azimuth), distance * std::sin(azimuth), 0.0);
    centre.z() = half.z() + floor_height_m(setup.road, centre);
    out.push_back(Primitive::box(Label::kObject, centre, axes, half));
  }
}

}  // namespace

std::vector<Primitive> road_objects(const Setup& setup, std::uint64_t seed) {
  std::vector<Primitive> out;
  Random random(seed, 0x0b1ec75);
  for (const int side : {1, -1}) {
    const Wallside wall(setup, side);
    add_fixtures(setup, wall, side, out);
    add_visitors(setup, wall, side, random, out);
  }
  add_clutter(setup, random, out);
  return out;
}

std::vector<Primitive> benches(const Setup& setup) {
  const Floor& f = setup.floor;
  std::vector<Primitive> out;
  for (const int side : {1, -1}) {
    if (!has_side(f.bench_side, side)) continue;
    Wallside(setup, side)
        .add_solid(Label::kObject, -kReach_m, kReach_m, -kIntoRock_m, f.bench_width_m, -kIntoRock_m, f.bench_height_m,
                   out);
  }
  return out;
}

std::vector<Primitive> narrow_place(const Setup& setup) {
  const Openings& o = setup.openings;
  std::vector<Primitive> out;
  for (const int side : {1, -1}) {
    if (!has_side(o.narrow_side, side)) continue;
    Wallside(setup, side)
        .add_solid(side > 0 ? Label::kWallLeft : Label::kWallRight, o.narrow_at_m, o.narrow_at_m + o.narrow_length_m,
                   -kIntoRock_m, o.narrow_depth_m, -kIntoRock_m, setup.road.height_m + kIntoRock_m, out);
  }
  return out;
}

}  // namespace pose_wall::tools::sim

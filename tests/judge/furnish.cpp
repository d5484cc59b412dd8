// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/furnish.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pose_wall::judge {
namespace {

constexpr double kMachineHalfLength_m = 2.25;  // of a machine 4.5 m long

class Furnisher {
 public:
  Furnisher(Road* road, const RoadLine& line, Draw* draw) : road_(*road), line_(line), draw_(*draw) {}

  void all() {
    if (road_.has(kSteelSets)) steel_sets();
    if (road_.has(kPipes)) pipes();
    if (road_.has(kBelt)) belt();
    if (road_.has(kBox)) box_beside();
    if (road_.has(kBench)) bench();
    if (road_.has(kVehicle)) vehicle();
    if (road_.has(kPeople)) people();
    if (road_.has(kHeaps)) heaps();
    if (road_.has(kPuddles)) puddles();
  }

 private:
  double tilt_rad(double largest_deg) { return kRadPerDeg * draw_.uniform(-largest_deg, largest_deg); }

  // The wall's y at a place, by the plane that is true there.
  double wall_y_m(double side, double x_m, double z_m) const {
    const Plane& plane = side > 0.0 ? road_.left : road_.right;
    return on_wall_m(plane, x_m).y() - plane.normal.z() * z_m / plane.normal.y();
  }
  double floor_z_m(double x_m, double y_m) const {
    const Vector3d& n = road_.floor.normal;
    return -(n.x() * x_m + n.y() * y_m) / n.z() + line_.ramp_slope * std::max(0.0, x_m - line_.ramp_x_m);
  }

  void steel_sets() {
    const double spacing_m = draw_.uniform(0.7, 1.5), depth_m = draw_.uniform(0.04, 0.1);
    const double half_width_m = draw_.uniform(0.04, 0.08);
    for (double x_m = -16.0 + draw_.uniform(0.0, 1.0); x_m < std::min(16.0, line_.end_m); x_m += spacing_m) {
      for (const double side : {1.0, -1.0}) {
        const bool in_gap =
            road_.has(kCrosscut) && side == line_.gap_side && x_m > line_.gap_m[0] && x_m < line_.gap_m[1];
        if (in_gap) continue;
        const double middle_z_m = 0.5 * road_.height_m;
        Solid leg = box({x_m, wall_y_m(side, x_m, middle_z_m), middle_z_m}, {half_width_m, depth_m, middle_z_m}, 0.0);
        const Plane& plane = side > 0.0 ? road_.left : road_.right;  // legs lean as the wall does
        leg.axes = Eigen::Quaterniond::FromTwoVectors(-side * Vector3d::UnitY(), plane.normal).toRotationMatrix();
        road_.solids.push_back(leg);
      }
      const Vector3d top_m(x_m, 0.0, road_.height_m - 0.06);
      road_.solids.push_back(box(top_m, {half_width_m, 0.5 * road_.width_m, 0.07}, 0.0));
    }
  }

  void pipes() {
    const double side = draw_.sign(), end_m = std::min(20.0, line_.end_m);
    for (int k = draw_.whole(1, 4); k > 0; --k) {
      const bool cable = draw_.chance(0.4);
      const double radius_m = cable ? draw_.uniform(0.015, 0.04) : draw_.uniform(0.04, 0.15);
      const double z_m = draw_.uniform(0.5, std::min(2.3, road_.height_m - 0.4));
      const double off_m = radius_m + draw_.uniform(0.0, 0.15), sag_m = cable ? draw_.uniform(0.0, 0.3) : 0.0;
      const double piece_m = cable ? 2.0 : 45.0;
      for (double x_m = -20.0; x_m < end_m; x_m += piece_m) {
        const double to_m = std::min(end_m, x_m + piece_m);
        const double from_z_m = z_m - (cable ? sag_m * std::abs(std::sin(0.7 * x_m)) : 0.0);
        const double to_z_m = z_m - (cable ? sag_m * std::abs(std::sin(0.7 * to_m)) : 0.0);
        road_.solids.push_back(cylinder({x_m, wall_y_m(side, x_m, from_z_m) - side * off_m, from_z_m},
                                        {to_m, wall_y_m(side, to_m, to_z_m) - side * off_m, to_z_m}, radius_m));
      }
    }
  }

  // On legs, off the wall; it ends behind the machine where there is no room beside it.
  void belt() {
    const double side = draw_.sign(), half_m = draw_.uniform(0.3, 0.5), off_m = draw_.uniform(0.15, 0.5);
    const bool beside = 0.5 * road_.width_m > 2.0 * half_m + off_m + 2.0;
    belt_side_ = beside ? side : 0.0;
    if (beside) take(side, 2.0 * half_m + off_m);
    const double end_m = beside ? draw_.uniform(-1.0, 4.0) : -kMachineHalfLength_m - 1.0;
    const double y_m = wall_y_m(side, 0.0, 0.7) - side * (off_m + half_m), top_m = draw_.uniform(0.6, 1.0);
    const double length_m = end_m + 25.0;
    road_.solids.push_back(box({end_m - 0.5 * length_m, y_m, top_m}, {0.5 * length_m, half_m, 0.08}, 0.0));
    for (double x_m = end_m - 0.3; x_m > -20.0; x_m -= 2.5) {
      for (const double edge : {-1.0, 1.0}) {
        road_.solids.push_back(
            cylinder({x_m, y_m + edge * 0.9 * half_m, -0.5}, {x_m, y_m + edge * 0.9 * half_m, top_m}, 0.04));
      }
    }
  }

  void box_beside() {
    const double side = belt_side_ == 0.0 ? draw_.sign() : -belt_side_;
    const double room_m = 0.5 * road_.width_m - 1.7;
    const Vector3d half_m(draw_.uniform(0.3, 1.5), std::min(0.5 * room_m, draw_.uniform(0.2, 0.6)),
                          draw_.uniform(0.2, 0.8));
    if (half_m.y() < 0.1) return;
    const double x_m = draw_.uniform(-4.0, 5.0), off_m = draw_.uniform(0.02, 0.3) + half_m.y();
    const double y_m = wall_y_m(side, x_m, 0.5) - side * off_m;
    take(side, off_m + half_m.y());
    road_.solids.push_back(box({x_m, y_m, floor_z_m(x_m, y_m) + half_m.z()}, half_m, tilt_rad(4.0)));
  }

  void bench() {
    const double side = draw_.sign(), wide_m = draw_.uniform(0.3, 0.25 * road_.width_m);
    if ((side > 0.0 ? road_.free_left_m : road_.free_right_m) < 0.5 * road_.width_m) return;  // taken
    const double high_m = draw_.uniform(0.15, 0.6), y_m = wall_y_m(side, 0.0, 0.0);
    Solid step = box({-10.0, y_m, floor_z_m(-10.0, y_m) - 0.5 + high_m}, {30.0, wide_m, 0.5}, 0.0);
    step.axes = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), road_.floor.normal).toRotationMatrix();
    step.crumbs = Rock(&draw_, 0.006, 0.5, 0.5);
    road_.solids.push_back(step);
    take(side, wide_m);
  }

  void vehicle() {
    const bool ahead = draw_.chance(0.4) && line_.end_m > 10.0;
    const double half_length_m = draw_.uniform(1.2, 2.5), half_width_m = draw_.uniform(0.6, 0.9);
    const double height_m = draw_.uniform(1.0, std::min(2.2, road_.height_m - 0.4));
    const double x_m = (ahead ? 1.0 : -1.0) * draw_.uniform(4.0 + half_length_m, 9.0);
    const double y_m = draw_.uniform(-1.0, 1.0) * (0.5 * road_.width_m - half_width_m - 0.3);
    const double turn_rad = tilt_rad(8.0), floor_m = floor_z_m(x_m, y_m);
    road_.solids.push_back(
        box({x_m, y_m, floor_m + 0.25 * height_m + 0.1}, {half_length_m, half_width_m, 0.25 * height_m}, turn_rad));
    road_.solids.push_back(box({x_m - 0.4 * half_length_m, y_m, floor_m + 0.5 * height_m},
                               {0.5 * half_length_m, half_width_m, 0.5 * height_m}, turn_rad));
  }

  void take(double side, double room_m) { (side > 0.0 ? road_.free_left_m : road_.free_right_m) -= room_m; }

  void people() {
    for (int k = draw_.whole(1, 3); k > 0; --k) {
      const double x_m = draw_.sign() * draw_.uniform(3.6, 9.0);
      const double y_m = draw_.uniform(-1.0, 1.0) * (0.5 * road_.width_m - 0.4), z_m = floor_z_m(x_m, y_m);
      const double tall_m = draw_.uniform(1.6, 1.9), thick_m = draw_.uniform(0.18, 0.28);
      road_.solids.push_back(cylinder({x_m, y_m, z_m}, {x_m, y_m, z_m + tall_m - 0.25}, thick_m));
      Solid head = box({x_m, y_m, z_m + tall_m - 0.12}, {0.1, 0.1, 0.13}, 0.0);
      head.shape = Shape::kEllipsoid;
      road_.solids.push_back(head);
    }
  }

  void heaps() {
    for (int k = draw_.whole(1, 4); k > 0; --k) {
      const bool at_wall = draw_.chance(0.6);
      const double x_m = at_wall ? draw_.uniform(-8.0, 8.0) : draw_.sign() * draw_.uniform(4.0, 9.0);
      const double side = draw_.sign(), beside_m = at_wall && std::abs(x_m) < 4.0 ? 0.8 : 1.6;
      const Vector3d half_m(draw_.uniform(0.5, 1.8), std::min(draw_.uniform(0.3, beside_m), 0.5 * road_.width_m - 1.5),
                            draw_.uniform(0.15, 0.8));
      const double y_m = at_wall ? wall_y_m(side, x_m, 0.0) : draw_.uniform(-1.0, 1.0);
      Solid heap = box({x_m, y_m, floor_z_m(x_m, y_m)}, half_m, 0.0);
      heap.shape = Shape::kEllipsoid;
      heap.crumbs = Rock(&draw_, 0.012, 0.5, 0.5);
      road_.solids.push_back(heap);
    }
  }

  void puddles() {
    for (int k = draw_.whole(1, 4); k > 0; --k) {
      const double x_m = draw_.uniform(-8.0, 8.0), y_m = draw_.uniform(-0.4, 0.4) * road_.width_m;
      road_.puddles.push_back(
          {{x_m, y_m, floor_z_m(x_m, y_m)}, draw_.uniform(0.3, 2.5), draw_.uniform(0.3, 1.2), draw_.chance(0.4)});
    }
  }

  Road& road_;
  const RoadLine& line_;
  Draw& draw_;
  double belt_side_ = 0.0;
};

}  // namespace

Vector3d on_wall_m(const Plane& plane, double x_m) {
  return {x_m, -(plane.offset_m + plane.normal.x() * x_m) / plane.normal.y(), 0.0};
}

void furnish(Road* road, const RoadLine& line, Draw* draw) {
  Furnisher(road, line, draw).all();
}

}  // namespace pose_wall::judge

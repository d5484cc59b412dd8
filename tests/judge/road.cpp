// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/road.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace pose_wall::judge {
namespace {

constexpr double kBehind_m = -45.0, kAhead_m = 60.0;  // beyond what the engine takes (range_max)
constexpr double kMachineHalfLength_m = 2.25;
constexpr double kOverlap_m = 0.03;  // of neighbouring panels, so that no ray slips between them

struct FeatureRow {
  const char* name;
  double probability;
};
constexpr std::array<FeatureRow, kFeatures> kFeatureTable = {{{"rough_rock", 0.25},
                                                              {"arch", 0.25},
                                                              {"steel_sets", 0.15},
                                                              {"pipes", 0.25},
                                                              {"belt", 0.15},
                                                              {"box", 0.12},
                                                              {"vehicle", 0.12},
                                                              {"people", 0.15},
                                                              {"crosscut", 0.15},
                                                              {"heaps", 0.20},
                                                              {"bench", 0.08},
                                                              {"ramp", 0.10},
                                                              {"bend", 0.12},
                                                              {"puddles", 0.15},
                                                              {"dust", 0.12},
                                                              {"body", 0.60}}};

class Builder {
 public:
  Builder(std::uint64_t seed, bool quiet) : draw_(seed), quiet_(quiet) {
    road_.seed = seed;
    for (std::uint32_t k = 0; k < kFeatures; ++k) {
      const bool has = draw_.chance(kFeatureTable[k].probability);
      if (has && !quiet) road_.features |= 1U << k;
    }
    // The arch would have to bend, too.
    if (road_.has(kArch)) road_.features &= ~(1U << kBend | 1U << kRamp);
    road_.width_m = draw_.uniform(3.5, 6.5);
    road_.height_m = draw_.uniform(2.5, 4.5);
    road_.free_left_m = road_.free_right_m = 0.5 * road_.width_m;
  }

  Road build() {
    planes();
    face_x_m_ = draw_.uniform(5.0, 40.0);
    if (road_.has(kBend)) face_x_m_ = kAhead_m;
    if (road_.has(kCrosscut)) gap();
    if (road_.has(kRamp)) ramp_x_m_ = draw_.uniform(3.0, 9.0);
    floor();
    roof();
    wall(road_.left, 1.0);
    wall(road_.right, -1.0);
    ends();
    if (road_.has(kSteelSets)) steel_sets();
    if (road_.has(kPipes)) pipes();
    if (road_.has(kBelt)) belt();
    if (road_.has(kBox)) box_beside();
    if (road_.has(kBench)) bench();
    if (road_.has(kVehicle)) vehicle();
    if (road_.has(kPeople)) people();
    if (road_.has(kHeaps)) heaps();
    if (road_.has(kPuddles)) puddles();
    if (road_.has(kDust)) road_.dust = {draw_.uniform(0.02, 0.2), draw_.uniform(0.003, 0.04), draw_.uniform(0.5, 2.0)};
    return road_;
  }

 private:
  double tilt_rad(double largest_deg) { return kRadPerDeg * draw_.uniform(-largest_deg, largest_deg); }

  static Plane plane(const Vector3d& normal, const Vector3d& point_m) {
    return {normal.normalized(), -normal.normalized().dot(point_m)};
  }

  // Walls lean, and run apart a little in some roads; the floor has a cross-fall and a slope of its own.
  void planes() {
    road_.floor = plane({tilt_rad(draw_.chance(0.5) || quiet_ ? 0.0 : 1.5), tilt_rad(5.0), 1.0}, Vector3d::Zero());
    const double apart_deg = draw_.chance(0.3) && !quiet_ ? 0.4 : 0.0, lean_deg = draw_.chance(0.5) ? 1.5 : 6.0;
    const double half_m = 0.5 * road_.width_m;
    const double middle_m = 0.4 * road_.height_m;  // where a leaning wall is half a width away
    const double toe_left_rad = tilt_rad(apart_deg), toe_right_rad = tilt_rad(apart_deg);
    road_.left = plane({toe_left_rad, -1.0, tilt_rad(lean_deg)}, {0.0, half_m, middle_m});
    road_.right = plane({toe_right_rad, 1.0, tilt_rad(lean_deg)}, {0.0, -half_m, middle_m});
    roughness_m_ = quiet_ ? 0.0 : road_.has(kRoughRock) ? draw_.uniform(0.008, 0.015) : draw_.uniform(0.0007, 0.006);
  }

  Rock rock() {
    if (quiet_) return Rock();
    const double rms_m = roughness_m_ * draw_.uniform(0.7, 1.3), longest_m = draw_.uniform(0.5, 2.5);
    return Rock(&draw_, rms_m, longest_m, draw_.uniform(0.3, 1.0));
  }

  Rock floor_rock() {
    if (quiet_) return Rock();
    const double rms_m = road_.has(kRoughRock) ? draw_.uniform(0.008, 0.02) : draw_.uniform(0.002, 0.008);
    return Rock(&draw_, rms_m, draw_.uniform(0.4, 2.0), draw_.uniform(0.3, 1.0));
  }

  static Panel panel(const Plane& plane, const Vector3d& along, double u_min_m, double u_max_m, const Rock& rock) {
    const Vector3d origin_in_plane_m = -plane.offset_m * plane.normal;
    return Panel(origin_in_plane_m, plane.normal, along, u_min_m, u_max_m, rock);
  }

  // The floor comes first of all panels: range_m() looks for puddles there.
  void floor() {
    road_.panels.push_back(panel(road_.floor, Vector3d::UnitX(), -1e3, ramp_x_m_, floor_rock()));
    if (!road_.has(kRamp)) return;
    ramp_slope_ = draw_.sign() * std::tan(kRadPerDeg * draw_.uniform(1.0, 5.0));
    add_after_ramp(road_.floor, floor_rock());
  }

  // The same plane with the ramp's slope from where that begins.
  void add_after_ramp(const Plane& before, const Rock& surface) {
    const Vector3d& n = before.normal;
    const Vector3d start_m(ramp_x_m_, 0.0, -(before.offset_m + n.x() * ramp_x_m_) / n.z());
    const Vector3d turned = n / std::abs(n.z()) - Vector3d(ramp_slope_ * (n.z() > 0.0 ? 1.0 : -1.0), 0.0, 0.0);
    road_.panels.emplace_back(start_m, turned, Vector3d::UnitX(), 0.0, 1e3, surface);
  }

  void roof() {
    const Vector3d down = -road_.floor.normal + Vector3d(tilt_rad(1.0), tilt_rad(1.0), 0.0);
    const Plane flat = plane(down, {0.0, 0.0, road_.height_m});
    const Rock surface = rock();
    road_.panels.push_back(panel(flat, Vector3d::UnitX(), -1e3, ramp_x_m_, surface));
    if (road_.has(kRamp)) add_after_ramp(flat, surface);
    if (road_.has(kArch)) arch();
  }

  void arch() {
    // Two chords on either side of the crown, tangents of an ellipse that springs from the walls.
    const double half_m = 0.5 * road_.width_m, rise_m = draw_.uniform(0.25, 0.4) * road_.height_m;
    for (const double side : {1.0, -1.0}) {
      for (const double around_deg : {30.0, 60.0}) {
        const double c = std::cos(kRadPerDeg * around_deg), s = std::sin(kRadPerDeg * around_deg);
        const Vector3d at_m(0.0, side * half_m * c, road_.height_m - rise_m * (1.0 - s));
        const Vector3d inwards(0.0, -side * c / half_m, -s / rise_m);
        road_.panels.push_back(panel(plane(inwards, at_m), Vector3d::UnitX(), -1e3, 1e3, rock()));
        const Plane& wall = side > 0.0 ? road_.left : road_.right;  // a gallery has a roof of its own
        road_.panels.back().clip_normal = -wall.normal;
        road_.panels.back().clip_offset_m = -wall.offset_m;
      }
    }
  }

  void gap() {
    gap_side_ = draw_.sign();
    const double width_m = draw_.uniform(3.0, 5.0), centre_m = draw_.uniform(-9.0, 10.0);
    gap_m_ = {centre_m - 0.5 * width_m, centre_m + 0.5 * width_m};
    face_x_m_ = std::max(face_x_m_, gap_m_[1] + 2.0);
  }

  // Straight up to the face or the bend, with the gallery's opening in it.
  void wall(const Plane& plane, double side) {
    const double end_m = road_.has(kBend) ? bend_x_m() : kAhead_m;
    const Rock surface = rock();
    const bool open = road_.has(kCrosscut) && side == gap_side_;
    if (!open) {
      road_.panels.push_back(panel(plane, Vector3d::UnitX(), kBehind_m, end_m + kOverlap_m, surface));
    } else {
      road_.panels.push_back(panel(plane, Vector3d::UnitX(), kBehind_m, gap_m_[0], surface));
      road_.panels.push_back(panel(plane, Vector3d::UnitX(), gap_m_[1], end_m + kOverlap_m, surface));
      gallery(plane, side);
    }
    if (road_.has(kBend)) bend(plane, side, end_m);
  }

  static Vector3d on_wall_m(const Plane& plane, double x_m) {
    return {x_m, -(plane.offset_m + plane.normal.x() * x_m) / plane.normal.y(), 0.0};
  }

  void gallery(const Plane& plane, double side) {
    const double depth_m = draw_.uniform(4.0, 25.0);
    const Vector3d outwards(tilt_rad(15.0), side, 0.0);
    for (const std::size_t k : {0U, 1U}) {
      const Vector3d corner_m = on_wall_m(plane, gap_m_[k]);
      const Vector3d along = outwards.normalized();
      const Vector3d inwards = (k == 0 ? side : -side) * along.cross(Vector3d::UnitZ());
      road_.panels.emplace_back(corner_m, inwards, along, -0.5, depth_m + 2.0, rock());
      road_.panels.back().clip_normal = plane.normal;  // not in the road itself, however the wall leans
      road_.panels.back().clip_offset_m = plane.offset_m;
    }
    const Vector3d end_m = on_wall_m(plane, 0.5 * (gap_m_[0] + gap_m_[1])) + depth_m * outwards;
    road_.panels.emplace_back(end_m, -outwards, Vector3d::UnitX(), -6.0, 6.0, rock());
  }

  double bend_x_m() {
    if (bend_x_m_ == 0.0) {
      bend_x_m_ = std::max(draw_.uniform(5.0, 15.0), gap_m_[1] + 1.0);
      bend_radius_m_ = draw_.sign() * draw_.uniform(12.0, 60.0);
    }
    return bend_x_m_;
  }

  // A chain of straight pieces about the bend's centre at the left (positive radius) or at the right.
  void bend(const Plane& plane, double side, double start_m) {
    const double piece_rad = 1.5 / bend_radius_m_, radius_m = std::abs(bend_radius_m_ - side * 0.5 * road_.width_m);
    const double piece_m = radius_m * std::abs(piece_rad);
    Vector3d corner_m = on_wall_m(plane, start_m);
    const int pieces = std::min(12, static_cast<int>(kPi / 2.0 / std::abs(piece_rad)));
    const Rock surface = rock();
    for (int k = 1; k <= pieces; ++k) {
      const Vector3d along(std::cos(k * piece_rad), std::sin(k * piece_rad), 0.0);
      const double length_m = k == pieces ? 40.0 : piece_m;
      const Vector3d inwards = side * along.cross(Vector3d::UnitZ()) + plane.normal.z() * Vector3d::UnitZ();
      road_.panels.emplace_back(corner_m, inwards, along, -kOverlap_m, length_m + kOverlap_m, surface);
      corner_m += length_m * along;
    }
  }

  void ends() {
    const double across = tilt_rad(12.0);
    road_.panels.emplace_back(Vector3d(face_x_m_, 0.0, 0.0), Vector3d(-1.0, across, tilt_rad(8.0)), Vector3d::UnitY(),
                              -12.0, 12.0, rock());
    if (draw_.chance(0.5)) return;  // open behind
    const double back_m = draw_.uniform(-40.0, -8.0);
    road_.panels.emplace_back(Vector3d(back_m, 0.0, 0.0), Vector3d(1.0, across, 0.0), Vector3d::UnitY(), -12.0, 12.0,
                              rock());
  }

  // The wall's y at a place, by the plane that is true there.
  double wall_y_m(double side, double x_m, double z_m) const {
    const Plane& plane = side > 0.0 ? road_.left : road_.right;
    return on_wall_m(plane, x_m).y() - plane.normal.z() * z_m / plane.normal.y();
  }
  double floor_z_m(double x_m, double y_m) const {
    const Vector3d& n = road_.floor.normal;
    return -(n.x() * x_m + n.y() * y_m) / n.z() + ramp_slope_ * std::max(0.0, x_m - ramp_x_m_);
  }
  double straight_end_m() { return std::min(face_x_m_, road_.has(kBend) ? bend_x_m() : 30.0); }

  void steel_sets() {
    const double spacing_m = draw_.uniform(0.7, 1.5), depth_m = draw_.uniform(0.04, 0.1);
    const double half_width_m = draw_.uniform(0.04, 0.08);
    for (double x_m = -16.0 + draw_.uniform(0.0, 1.0); x_m < std::min(16.0, straight_end_m()); x_m += spacing_m) {
      for (const double side : {1.0, -1.0}) {
        const bool in_gap = road_.has(kCrosscut) && side == gap_side_ && x_m > gap_m_[0] && x_m < gap_m_[1];
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
    const double side = draw_.sign(), end_m = std::min(20.0, straight_end_m());
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
    const bool ahead = draw_.chance(0.4) && straight_end_m() > 10.0;
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

  Draw draw_;
  bool quiet_;
  Road road_;
  double roughness_m_ = 0.0, face_x_m_ = 0.0, gap_side_ = 0.0, bend_x_m_ = 0.0, bend_radius_m_ = 0.0;
  double belt_side_ = 0.0, ramp_x_m_ = 1e3, ramp_slope_ = 0.0;
  std::array<double, 2> gap_m_ = {kBehind_m, -1.0};
};

const Puddle* puddle_at(const Road& road, const Vector3d& at_m) {
  for (const Puddle& puddle : road.puddles) {
    const Vector3d off_m = at_m - puddle.centre_m;
    const double x = off_m.x() / puddle.half_x_m, y = off_m.y() / puddle.half_y_m;
    if (x * x + y * y < 1.0) return &puddle;
  }
  return nullptr;
}

constexpr double kNoHit_m = 1e6;

// The nearest surface, and whether that is the floor.
double first_hit_m(const Road& road, const std::vector<Solid>& body, const Ray& ray, bool* floor) {
  double nearest_m = kNoHit_m;
  for (const Panel& panel : road.panels) {
    const double hit_m = panel.hit_m(ray, nearest_m);
    if (hit_m < nearest_m) *floor = &panel == road.panels.data();
    nearest_m = hit_m;
  }
  const double rock_m = nearest_m;
  for (const Solid& solid : road.solids) nearest_m = std::min(nearest_m, solid.hit_m(ray, nearest_m));
  for (const Solid& solid : body) nearest_m = std::min(nearest_m, solid.hit_m(ray, nearest_m));
  *floor = *floor && nearest_m == rock_m;
  return nearest_m;
}

}  // namespace

const char* feature_name(std::uint32_t feature) {
  return kFeatureTable.at(feature).name;
}

Road draw_road(std::uint64_t seed, bool quiet) {
  return Builder(seed, quiet).build();
}

double range_m(const Road& road, const std::vector<Solid>& body, const Ray& ray, Draw* draw) {
  bool floor = false;
  double hit_m = first_hit_m(road, body, ray, &floor);
  if (hit_m == kNoHit_m) return 0.0;
  const Puddle* puddle = floor ? puddle_at(road, ray.origin_m + hit_m * ray.direction) : nullptr;
  if (puddle != nullptr) {
    if (!puddle->mirrors) return 0.0;
    // The sensor sees the way by the mirror as one straight way.
    const Vector3d& n = road.floor.normal;
    Ray onwards = {ray.origin_m + hit_m * ray.direction, ray.direction - 2.0 * n.dot(ray.direction) * n};
    onwards.origin_m += 0.1 * onwards.direction;
    hit_m += 0.1 + first_hit_m(road, body, onwards, &floor);
    if (hit_m >= kNoHit_m) return 0.0;
  }
  if (!road.has(kDust)) return hit_m;
  if (draw->chance(road.dust.lost)) return 0.0;
  if (draw->chance(road.dust.near)) {
    return std::min(hit_m, -road.dust.depth_m * std::log(draw->uniform(1e-9, 1.0)));
  }
  return hit_m;
}

}  // namespace pose_wall::judge

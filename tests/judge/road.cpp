// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/road.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "judge/furnish.hpp"

namespace pose_wall::judge {
namespace {

constexpr double kBehind_m = -45.0, kAhead_m = 60.0;  // beyond what the engine takes (range_max)
constexpr double kRicher = 3.0;                       // times as rough: up to the 5 cm of a gallery that was blasted
constexpr double kDustier = 5.0;     // as many rays end in dust: a fifth, at most, behind a cutting head
constexpr double kOverlap_m = 0.03;  // of neighbouring panels, so that no ray slips between them

struct FeatureRow {
  const char* name;
  double probability, in_rich;
};
constexpr std::array<FeatureRow, kFeatures> kFeatureTable = {{{"rough_rock", 0.25, 0.75},
                                                              {"arch", 0.25, 0.50},
                                                              {"steel_sets", 0.15, 0.30},
                                                              {"pipes", 0.25, 0.50},
                                                              {"belt", 0.15, 0.30},
                                                              {"box", 0.12, 0.24},
                                                              {"vehicle", 0.12, 0.24},
                                                              {"people", 0.15, 0.30},
                                                              {"crosscut", 0.15, 0.30},
                                                              {"heaps", 0.20, 0.40},
                                                              {"bench", 0.08, 0.16},
                                                              {"ramp", 0.10, 0.20},
                                                              {"bend", 0.12, 0.24},
                                                              {"puddles", 0.15, 0.30},
                                                              {"dust", 0.12, 0.60},
                                                              {"body", 0.60, 0.60}}};

class Builder {
 public:
  Builder(std::uint64_t seed, Furnishing furnishing)
      : draw_(seed), quiet_(furnishing == Furnishing::kQuiet), rich_(furnishing == Furnishing::kRich) {
    road_.seed = seed;
    for (std::uint32_t k = 0; k < kFeatures; ++k) {
      const bool has = draw_.chance(rich_ ? kFeatureTable[k].in_rich : kFeatureTable[k].probability);
      if (has && !quiet_) road_.features |= 1U << k;
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
    if (road_.has(kRamp)) line_.ramp_x_m = draw_.uniform(3.0, 9.0);
    floor();
    roof();
    wall(road_.left, 1.0);
    wall(road_.right, -1.0);
    ends();
    line_.end_m = std::min(face_x_m_, road_.has(kBend) ? bend_x_m() : 30.0);
    road_.room_ahead_m = std::min(line_.end_m, line_.ramp_x_m);
    furnish(&road_, line_, &draw_);
    if (road_.has(kDust)) road_.dust = {draw_.uniform(0.02, 0.2), draw_.uniform(0.003, 0.04), draw_.uniform(0.5, 2.0)};
    if (rich_) road_.dust = {road_.dust.lost, kDustier * road_.dust.near, kRicher * road_.dust.depth_m};
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
    if (rich_) roughness_m_ *= kRicher;
  }

  Rock rock() {
    if (quiet_) return Rock();
    const double rms_m = roughness_m_ * draw_.uniform(0.7, 1.3), longest_m = draw_.uniform(0.5, 2.5);
    return Rock(&draw_, rms_m, longest_m, draw_.uniform(0.3, 1.0));
  }

  Rock floor_rock() {
    if (quiet_) return Rock();
    const double rms_m = road_.has(kRoughRock) ? draw_.uniform(0.008, 0.02) : draw_.uniform(0.002, 0.008);
    return Rock(&draw_, rich_ ? kRicher * rms_m : rms_m, draw_.uniform(0.4, 2.0), draw_.uniform(0.3, 1.0));
  }

  static Panel panel(const Plane& plane, const Vector3d& along, double u_min_m, double u_max_m, const Rock& rock) {
    const Vector3d origin_in_plane_m = -plane.offset_m * plane.normal;
    return Panel(origin_in_plane_m, plane.normal, along, u_min_m, u_max_m, rock);
  }

  // The floor comes first of all panels: range_m() looks for puddles there.
  void floor() {
    road_.panels.push_back(panel(road_.floor, Vector3d::UnitX(), -1e3, line_.ramp_x_m, floor_rock()));
    if (!road_.has(kRamp)) return;
    line_.ramp_slope = draw_.sign() * std::tan(kRadPerDeg * draw_.uniform(1.0, 5.0));
    add_after_ramp(road_.floor, floor_rock());
  }

  // The same plane with the ramp's slope from where that begins.
  void add_after_ramp(const Plane& before, const Rock& surface) {
    const Vector3d& n = before.normal;
    const Vector3d start_m(line_.ramp_x_m, 0.0, -(before.offset_m + n.x() * line_.ramp_x_m) / n.z());
    const Vector3d turned = n / std::abs(n.z()) - Vector3d(line_.ramp_slope * (n.z() > 0.0 ? 1.0 : -1.0), 0.0, 0.0);
    road_.panels.emplace_back(start_m, turned, Vector3d::UnitX(), 0.0, 1e3, surface);
  }

  void roof() {
    const Vector3d down = -road_.floor.normal + Vector3d(tilt_rad(1.0), tilt_rad(1.0), 0.0);
    const Plane flat = plane(down, {0.0, 0.0, road_.height_m});
    const Rock surface = rock();
    road_.panels.push_back(panel(flat, Vector3d::UnitX(), -1e3, line_.ramp_x_m, surface));
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
    line_.gap_side = draw_.sign();
    const double width_m = draw_.uniform(3.0, 5.0), centre_m = draw_.uniform(-9.0, 10.0);
    line_.gap_m = {centre_m - 0.5 * width_m, centre_m + 0.5 * width_m};
    face_x_m_ = std::max(face_x_m_, line_.gap_m[1] + 2.0);
  }

  // Straight up to the face or the bend, with the gallery's opening in it.
  void wall(const Plane& plane, double side) {
    const double end_m = road_.has(kBend) ? bend_x_m() : kAhead_m;
    const Rock surface = rock();
    const bool open = road_.has(kCrosscut) && side == line_.gap_side;
    if (!open) {
      road_.panels.push_back(panel(plane, Vector3d::UnitX(), kBehind_m, end_m + kOverlap_m, surface));
    } else {
      road_.panels.push_back(panel(plane, Vector3d::UnitX(), kBehind_m, line_.gap_m[0], surface));
      road_.panels.push_back(panel(plane, Vector3d::UnitX(), line_.gap_m[1], end_m + kOverlap_m, surface));
      gallery(plane, side);
    }
    if (road_.has(kBend)) bend(plane, side, end_m);
  }

  void gallery(const Plane& plane, double side) {
    const double depth_m = draw_.uniform(4.0, 25.0);
    const Vector3d outwards(tilt_rad(15.0), side, 0.0);
    for (const std::size_t k : {0U, 1U}) {
      const Vector3d corner_m = on_wall_m(plane, line_.gap_m[k]);
      const Vector3d along = outwards.normalized();
      const Vector3d inwards = (k == 0 ? side : -side) * along.cross(Vector3d::UnitZ());
      road_.panels.emplace_back(corner_m, inwards, along, -0.5, depth_m + 2.0, rock());
      road_.panels.back().clip_normal = plane.normal;  // not in the road itself, however the wall leans
      road_.panels.back().clip_offset_m = plane.offset_m;
    }
    const Vector3d end_m = on_wall_m(plane, 0.5 * (line_.gap_m[0] + line_.gap_m[1])) + depth_m * outwards;
    road_.panels.emplace_back(end_m, -outwards, Vector3d::UnitX(), -6.0, 6.0, rock());
  }

  double bend_x_m() {
    if (bend_x_m_ == 0.0) {
      bend_x_m_ = std::max(draw_.uniform(5.0, 15.0), line_.gap_m[1] + 1.0);
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

  Draw draw_;
  bool quiet_, rich_;
  Road road_;
  double roughness_m_ = 0.0, face_x_m_ = 0.0, bend_x_m_ = 0.0, bend_radius_m_ = 0.0;
  RoadLine line_;
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

Road draw_road(std::uint64_t seed, Furnishing furnishing) {
  return Builder(seed, furnishing).build();
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

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A road with a rough floor, rough walls and a roof; things in it that move or stand; dust; wet places. Cast by ray.
// Floor and walls are waves, or real rock. The road is straight, or it bends to the left.

#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "planar/encounter/draw.hpp"
#include "planar/encounter/rock.hpp"

namespace pose_wall::test {

struct Vec3 {
  float x, y, z;
};

// Of a turn in 4096 steps: the casts' waves need no better one.
class QuickSine {
 public:
  QuickSine() {
    for (int k = 0; k < 4096; ++k) table_[k] = static_cast<float>(std::sin(k * (6.283185307179586 / 4096.0)));
  }
  float operator()(float rad) const {
    return table_[static_cast<std::uint32_t>(static_cast<std::int32_t>(rad * (4096.0F / 6.2831853F) + 524288.0F)) &
                  4095U];
  }

 private:
  float table_[4096];
};

inline const QuickSine& quick_sine() {
  static const QuickSine sine;
  return sine;
}

// An upright cylinder (half_x is its radius, half_y < 0) or a box turned about the vertical, from bottom to top.
struct Thing {
  double x_m, y_m, yaw_rad;
  double half_x_m, half_y_m;
  double bottom_m, top_m;
  double velocity_x_m_s = 0.0, velocity_y_m_s = 0.0;
  double walks_from_s = 0.0, walks_until_s = 0.0;
  bool is_person = false;

  bool is_round() const { return half_y_m < 0.0; }
  double reach_m() const { return is_round() ? half_x_m : std::hypot(half_x_m, half_y_m); }
  void step(double from_s, double seconds) {
    if (from_s < walks_from_s || from_s >= walks_until_s) return;
    x_m += seconds * velocity_x_m_s;
    y_m += seconds * velocity_y_m_s;
  }
};

struct Dust {
  double x_m, y_m, z_m, radius_m;
  double per_m;  // chance of a return per metre of ray
};

struct Puddle {
  double x_min, x_max, y_min, y_max;
  bool mirrors;
};

struct World {
  double half_width_m = 2.5, roof_m = 3.2;
  double floor_wave_m = 0.02, floor_length_m = 6.0, floor_phase = 0.0, floor_rough_m = 0.01;
  double wall_wave_m = 0.08, wall_length_m = 1.5, wall_phase = 0.0;
  double face_m = 60.0;              // the heading
  double bend_rad_m = 0.0;           // to the left; a bend has no heading
  std::shared_ptr<const Rock> rock;  // in place of the waves
  std::vector<Thing> things;
  std::vector<Dust> dust;
  std::vector<Puddle> puddles;

  float floor_at(float x, float y) const {
    if (rock != nullptr) return rock->floor_at(along_at(x, y), across_at(x, y));
    const float k = 6.2831853F / static_cast<float>(floor_length_m);
    return static_cast<float>(floor_wave_m) * (*sine_)(k * x + 0.6F * k * y + static_cast<float>(floor_phase));
  }
  // How the floor carries a machine: its height, and its slopes along x and y.
  struct Rest {
    double height_m, along, across;
  };
  Rest rest_at(double x, double y) const;
  float wall_at(float x) const {
    const float k = 6.2831853F / static_cast<float>(wall_length_m);
    return static_cast<float>(half_width_m) +
           static_cast<float>(wall_wave_m) * (*sine_)(k * x + static_cast<float>(wall_phase));
  }

  // How deep in the rock of a wall a place is, negative in the road.
  float depth_in_rock(const Vec3& at) const {
    const float across = across_at(at.x, at.y);
    return std::fabs(across) - static_cast<float>(half_width_m) +
           rock->wall_at(across > 0.0F, along_at(at.x, at.y), at.z);
  }
  // Range of a ray (unit direction), 0 without a return.
  float cast(const Vec3& from, const Vec3& d, Draw* draw) const;

 private:
  const QuickSine* sine_ = &quick_sine();

  // From the middle of the road to its left, and along it.
  float across_at(float x, float y) const {
    if (bend_rad_m == 0.0) return y;
    const float radius_m = static_cast<float>(1.0 / bend_rad_m);
    return radius_m - std::hypot(x, radius_m - y);
  }
  float along_at(float x, float y) const {
    if (bend_rad_m == 0.0) return x;
    // The seam of the full turn lies a radian behind the start.
    const float radius_m = static_cast<float>(1.0 / bend_rad_m), turned = std::atan2(x, radius_m - y);
    return radius_m * (turned < -1.0F ? turned + 6.2831853F : turned);
  }
  float leaves(const Vec3& from, const Vec3& d, float half_m) const;
  float to_wall(const Vec3& from, const Vec3& d, float most) const;
  float to_waves(const Vec3& from, const Vec3& d, float most) const;
  float to_floor(const Vec3& from, const Vec3& d, float most) const;
  float to_road(const Vec3& from, const Vec3& d, float most, bool* is_floor) const;
  float to_thing(const Thing& thing, const Vec3& from, const Vec3& d, float most) const;
  bool is_wet(float x, float y, bool* mirrors) const {
    for (const Puddle& p : puddles) {
      if (x >= p.x_min && x <= p.x_max && y >= p.y_min && y <= p.y_max) {
        *mirrors = p.mirrors;
        return true;
      }
    }
    return false;
  }
};

inline World::Rest World::rest_at(double x, double y) const {
  if (rock == nullptr) {
    const double k = 6.2831853 / floor_length_m, c = floor_wave_m * k * std::cos(k * x + 0.6 * k * y + floor_phase);
    return {static_cast<double>(floor_at(static_cast<float>(x), static_cast<float>(y))), c, 0.6 * c};
  }
  // A plane through what lies under tracks.
  constexpr double kAround_m = 1.2;
  constexpr int kPlaces = 12;
  Rest rest{0.0, 0.0, 0.0};
  for (int k = 0; k < kPlaces; ++k) {
    const double dx = kAround_m * std::cos(6.2831853 * k / kPlaces), dy = kAround_m * std::sin(6.2831853 * k / kPlaces);
    const double h = static_cast<double>(floor_at(static_cast<float>(x + dx), static_cast<float>(y + dy))) / kPlaces;
    rest.height_m += h, rest.along += 2.0 * h * dx / (kAround_m * kAround_m);
    rest.across += 2.0 * h * dy / (kAround_m * kAround_m);
  }
  return rest;
}

// How far a ray goes until it leaves a corridor of this half width, in which it starts.
inline float World::leaves(const Vec3& from, const Vec3& d, float half_m) const {
  constexpr float kNever_m = 1e4F;
  const float level2 = d.x * d.x + d.y * d.y;
  if (level2 < 1e-8F) return kNever_m;
  if (bend_rad_m == 0.0) {
    if (std::fabs(d.y) < 1e-4F) return kNever_m;
    return ((d.y > 0.0F ? half_m : -half_m) - from.y) / d.y;
  }
  // Out of the outer circle, or before that into the inner one.
  const float radius_m = static_cast<float>(1.0 / bend_rad_m), x = from.x, y = from.y - radius_m;
  const float b = (x * d.x + y * d.y) / level2, c = (x * x + y * y) / level2;
  const auto root_of = [&](float r) { return b * b - c + r * r / level2; };
  const float inner = root_of(radius_m - half_m), outer = root_of(radius_m + half_m);
  if (inner > 0.0F && -b - std::sqrt(inner) > 0.0F) return -b - std::sqrt(inner);
  return outer > 0.0F ? -b + std::sqrt(outer) : 0.0F;
}

// The waves' wall by two steps; rock by many, from where the first may be.
inline float World::to_wall(const Vec3& from, const Vec3& d, float most) const {
  const auto at = [&](float t) { return Vec3{from.x + t * d.x, from.y + t * d.y, from.z + t * d.z}; };
  if (rock == nullptr) {
    float t = leaves(from, d, static_cast<float>(half_width_m));
    for (int k = 0; k < 2 && t < 2.0F * most; ++k) t = leaves(from, d, wall_at(along_at(at(t).x, at(t).y)));
    return std::fmin(t, most);
  }
  const float out_m = std::fmax(rock->wall(true).highest_m(), rock->wall(false).highest_m());
  const float clear_m = static_cast<float>(half_width_m) - out_m;
  float t = std::fmax(leaves(from, d, clear_m), 0.0F), before = t;
  for (int k = 0; before < most && k < 200; ++k) {  // 200 steps lead 80 m far
    t = std::fmin(t, most);
    const float depth_m = depth_in_rock(at(t));
    if (depth_m > 0.0F) {
      for (int halves = 0; halves < 5; ++halves) {
        const float middle = 0.5F * (before + t);
        (depth_in_rock(at(middle)) > 0.0F ? t : before) = middle;
      }
      return t;
    }
    before = t;
    const Vec3 here = at(t);
    constexpr float kOfGap = 0.3F;  // blocks have steep edges
    t += std::fmax(0.04F + 0.01F * t, -kOfGap * depth_m);
    constexpr float kInside_m = 0.01F;  // on the corridor's edge rounding could take either side for the next one
    if (std::fabs(across_at(here.x, here.y)) < clear_m - kInside_m) t = std::fmax(t, before + leaves(here, d, clear_m));
  }
  return most;
}

// Of a ray that falls.
inline float World::to_floor(const Vec3& from, const Vec3& d, float most) const {
  const float per_z = 1.0F / d.z;
  if (rock == nullptr) {
    float at = -from.z * per_z;
    for (int k = 0; k < 2; ++k) at = (floor_at(from.x + at * d.x, from.y + at * d.y) - from.z) * per_z;
    return at;
  }
  const auto height_at = [&](float t) { return from.z + t * d.z - floor_at(from.x + t * d.x, from.y + t * d.y); };
  const float end = std::fmin((rock->floor().lowest_m() - from.z) * per_z, most);
  float t = std::fmax((rock->floor().highest_m() - from.z) * per_z, 0.0F), before = t;
  constexpr float kSteepest = 0.5F;
  const float per_height = 1.0F / (kSteepest - d.z);
  for (float height_m = height_at(t); t < end && height_m > 0.0F; height_m = height_at(t)) {
    before = t;
    t += std::fmax(0.03F + 0.01F * t, per_height * height_m);
  }
  t = std::fmin(t, end);
  for (int halves = 0; halves < 5; ++halves) {
    const float middle = 0.5F * (before + t);
    (height_at(middle) > 0.0F ? before : t) = middle;
  }
  return t;
}

// The waves of a straight road, by one step.
inline float World::to_waves(const Vec3& from, const Vec3& d, float most) const {
  const float wall_m = static_cast<float>(half_width_m - wall_wave_m);
  if (!(std::fabs(from.y + most * d.y) > wall_m && std::fabs(d.y) > 1e-4F)) return most;
  const float side = d.y > 0.0F ? 1.0F : -1.0F;
  const float mean = (side * static_cast<float>(half_width_m) - from.y) / d.y;
  const float at = (side * wall_at(from.x + mean * d.x) - from.y) / d.y;
  return at > 0.0F && at < most ? at : most;
}

inline float World::to_road(const Vec3& from, const Vec3& d, float most, bool* is_floor) const {
  float t = most;
  *is_floor = false;
  if (d.z < -1e-4F) {
    const float at = to_floor(from, d, most);
    if (at > 0.0F && at < t) t = at, *is_floor = true;
  } else if (d.z > 1e-4F) {
    const float at = (static_cast<float>(roof_m) - from.z) / d.z;
    if (at < t) t = at;
  }
  const bool is_by_steps = rock != nullptr || bend_rad_m != 0.0;
  const float wall = is_by_steps ? to_wall(from, d, t) : to_waves(from, d, t);
  if (wall < t) t = wall, *is_floor = false;
  if (d.x > 1e-4F && bend_rad_m == 0.0) {
    const float at = (static_cast<float>(face_m) - from.x) / d.x;
    if (at > 0.0F && at < t) t = at, *is_floor = false;
  }
  return t;
}

inline float World::to_thing(const Thing& thing, const Vec3& from, const Vec3& d, float most) const {
  const float dx = from.x - static_cast<float>(thing.x_m), dy = from.y - static_cast<float>(thing.y_m);
  const float past = dx * d.y - dy * d.x, reach = static_cast<float>(thing.reach_m());
  if (past * past > reach * reach * (d.x * d.x + d.y * d.y)) return most;  // it passes beside all of it
  float enter = 0.0F, leave = most;
  const auto slab = [&](float p, float v, float low, float high) {
    if (std::fabs(v) < 1e-7F) {
      if (p < low || p > high) leave = -1.0F;
      return;
    }
    const float a = (low - p) / v, b = (high - p) / v;
    const float first = a < b ? a : b, last = a < b ? b : a;
    enter = enter > first ? enter : first;
    leave = leave < last ? leave : last;
  };
  if (thing.is_round()) {
    const auto r = static_cast<float>(thing.half_x_m);
    const float a = d.x * d.x + d.y * d.y, b = dx * d.x + dy * d.y, c = dx * dx + dy * dy - r * r;
    const float under = b * b - a * c;
    if (!(under > 0.0F && a > 1e-9F)) return most;
    const float root = std::sqrt(under);
    const float first = (-b - root) / a, last = (-b + root) / a;
    enter = enter > first ? enter : first;
    leave = leave < last ? leave : last;
  } else {
    const auto cs = static_cast<float>(std::cos(thing.yaw_rad)), sn = static_cast<float>(std::sin(thing.yaw_rad));
    const auto hx = static_cast<float>(thing.half_x_m), hy = static_cast<float>(thing.half_y_m);
    slab(cs * dx + sn * dy, cs * d.x + sn * d.y, -hx, hx);
    slab(cs * dy - sn * dx, cs * d.y - sn * d.x, -hy, hy);
  }
  slab(from.z, d.z, static_cast<float>(thing.bottom_m), static_cast<float>(thing.top_m));
  return enter < leave && enter > 0.0F ? enter : most;
}

inline float World::cast(const Vec3& from, const Vec3& d, Draw* draw) const {
  constexpr float kMost = 100.0F;  // the sensor's reach
  bool is_floor = false;
  float t = to_road(from, d, kMost, &is_floor);
  for (const Thing& thing : things) {
    const float at = to_thing(thing, from, d, t);
    if (at < t) t = at, is_floor = false;
  }
  for (const Dust& cloud : dust) {
    const float dx = from.x - static_cast<float>(cloud.x_m), dy = from.y - static_cast<float>(cloud.y_m);
    const float dz = from.z - static_cast<float>(cloud.z_m), r = static_cast<float>(cloud.radius_m);
    const float b = dx * d.x + dy * d.y + dz * d.z, under = b * b - (dx * dx + dy * dy + dz * dz - r * r);
    if (!(under > 0.0F)) continue;
    const float root = std::sqrt(under), first = std::fmax(-b - root, 0.0F);
    const float at = first - std::log(draw->quick_share() + 1e-9F) / static_cast<float>(cloud.per_m);
    if (-b + root > 0.0F && at < -b + root && at < t) t = at, is_floor = false;
  }
  if (t >= kMost) return 0.0F;
  if (is_floor) {
    bool mirrors = false;
    const float x = from.x + t * d.x, y = from.y + t * d.y;
    if (is_wet(x, y, &mirrors)) {
      if (!mirrors) return 0.0F;
      const Vec3 at{x, y, floor_at(x, y) + 1e-3F}, up{d.x, d.y, -d.z};
      bool again = false;
      float further = to_road(at, up, kMost, &again);
      for (const Thing& thing : things) further = std::fmin(further, to_thing(thing, at, up, further));
      return further < kMost ? t + further : 0.0F;
    }
    if (d.z < 0.0F) t += static_cast<float>(floor_rough_m) * draw->quick_normal() / d.z;
  }
  return t;
}

}  // namespace pose_wall::test

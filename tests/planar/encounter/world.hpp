// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A road with a rough floor, rough walls and a roof; things in it that move or stand; dust; wet places. Cast by ray.

#pragma once

#include <cmath>
#include <vector>

#include "planar/encounter/draw.hpp"

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
  double face_m = 60.0;  // the heading
  std::vector<Thing> things;
  std::vector<Dust> dust;
  std::vector<Puddle> puddles;

  float floor_at(float x, float y) const {
    const float k = 6.2831853F / static_cast<float>(floor_length_m);
    return static_cast<float>(floor_wave_m) * (*sine_)(k * x + 0.6F * k * y + static_cast<float>(floor_phase));
  }
  // Slopes of the floor along x and y.
  void slopes_at(double x, double y, double* along, double* across) const {
    const double k = 6.2831853 / floor_length_m, c = floor_wave_m * k * std::cos(k * x + 0.6 * k * y + floor_phase);
    *along = c, *across = 0.6 * c;
  }
  float wall_at(float x) const {
    const float k = 6.2831853F / static_cast<float>(wall_length_m);
    return static_cast<float>(half_width_m) +
           static_cast<float>(wall_wave_m) * (*sine_)(k * x + static_cast<float>(wall_phase));
  }

  // Range of a ray (unit direction), 0 without a return.
  float cast(const Vec3& from, const Vec3& d, Draw* draw) const;

 private:
  const QuickSine* sine_ = &quick_sine();

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

inline float World::to_road(const Vec3& from, const Vec3& d, float most, bool* is_floor) const {
  float t = most;
  *is_floor = false;
  if (d.z < -1e-4F) {
    const float per_z = 1.0F / d.z;
    float at = -from.z * per_z;
    for (int k = 0; k < 2; ++k) at = (floor_at(from.x + at * d.x, from.y + at * d.y) - from.z) * per_z;
    if (at > 0.0F && at < t) t = at, *is_floor = true;
  } else if (d.z > 1e-4F) {
    const float at = (static_cast<float>(roof_m) - from.z) / d.z;
    if (at < t) t = at;
  }
  const float wall_m = static_cast<float>(half_width_m - wall_wave_m);
  if (std::fabs(from.y + t * d.y) > wall_m && std::fabs(d.y) > 1e-4F) {
    const float side = d.y > 0.0F ? 1.0F : -1.0F;
    float at = (side * static_cast<float>(half_width_m) - from.y) / d.y;
    at = (side * wall_at(from.x + at * d.x) - from.y) / d.y;
    if (at > 0.0F && at < t) t = at, *is_floor = false;
  }
  if (d.x > 1e-4F) {
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

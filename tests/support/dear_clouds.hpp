// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Clouds that cost much, and roads of as many points to compare with: what a search found (fuzz/climb.cpp), what was
// thought out against the engine, and halls whose every surface is rough, by sixteen numbers each.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "pose_wall.h"

namespace pose_wall::test {

// Own numbers and no library's distributions: the same clouds everywhere.
class PlainRandom {
 public:
  explicit PlainRandom(std::uint32_t seed) : state_(seed) {}
  double uniform() {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8) / 16777216.0;
  }
  double normal() {
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum - 6.0;
  }

 private:
  std::uint32_t state_;
};

class DearCloud {
 public:
  static constexpr std::uint32_t kRoom = 300000;

  ~DearCloud() { std::free(points_); }
  DearCloud() : points_(static_cast<Point*>(std::malloc(kRoom * sizeof(Point)))) {}
  DearCloud(const DearCloud&) = delete;
  DearCloud& operator=(const DearCloud&) = delete;

  void clear() { count_ = 0; }
  void put(double x, double y, double z) {
    if (count_ == kRoom) return;
    points_[count_++] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 1.0F};
  }
  void put_again(std::uint32_t i) {
    if (count_ < kRoom) points_[count_++] = points_[i];
  }
  void keep_first(std::uint32_t points) { count_ = count_ < points ? count_ : points; }
  std::uint32_t size() const { return count_; }
  pose_wall_cloud at(std::int64_t stamp_ns) const {
    pose_wall_cloud cloud;
    std::memset(&cloud, 0, sizeof cloud);
    pose_wall_cloud_xyz32(&cloud, points_, count_, sizeof(Point), stamp_ns);
    return cloud;
  }
  // Not the very same points: what has come before would be known again.
  void nudge() { points_[0].x += 0.02F; }

 private:
  struct Point {
    float x, y, z, intensity;
  };
  Point* points_;
  std::uint32_t count_ = 0;
};

// A straight road, scanned by rays at even angles from where the machine stands, turned by three degrees.
inline void fill_road(std::uint32_t points, DearCloud* out) {
  constexpr double kPi = 3.14159265358979, kHalfWidth_m = 2.4, kFloor_m = -1.2, kRoof_m = 2.0, kYaw_rad = 3 * kPi / 180;
  constexpr std::uint32_t kRings = 64;
  PlainRandom random(12345);
  const std::uint32_t turns = points / kRings;
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t k = 0; k < turns; ++k) {
      const double up = (-22.5 + 45.0 * ring / (kRings - 1)) * kPi / 180.0, around = 2.0 * kPi * k / turns;
      const double x = std::cos(up) * std::cos(around), y = std::cos(up) * std::sin(around), z = std::sin(up);
      const double to_wall = kHalfWidth_m / std::fmax(std::fabs(y), 1e-9);
      const double to_level = (z < 0.0 ? kFloor_m : kRoof_m) / (std::fabs(z) < 1e-9 ? 1e-9 : z);
      const double nearest = std::fmin(to_wall, to_level);
      if (nearest > 60.0) continue;
      const double range = nearest + 0.01 * random.normal(), c = std::cos(kYaw_rad), s = std::sin(kYaw_rad);
      out->put(range * (c * x + s * y), range * (c * y - s * x), range * z);
    }
  }
}

// Each of the numbers lies between 0 and 1.
struct Hall {
  static constexpr std::size_t kNumbers = 16;
  std::array<double, kNumbers> v{};
  std::uint32_t seed = 1;

  // Drawn as others draw them: whoever runs their seeds finds the same halls.
  static Hall drawn(std::uint32_t seed) {
    Hall hall;
    hall.seed = seed;
    PlainRandom random(seed * 2654435761U + 1U);
    for (double& number : hall.v) number = random.uniform();
    return hall;
  }

  void fill(std::uint32_t points, DearCloud* out) const {
    PlainRandom random(seed * 2654435761U + 1U);
    for (std::size_t k = 0; k < kNumbers; ++k) static_cast<void>(random.uniform());
    const double length = 8 + 24 * v[0], half = 1.5 + 3 * v[1], wave = 0.4 * v[2], per_m = 1 + 8 * v[3];
    const double ripple = 0.3 * v[4], ripples_per_m = 8 + 20 * v[5], noise = 0.002 + 0.06 * v[6] * v[6];
    const double floor_share = 0.1 + 0.5 * v[7], floor_wave = 0.3 * v[8], floor_per_m = 1 + 6 * v[9];
    const double floor_noise = 0.002 + 0.05 * v[10] * v[10], height = 2 + 2 * v[11], floor = -0.6 - 1.2 * v[12];
    const double step = 0.3 * v[13], steps_apart = 0.8 + 1.5 * v[14];
    const bool denser_here = v[15] < 0.5;
    while (out->size() < points && out->size() < DearCloud::kRoom) {
      const double what = random.uniform();
      double x = length * (2 * random.uniform() - 1);
      if (denser_here) {
        x = length * (2 * random.uniform() - 1);
        x *= random.uniform();
      }
      if (what < floor_share) {
        const double y = half * (2 * random.uniform() - 1);
        out->put(x, y, floor + floor_wave * std::sin(floor_per_m * x) + floor_noise * random.normal());
        continue;
      }
      const double side = random.uniform() < 0.5 ? -1 : 1, z = height * random.uniform();
      double out_m = wave * std::sin(per_m * x) + ripple * std::sin(ripples_per_m * x + 3 * z);
      out_m += noise * random.normal();
      if (std::fmod(x + 100, steps_apart) < 0.15) out_m -= step;
      out->put(x, side * (half + out_m), floor + z);
    }
  }
};

// Cells of 0.05 m that begin at 16 neighbouring slots of the voxels' table, in an engine of 60000 voxels and 30 m: an
// engine that probes until it finds room takes a thousand times as long. Then two of them, by turns.
inline void fill_crowd(std::uint32_t points, DearCloud* out) {
  constexpr std::uint32_t kCells = 59500, kSlotMask = 131071, kFirstSlot = 77777;
  constexpr int kReach = 590, kOrigin = 1365;
  for (int x = -kReach; x < kReach; ++x) {
    for (int y = -kReach; y < kReach; ++y) {
      for (int z = -kReach; z < kReach && out->size() < kCells; ++z) {
        const double px = (x + 0.5) * 0.05, py = (y + 0.5) * 0.05, pz = (z + 0.5) * 0.05;
        const double range2 = px * px + py * py + pz * pz;
        if (range2 > 890.0 || range2 < 1.0) continue;
        const auto cx = static_cast<std::uint64_t>(x + kOrigin), cy = static_cast<std::uint64_t>(y + kOrigin);
        const auto cz = static_cast<std::uint64_t>(z + kOrigin);
        const std::uint64_t key = (cx >> 2) << 44 | (cy >> 2) << 25 | cz << 4 | (cx & 3) << 2 | (cy & 3);
        const auto slot = static_cast<std::uint32_t>((key * 0x9E3779B97F4A7C15ULL) >> 47);
        if (((slot - kFirstSlot) & kSlotMask) < 16U) out->put(px, py, pz);
      }
    }
  }
  const std::uint32_t cells = out->size();
  while (out->size() < points) out->put_again(cells - 1 - (out->size() & 1U));
}

inline void fill_sheets(std::uint32_t points, DearCloud* out) {
  PlainRandom random(12345);
  while (out->size() < points) {
    const double what = random.uniform(), sheet = std::floor(8 * random.uniform());
    const double side = random.uniform() < 0.5 ? -1 : 1, x = 24 * random.uniform() - 12;
    if (what < 0.7) {
      out->put(x, side * (1.5 + 0.25 * sheet) + 0.01 * random.normal(), 3 * random.uniform() - 1.2);
    } else {
      out->put(x, 3 * random.uniform() - 1.5, -1.2 + 0.2 * std::fmod(sheet, 5) + 0.01 * random.normal());
    }
  }
}

inline void fill_rough(std::uint32_t points, DearCloud* out) {
  PlainRandom random(12345);
  while (out->size() < points) {
    const double what = random.uniform(), x = 40 * random.uniform() - 20;
    const double w = 0.25 * std::sin(3 * x) + 0.15 * std::sin(11 * x) + 0.05 * random.normal();
    if (what < 0.35) {
      const double y = 5 * random.uniform() - 2.5;
      out->put(x, y, -1.2 + 0.15 * std::sin(2 * x) + 0.03 * random.normal());
    } else {
      const double side = random.uniform() < 0.5 ? -1 : 1;
      out->put(x, side * (2.5 + w), 3.2 * random.uniform() - 1.2);
    }
  }
}

inline void fill_shell(double radius_m, double thick_m, std::uint32_t points, DearCloud* out) {
  PlainRandom random(12345);
  while (out->size() < points) {
    const double a = random.normal(), b = random.normal(), c = random.normal();
    const double r = (radius_m + thick_m * random.uniform()) / std::sqrt(a * a + b * b + c * c);
    out->put(a * r, b * r, c * r);
  }
}

inline void fill_air(double reach_m, double height_m, std::uint32_t points, DearCloud* out) {
  PlainRandom random(12345);
  while (out->size() < points) {
    const double x = reach_m * (2 * random.uniform() - 1), y = reach_m * (2 * random.uniform() - 1);
    out->put(x, y, height_m * random.uniform() - 0.4 * height_m);
  }
}

// Floor and walls of points more than a leaf of 0.26 m apart, in such an order that each leaf is known to be too small
// only at the end of a pass.
inline void fill_apart(std::uint32_t points, DearCloud* out) {
  constexpr double kApart_m = 0.27;
  constexpr std::uint32_t kCells = 59000;
  constexpr int kReach = 105;
  for (int x = -kReach; x < kReach; ++x) {
    for (int y = -kReach; y < kReach && out->size() < kCells; ++y) out->put(x * kApart_m, y * kApart_m, -1.2);
  }
  for (int x = -kReach; x < kReach; ++x) {
    for (int z = -4; z < 12; ++z) {
      for (const double side : {-2.5, 2.5}) out->put(x * kApart_m, side, z * kApart_m);
    }
  }
  const std::uint32_t cells = out->size();
  while (out->size() + 1500 < points) out->put_again(out->size() % cells);
  PlainRandom random(1);
  while (out->size() < points) out->put(20 * random.uniform() - 10, 2.4, 0.4 + 1.5 * random.uniform());
}

// What fuzz/climb.cpp found: an engine without a budget takes 2.9 roads for the first.
inline const Hall kClimbed[] = {
    {{0.7470, 0.6213, 0.8956, 0.2723, 0.6855, 0.8600, 0.1665, 0.9878, 0.5260, 0.4075, 0.0000, 0.4376, 0.1983, 0.4342,
      0.3315, 0.9787},
     115},
    {{0.9829, 0.8220, 0.6026, 0.7953, 0.5357, 0.9716, 0.3516, 0.2042, 0.0000, 0.1302, 0.3311, 0.5588, 0.6655, 0.9964,
      0.9543, 0.6316},
     80},
};

// By name; false where there is none of that name. parN: the hall of the seed N; climbedN: the N-th that climbing
// found.
inline bool fill_dear(const std::string& kind, std::uint32_t points, DearCloud* out) {
  out->clear();
  if (kind == "road")
    fill_road(points, out);
  else if (kind == "equal")
    fill_shell(3.3, 0.0, 1, out);
  else if (kind == "sphere")
    fill_shell(5.0, 0.0, points, out);
  else if (kind == "sphere03")
    fill_shell(0.301, 0.0, points, out);
  else if (kind == "ball03")
    fill_shell(0.3, 0.2, points, out);
  else if (kind == "spread")
    fill_air(20.0, 5.0, points, out);
  else if (kind == "dense")
    fill_air(5.0, 4.0, points, out);
  else if (kind == "sheets")
    fill_sheets(points, out);
  else if (kind == "rough")
    fill_rough(points, out);
  else if (kind == "apart")
    fill_apart(points, out);
  else if (kind == "hash")
    fill_crowd(points, out);
  else if (kind == "climbed0")
    kClimbed[0].fill(points, out);
  else if (kind == "climbed1")
    kClimbed[1].fill(points, out);
  else if (kind.rfind("par", 0) == 0)
    Hall::drawn(static_cast<std::uint32_t>(std::stoul(kind.substr(3)))).fill(points, out);
  else
    return false;
  while (kind == "equal" && out->size() < points) out->put_again(0);
  out->keep_first(points);
  return true;
}

}  // namespace pose_wall::test

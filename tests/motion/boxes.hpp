// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A road of flat or rough faces as a small LiDAR sees it from any pose, by arithmetic alone: each ray meets the nearest
// face, and the rock's height about the face is a function of the place. Without noise what is off is the code's.

#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "motion/pose.hpp"
#include "support/clouds.hpp"

namespace pose_wall::motion::test {

// Half widths of the room about its origin; the rock stands into the room by relief(face, u, v), u along x where the
// face has such an axis.
struct BoxRoom {
  double length_m = 12.0, width_m = 2.5, down_m = 1.4, up_m = 1.8;
  std::function<double(int face, double u, double v)> relief;
};

struct Scanner {
  int lines = 64, columns = 512;
  double lowest_deg = -40.0, highest_deg = 40.0;
  double range_most_m = 25.0;
  double noise_m = 0.0;  // standard deviation of a range; another seed is another scan
  std::uint32_t seed = 1;
};

// How far a ray from `from` along unit `ray` goes, both in the room.
inline double range_in(const BoxRoom& room, const Eigen::Vector3d& from, const Eigen::Vector3d& ray) {
  double best = 1e9;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double sign = face % 2 == 0 ? 1.0 : -1.0;
    const double half = axis == 0 ? room.length_m : axis == 1 ? room.width_m : sign > 0.0 ? room.up_m : room.down_m;
    if (!(ray[axis] * sign > 1e-9)) continue;
    double range = (half - sign * from[axis]) / (ray[axis] * sign);
    if (range > best + 1.0) continue;  // no relief is as high
    // Rock that stands h into the room: by steps of Newton without a slope, for heights far below the range.
    for (int round = 0; round < 30 && room.relief; ++round) {
      const Eigen::Vector3d p = from + range * ray;
      const double height = room.relief(face, axis == 0 ? p.y() : p.x(), axis == 2 ? p.y() : p.z());
      const double before = range;
      range = (half - height - sign * from[axis]) / (ray[axis] * sign);
      if (std::fabs(range - before) < 1e-6) break;
    }
    if (range > 0.0 && range < best) best = range;
  }
  return best;
}

// Points in the sensor's frame, which is base's.
inline pose_wall::test::Points scan_of(const BoxRoom& room, const Pose& at, const Scanner& scanner = {}) {
  pose_wall::test::Points points;
  std::mt19937 random(scanner.seed);
  for (int line = 0; line < scanner.lines; ++line) {
    const double elevation =
        (scanner.lowest_deg + (scanner.highest_deg - scanner.lowest_deg) * line / (scanner.lines - 1)) * M_PI / 180.0;
    for (int column = 0; column < scanner.columns; ++column) {
      const double azimuth = 2.0 * M_PI * (column + 0.5) / scanner.columns - M_PI;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      // Of twelve evens, which has the deviation 1: the standard library's normal is another one elsewhere.
      double noise = 0.0;
      for (int k = 0; k < 12 && scanner.noise_m > 0.0; ++k) noise += static_cast<double>(random()) / 4294967296.0 - 0.5;
      const double range = range_in(room, at.t, at.R * ray) + scanner.noise_m * noise;
      if (!(range < scanner.range_most_m)) continue;
      const Eigen::Vector3d p = range * ray;
      points.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    }
  }
  return points;
}

inline Pose pose_of(double x, double y, double z, double roll_rad, double pitch_rad, double yaw_rad) {
  Pose pose;
  pose.R = turn_by({0.0, 0.0, yaw_rad}) * turn_by({0.0, pitch_rad, 0.0}) * turn_by({roll_rad, 0.0, 0.0});
  pose.t = {x, y, z};
  return pose;
}

// Memory for what is laid out in an arena.
template <typename Part>
class Laid {
 public:
  Laid() {
    Arena measure(nullptr);
    Part().lay_out(measure);
    memory_.resize(static_cast<std::size_t>(measure.bytes()) / 64 + 2);
    Arena arena(memory_.data());
    part_.lay_out(arena);
  }
  Part& operator*() { return part_; }
  Part* operator->() { return &part_; }
  const Part* operator->() const { return &part_; }
  Part* get() { return &part_; }

 private:
  struct alignas(64) Line {
    unsigned char bytes[64];
  };
  std::vector<Line> memory_;
  Part part_;
};

}  // namespace pose_wall::motion::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Sensors on the machine: patterns of rays, noise, dropouts, and dirt.

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "base/math/rotation.hpp"
#include "io/beams/beam_table.hpp"
#include "planar/encounter/world.hpp"
#include "pose_wall.h"

namespace pose_wall::test {

enum class Pattern { vlp16, os1_64, os0_32, os0_128, xt32, helios32, helios16p, mid360, patterns };

// Even rings, from the makers' sheets. A Helios-32 has its real ones (io/beams), which are denser ahead than below. A
// Mid-360 has no rings: its rays are spread over its view.
struct PatternRow {
  const char* name;
  std::uint32_t rings;
  double low_rad, high_rad;
  std::uint32_t columns;  // of a turn at 10 Hz
};
inline const PatternRow& row_of(Pattern pattern) {
  static constexpr PatternRow kRows[] = {
      {"vlp16", 16, -0.2618, 0.2618, 1800},     {"os1_64", 64, -0.3927, 0.3927, 1024},
      {"os0_32", 32, -0.7854, 0.7854, 1024},    {"os0_128", 128, -0.7854, 0.7854, 1024},
      {"xt32", 32, -0.2793, 0.2618, 2000},      {"helios32", 32, -0.9599, 0.2618, 1800},
      {"helios16p", 16, -0.2618, 0.2618, 1800}, {"mid360", 0, -0.122, 0.908, 0}};
  return kRows[static_cast<std::size_t>(pattern)];
}

struct Sensor {
  Sensor() = default;
  Sensor(Pattern of, double x, double z, double roll, double pitch, double sector, std::uint32_t turn)
      : pattern(of), x_m(x), z_m(z), roll_rad(roll), pitch_rad(pitch), sector_rad(sector), columns(turn) {}

  Pattern pattern = Pattern::vlp16;
  double x_m = 2.0, z_m = 1.6;              // in base
  double roll_rad = 0.0, pitch_rad = 0.45;  // of the mount; nose down is positive
  double sector_rad = 1.3;                  // to each side of forward: what lies elsewhere is left out
  std::uint32_t columns = 0;                // 0: the sensor's own
  double noise_m = 0.015, dropout = 0.01;
  double dirt_from_rad = 0.0, dirt_to_rad = 0.0;  // azimuths without returns
  // Of the machine, which shades rays: x_min x_max y_min y_max z_min z_max in base. The sensor stands above it.
  std::array<double, 6> body_m{};

  bool has_body() const { return body_m[5] > body_m[4]; }

  Eigen::Matrix3d R() const { return rotation_zyx(roll_rad, pitch_rad, 0.0); }
  // Unit directions in the lidar's frame. Those of a Mid-360 differ from frame to frame.
  void directions(Draw* draw, std::vector<Vec3>* out) const;
};

// All directions of a pattern within its sector; of a Mid-360 those of some frames. Made once.
class Directions {
 public:
  static const std::vector<Vec3>& of(const Sensor& sensor) {
    static std::map<std::tuple<int, std::uint32_t, double>, std::vector<Vec3>> known;
    std::vector<Vec3>& made = known[{static_cast<int>(sensor.pattern), sensor.columns, sensor.sector_rad}];
    if (made.empty()) make(sensor, &made);
    return made;
  }
  static constexpr std::uint32_t kFrames = 16;  // of a Mid-360
  static std::uint32_t frame_points(const Sensor& sensor) {
    return static_cast<std::uint32_t>(20000 * sensor.sector_rad / 3.14159265);
  }

 private:
  static void make(const Sensor& sensor, std::vector<Vec3>* out) {
    const auto put = [&](double azimuth, double elevation) {
      const double c = std::cos(elevation);
      out->push_back({static_cast<float>(c * std::cos(azimuth)), static_cast<float>(c * std::sin(azimuth)),
                      static_cast<float>(std::sin(elevation))});
    };
    const PatternRow& row = row_of(sensor.pattern);
    if (sensor.pattern == Pattern::mid360) {
      Draw draw(360);
      for (std::uint32_t k = 0; k < kFrames * frame_points(sensor); ++k) {
        put(draw.within(-sensor.sector_rad, sensor.sector_rad), draw.within(row.low_rad, row.high_rad));
      }
      return;
    }
    const std::uint32_t turn = sensor.columns != 0 ? sensor.columns : row.columns;
    const double step = 2.0 * 3.14159265358979 / turn;
    for (std::uint32_t k = 0; k < turn; ++k) {
      const double azimuth = (k + 0.5) * step - 3.14159265358979;
      if (std::fabs(azimuth) > sensor.sector_rad) continue;
      for (std::uint32_t r = 0; r < row.rings; ++r) put(azimuth, elevation_of(sensor.pattern, r));
    }
  }
  static double elevation_of(Pattern pattern, std::uint32_t ring) {
    const PatternRow& row = row_of(pattern);
    if (pattern != Pattern::helios32) return row.low_rad + (row.high_rad - row.low_rad) * ring / (row.rings - 1.0);
    constexpr double kDegree_rad = 3.14159265358979 / 180.0;
    return tools::robosense_helios32().lasers[ring].elevation_deg * kDegree_rad;
  }
};

inline void Sensor::directions(Draw* draw, std::vector<Vec3>* out) const {
  const std::vector<Vec3>& all = Directions::of(*this);
  if (pattern != Pattern::mid360) {
    if (out->empty()) *out = all;
    return;
  }
  out->resize(Directions::frame_points(*this));
  std::size_t at = draw->below(static_cast<std::uint32_t>(all.size()));
  for (Vec3& d : *out) d = all[at], at = at + 1 < all.size() ? at + 1 : 0;
}

// A cloud of x, y, z and one float more, in the lidar's frame.
class Scan {
 public:
  // The machine at (x, y, yaw), leaning as the floor does.
  void take(const Sensor& sensor, const World& world, double x_m, double y_m, double yaw_rad, double pitch_rad,
            double roll_rad, Draw* draw) {
    sensor.directions(draw, &directions_);
    const Eigen::Matrix3d R = rotation_zyx(roll_rad, pitch_rad, yaw_rad) * sensor.R();
    const Eigen::Vector3d at = rotation_zyx(roll_rad, pitch_rad, yaw_rad) * Eigen::Vector3d(sensor.x_m, 0, sensor.z_m);
    const auto lift = static_cast<float>(world.rest_at(x_m, y_m).height_m);
    const Vec3 from{static_cast<float>(x_m + at.x()), static_cast<float>(y_m + at.y()),
                    static_cast<float>(at.z()) + lift};
    const Eigen::Matrix3f Rf = R.cast<float>();
    const Eigen::Matrix3f R_base = sensor.R().cast<float>();
    points_.resize(4 * directions_.size());
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      const Vec3& d = directions_[k];
      const Eigen::Vector3f w = Rf * Eigen::Vector3f(d.x, d.y, d.z);
      float range = 0.0F;
      const bool is_dirty = sensor.dirt_to_rad > sensor.dirt_from_rad && is_between(d, sensor);
      if (!is_dirty && !(draw->quick_share() < static_cast<float>(sensor.dropout))) {
        range = to_body(sensor, R_base * Eigen::Vector3f(d.x, d.y, d.z));
        if (!(range > 0.0F)) range = world.cast(from, {w.x(), w.y(), w.z()}, draw);
        if (range > 0.0F) range += static_cast<float>(sensor.noise_m) * draw->quick_normal();
      }
      float* const p = &points_[4 * k];
      p[0] = range * d.x, p[1] = range * d.y, p[2] = range * d.z, p[3] = 0.0F;
    }
  }
  void blind() { points_.assign(points_.size(), 0.0F); }
  // Between two azimuths of the sensor the frame before stays.
  void keep_some(const std::vector<float>& before, double from_rad, double to_rad) {
    for (std::size_t k = 0; k + 3 < before.size() && k + 3 < points_.size(); k += 4) {
      const double azimuth = std::atan2(static_cast<double>(before[k + 1]), static_cast<double>(before[k]));
      if (azimuth > from_rad && azimuth < to_rad) std::copy_n(&before[k], 4, &points_[k]);
    }
  }

  pose_wall_cloud cloud(std::int64_t stamp_ns) const {
    pose_wall_cloud c{};
    c.struct_size = sizeof(c);
    c.data = points_.data();
    c.data_bytes = points_.size() * sizeof(float);
    c.width = static_cast<std::uint32_t>(points_.size() / 4);
    c.height = 1;
    c.point_step = 16;
    c.stamp_ns = stamp_ns;
    c.x = {0, POSE_WALL_FIELD_FLOAT32}, c.y = {4, POSE_WALL_FIELD_FLOAT32}, c.z = {8, POSE_WALL_FIELD_FLOAT32};
    return c;
  }
  std::vector<float>& points() { return points_; }

 private:
  static bool is_between(const Vec3& d, const Sensor& sensor) {
    const double a = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x));
    return a > sensor.dirt_from_rad && a < sensor.dirt_to_rad;
  }
  // Range of a ray (in base's axes) to the top of the machine's body, 0 beside it.
  static float to_body(const Sensor& sensor, const Eigen::Vector3f& d) {
    if (!sensor.has_body() || !(d.z() < 0.0F)) return 0.0F;
    const auto& b = sensor.body_m;
    const double t = (b[5] - sensor.z_m) / static_cast<double>(d.z());
    const double x = sensor.x_m + t * static_cast<double>(d.x()), y = t * static_cast<double>(d.y());
    return x > b[0] && x < b[1] && y > b[2] && y < b[3] ? static_cast<float>(t) : 0.0F;
  }
  std::vector<Vec3> directions_;
  std::vector<float> points_;
};

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A road of planes with one thing in it, as a LiDAR on a tilted machine sees it: fast enough for 100,000 of them.
// World: x along the road, z up from the floor, the sensor at (0, 0, height).

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/math/random.hpp"
#include "base/math/rotation.hpp"
#include "pose_wall_planar_scan.h"
#include "support/clouds.hpp"

namespace pose_wall::test {

class SceneDraw {
 public:
  explicit SceneDraw(std::uint64_t seed) : random_(seed) {}
  double uniform() { return static_cast<double>(random_.next() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  std::uint32_t below(std::uint32_t bound) { return random_.below(bound); }
  double normal() { return std::sqrt(-2.0 * std::log(1.0 - uniform())) * std::cos(2.0 * M_PI * uniform()); }

 private:
  Random random_;
};

struct RingSensor {
  const char* name;
  std::uint32_t rings, columns;  // rings 0: as many rays as columns, in random directions
  double elevation_min_deg, elevation_max_deg;
  double noise_m;
  double mount_roll_rad;  // upside down: pi
};
inline constexpr RingSensor kScanVlp16{"vlp16", 16, 1800, -15.0, 15.0, 0.02, 0.0};
inline constexpr RingSensor kScanOs1{"os1-64", 64, 1024, -22.5, 22.5, 0.012, 0.0};
inline constexpr RingSensor kScanMid360{"mid360", 0, 20000, -7.0, 52.0, 0.02, M_PI};

inline std::vector<Eigen::Vector3f> rays_of(const RingSensor& sensor, std::uint64_t seed) {
  std::vector<Eigen::Vector3f> rays;
  const auto add = [&](double azimuth, double elevation_deg) {
    const double e = elevation_deg * M_PI / 180.0;
    rays.emplace_back(
        Eigen::Vector3d(std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth), std::sin(e)).cast<float>());
  };
  SceneDraw draw(seed);
  const double span = sensor.elevation_max_deg - sensor.elevation_min_deg;
  for (std::uint32_t c = 0; c < sensor.columns; ++c) {
    if (sensor.rings == 0) add(draw.between(0.0, 2.0 * M_PI), sensor.elevation_min_deg + span * draw.uniform());
    for (std::uint32_t r = 0; r < sensor.rings; ++r) {
      add(2.0 * M_PI * c / sensor.columns, sensor.elevation_min_deg + span * r / (sensor.rings - 1));
    }
  }
  return rays;
}

// A thing that stands, hangs or floats: a round post, or a box that is turned.
struct SceneThing {
  bool round = true;
  double x = 5.0, y = 0.0, z0 = 0.0, z1 = 1.0;
  double half_length = 0.1, half_width = 0.1;  // round: the radius
  double turn_rad = 0.0;
};

struct RoadScene {
  double height_m = 1.5, left_m = 2.5, right_m = 2.5, roof_m = 3.5, ahead_m = 30.0, behind_m = 30.0;
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;  // of base in the world
  double noise_m = 0.0;
  double lost = 0.0, dust = 0.0;  // share of rays that do not come back, and that end in the air
  std::vector<SceneThing> things;
  bool things_are_dark = false;  // nothing comes back from them
  double rough_m = 0.0;          // standard deviation of the walls' relief

  Eigen::Matrix3d R_world_base() const { return rotation_zyx(roll_rad, pitch_rad, yaw_rad); }
};

// Relief of a wall: waves in all directions, some 0.3 m long, of unit variance.
class WallRelief {
 public:
  explicit WallRelief(std::uint64_t seed) {
    SceneDraw draw(seed);
    for (Wave& w : waves_) {
      const double k = 2.0 * M_PI / draw.between(0.15, 0.8), a = draw.between(0.0, 2.0 * M_PI);
      w = {k * std::cos(a), k * std::sin(a), draw.between(0.0, 2.0 * M_PI)};
    }
  }
  double at(double u, double v) const {
    double sum = 0.0;
    for (const Wave& w : waves_) sum += std::sin(w.ku * u + w.kv * v + w.phase);
    return sum * std::sqrt(2.0 / kWaves);
  }

 private:
  static constexpr int kWaves = 24;
  struct Wave {
    double ku, kv, phase;
  };
  Wave waves_[kWaves];
};

// A thing with what is the same for all rays.
struct PlacedThing : SceneThing {
  explicit PlacedThing(const SceneThing& thing)
      : SceneThing(thing), c(static_cast<float>(std::cos(turn_rad))), s(static_cast<float>(std::sin(turn_rad))) {
    const double away = std::hypot(x, y), reach = std::hypot(half_length, half_width);
    to_x = static_cast<float>(x / away), to_y = static_cast<float>(y / away);
    // beyond its outline, or all around where the sensor stands in it
    cosine_least =
        reach < 0.9 * away ? static_cast<float>(std::sqrt(1.0 - reach * reach / (away * away)) - 1e-4) : -1.0F;
  }
  float c, s, to_x, to_y, cosine_least;
};

// Where a ray from the sensor meets the thing; infinite: nowhere.
inline float meets(const PlacedThing& t, const Eigen::Vector3f& ray, float height_m) {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const float flat = std::sqrt(ray.x() * ray.x() + ray.y() * ray.y());
  if (ray.x() * t.to_x + ray.y() * t.to_y < t.cosine_least * flat) return kNever;
  const float c = t.c, s = t.s;
  const auto tx = static_cast<float>(t.x), ty = static_cast<float>(t.y);
  const float ox = -c * tx - s * ty, oy = s * tx - c * ty;  // the sensor in the thing's frame
  const float dx = c * ray.x() + s * ray.y(), dy = c * ray.y() - s * ray.x();
  float in = 0.0F, out = kNever;
  const auto slab = [&](float o, float d, float low, float high) {
    if (d == 0.0F) {
      if (o < low || o > high) out = -1.0F;
      return;
    }
    const float a = (low - o) / d, b = (high - o) / d;
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  };
  slab(height_m, ray.z(), static_cast<float>(t.z0), static_cast<float>(t.z1));
  const auto l = static_cast<float>(t.half_length), w = static_cast<float>(t.half_width);
  if (t.round) {
    const float a = dx * dx + dy * dy, b = ox * dx + oy * dy, q = b * b - a * (ox * ox + oy * oy - l * l);
    if (!(q >= 0.0F) || a == 0.0F) return kNever;
    const float root = std::sqrt(q);
    in = std::max(in, (-b - root) / a);
    out = std::min(out, (-b + root) / a);
  } else {
    slab(ox, dx, -l, l);
    slab(oy, dy, -w, w);
  }
  return in < out && in > 0.0F ? in : kNever;
}

struct SeenScene {
  Points points;                     // in the lidar's frame
  std::vector<float> range_free_m;   // horizontal, without noise, of each point
  std::vector<std::int32_t> thing;   // that each point lies on; -1: the road
  std::uint32_t rays_on_things = 0;  // also those that were lost
};

inline SeenScene see(const RoadScene& scene, const RingSensor& sensor, const std::vector<Eigen::Vector3f>& rays,
                     std::uint64_t seed, const WallRelief* relief = nullptr) {
  SceneDraw draw(seed);
  static const std::vector<float> normals = [] {
    SceneDraw of_table(1);
    std::vector<float> table(1U << 16U);
    for (float& n : table) n = static_cast<float>(of_table.normal());
    return table;
  }();
  std::uint32_t at = draw.below(1U << 16U);
  const std::uint32_t stride = 2 * draw.below(1U << 15U) + 1;
  const Eigen::Matrix3d R_base_lidar = rotation_zyx(sensor.mount_roll_rad, 0.0, 0.0);
  const Eigen::Matrix3f R = (scene.R_world_base() * R_base_lidar).cast<float>();
  const auto height = static_cast<float>(scene.height_m), roof = static_cast<float>(scene.roof_m);
  const auto left = static_cast<float>(scene.left_m), right = static_cast<float>(scene.right_m);
  const auto ahead = static_cast<float>(scene.ahead_m), behind = static_cast<float>(scene.behind_m);
  const auto lost = static_cast<std::uint32_t>(scene.lost * 4294967295.0);
  const auto dust = static_cast<std::uint32_t>(scene.dust * 4294967295.0);
  const std::vector<PlacedThing> things(scene.things.begin(), scene.things.end());
  SeenScene out;
  out.points.reserve(rays.size());
  out.range_free_m.reserve(rays.size());
  out.thing.reserve(rays.size());
  Random lots(seed ^ 0x5DEECE66DULL);
  for (const Eigen::Vector3f& ray_lidar : rays) {
    const Eigen::Vector3f ray = R * ray_lidar;
    const float tz = ray.z() > 0.0F ? (roof - height) / ray.z() : -height / ray.z();
    const float ty = ray.y() > 0.0F ? left / ray.y() : -right / ray.y();
    const float tx = ray.x() > 0.0F ? ahead / ray.x() : -behind / ray.x();
    float t = std::min(tz, std::min(ty, tx));
    if (relief != nullptr && ty < std::min(tz, tx)) {
      const double f = scene.rough_m * relief->at(static_cast<double>(ty * ray.x()), static_cast<double>(ty * ray.z()));
      t = ty * (1.0F - static_cast<float>(f) / (ray.y() > 0.0F ? left : right));
    }
    std::int32_t on = -1;
    for (std::size_t k = 0; k < things.size(); ++k) {
      const float tk = meets(things[k], ray, height);
      if (tk < t) t = tk, on = static_cast<std::int32_t>(k);
    }
    if (on >= 0) ++out.rays_on_things;
    if (on >= 0 && scene.things_are_dark) continue;
    if (lost != 0 && static_cast<std::uint32_t>(lots.next() >> 32) < lost) continue;
    if (dust != 0 && static_cast<std::uint32_t>(lots.next() >> 32) < dust) {
      t *= static_cast<float>(static_cast<double>(lots.next() >> 11) * 0x1p-53);
      on = -1;
    }
    at = (at + stride) & 0xFFFFU;
    const float noisy = t + static_cast<float>(scene.noise_m) * normals[at];
    const Eigen::Vector3f p = noisy * ray_lidar;
    out.points.push_back({p.x(), p.y(), p.z()});
    out.range_free_m.push_back(t * std::sqrt(ray.x() * ray.x() + ray.y() * ray.y()));
    out.thing.push_back(on);
  }
  return out;
}

// The floor that the engine would report: off by some of its own standard deviation.
inline pose_wall_planar_floor floor_of(const RoadScene& scene, double sigma_rad, SceneDraw* draw) {
  pose_wall_planar_floor floor{};
  floor.struct_size = sizeof(floor);
  floor.measured = 1;
  const Eigen::Matrix3d off =
      rotation_zyx(sigma_rad * draw->normal(), sigma_rad * draw->normal(), 0.0) * scene.R_world_base();
  for (int i = 0; i < 3; ++i) floor.normal[i] = off(2, i);
  floor.height_m = scene.height_m;
  floor.tilt_sigma_rad = sigma_rad;
  floor.tilt_level_rad = 5.0 * sigma_rad;
  floor.reach_m = 5.0;
  return floor;
}

// Angle of a place of the world in the levelled base, of the sensor.
inline double angle_of(const RoadScene& scene, double x, double y) {
  const double a = std::atan2(y, x) - scene.yaw_rad;
  return a - 2.0 * M_PI * std::floor((a + M_PI) / (2.0 * M_PI));
}

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Tests the simulator of the obstacle stop: mounts, the body's shade, rock and bends, and what freezes. Whether the
// stop is right is for the trial to tell.

#include "planar/encounter/mounts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace {

using namespace pose_wall::test;

Scan scan_of(const Sensor& sensor, const World& world, std::uint64_t seed = 5) {
  Draw draw(seed);
  Scan scan;
  scan.take(sensor, world, 0.0, 0.0, 0.0, 0.0, 0.0, &draw);
  return scan;
}

// Returns about base.
std::vector<Eigen::Vector3d> returns_of(const Sensor& sensor, const World& world) {
  std::vector<Eigen::Vector3d> all;
  Scan scan = scan_of(sensor, world);
  const std::vector<float>& p = scan.points();
  for (std::size_t k = 0; k < p.size(); k += 4) {
    const Eigen::Vector3d raw = Eigen::Vector3f(p[k], p[k + 1], p[k + 2]).cast<double>();
    if (raw.norm() > 0.0) all.push_back(sensor.R() * raw + Eigen::Vector3d(sensor.x_m, 0.0, sensor.z_m));
  }
  return all;
}

TEST(Mounts, HaveNamesOfTheirOwnAndSettingsThatOpen) {
  const std::vector<Mount> mounts = mounts_named("");
  std::set<std::string> names;
  StopUnderTest stop;
  for (const Mount& mount : mounts) {
    names.insert(mount.name);
    stop.open(mount.sensor, settings_of(mount));
    EXPECT_NE(stop.get(), nullptr) << mount.name;
  }
  EXPECT_EQ(names.size(), mounts.size());
  EXPECT_EQ(mounts.size(), 9U * (4U + 5U) * 4U);
  EXPECT_EQ(mounts_named("xt32-front-1.35-10").size(), 1U);
  EXPECT_TRUE(mounts_named("no such sensor").empty());
}

// Nothing of the road is seen through the machine, and the stop's box holds all that the machine returns.
TEST(Mounts, TheBodyShadesWhatLiesBehindIt) {
  std::size_t of_body = 0;
  const std::vector<Mount> mounts = mounts_named("");
  for (std::size_t k = 0; k < mounts.size(); k += 5) {  // of all sensors, places, heights and tilts
    const Mount& mount = mounts[k];
    Sensor sensor = mount.sensor;
    sensor.noise_m = sensor.dropout = 0.0;
    const auto& body = sensor.body_m;
    std::size_t shaded = 0;
    for (const Eigen::Vector3d& p : returns_of(sensor, World())) {
      if (std::fabs(p.z() - body[5]) < 1e-3 && p.x() > body[0] && p.x() < body[1] && std::fabs(p.y()) < body[3]) {
        ++of_body;
        continue;
      }
      if (!(p.z() < body[5] - 0.01)) continue;
      const double share = (sensor.z_m - body[5]) / (sensor.z_m - p.z());  // of the ray until it is as low as the roof
      const double x = sensor.x_m + share * (p.x() - sensor.x_m), y = share * p.y();
      const bool is_over = x > body[0] + 0.01 && x < body[1] - 0.01 && std::fabs(y) < body[3] - 0.01;
      shaded += is_over ? 1U : 0U;
    }
    EXPECT_EQ(shaded, 0U) << mount.name;
  }
  EXPECT_GT(of_body, 100000U);
}

double wall_offset(const World& world, const Eigen::Vector3d& p) {
  const double across = world.bend_rad_m == 0.0 ? p.y() : 20.0 - std::hypot(p.x(), 20.0 - p.y());
  return std::fabs(across) - world.half_width_m;
}

// In a bend rays end on the wall, not before and not behind it.
TEST(Mounts, RaysEndOnTheWallsOfABend) {
  World world;
  world.bend_rad_m = 0.05, world.wall_wave_m = 0.0, world.floor_wave_m = world.floor_rough_m = 0.0;
  Sensor sensor = mounts_named("os0_128-front-1.50-10").front().sensor;
  sensor.noise_m = sensor.dropout = 0.0;
  std::size_t of_walls = 0;
  for (const Eigen::Vector3d& p : returns_of(sensor, world)) {
    EXPECT_LT(wall_offset(world, p), 0.01);
    if (p.z() < 1.1 || p.z() > 3.1) continue;
    EXPECT_GT(wall_offset(world, p), -0.01) << p.transpose();
    ++of_walls;
  }
  EXPECT_GT(of_walls, 1000U);
}

// Rays stop at rock: no ray goes through a tip, however it grazes the wall.
TEST(Mounts, RaysDoNotPassThroughRock) {
  Sensor sensor = mounts_named("os1_64-front-1.35-10").front().sensor;
  sensor.noise_m = sensor.dropout = 0.0, sensor.body_m = {};
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    World world;
    world.rock = std::make_shared<Rock>(seed);
    world.floor_rough_m = 0.0;
    world.bend_rad_m = seed % 2 == 0 ? 0.0 : 0.05;
    const World::Rest rest = world.rest_at(0.0, 0.0);
    const Eigen::Vector3d from(sensor.x_m, 0.0, sensor.z_m + rest.height_m);
    const auto depth_of = [&](const Eigen::Vector3d& p) {
      const Vec3 at{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
      return std::fmax(world.depth_in_rock(at), world.floor_at(at.x, at.y) - at.z);
    };
    std::size_t rays = 0, deep = 0;
    for (Eigen::Vector3d to : returns_of(sensor, world)) {
      to.z() += rest.height_m;
      if (rays++ % 37 != 0 || (to - from).norm() > 12.0) continue;
      for (double share = 0.02; share < 0.99; share += 0.01) {
        deep += depth_of(from + share * (to - from)) > 0.04F ? 1U : 0U;  // tips narrower than a step
      }
      if (to.z() < 3.1) {
        EXPECT_NEAR(depth_of(to), 0.0F, 0.06F) << to.transpose();
      }
    }
    EXPECT_LT(deep, 20U) << seed;
  }
}

// The relief of the walls is what the simulator's rock has.
TEST(Mounts, RockIsAsRoughAsMeasured) {
  const Rock smooth(0), blasted(2);
  const auto sigma_of = [](const Rock& rock) {
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (float x = -20.0F; x < 60.0F; x += 0.31F, ++count) {
      const double h = static_cast<double>(rock.wall_at(true, x, 1.2F));
      sum += h, squares += h * h;
    }
    return std::sqrt(squares / count - sum * sum / count / count);
  };
  EXPECT_GT(sigma_of(smooth), 0.003);
  EXPECT_LT(sigma_of(smooth), 0.03);
  EXPECT_GT(sigma_of(blasted), 0.08);  // blocks of half a metre broke out
  EXPECT_LT(sigma_of(blasted), 0.4);
}

// A part that froze keeps each bit, and the rest is new.
TEST(Mounts, APartOfAScanFreezes) {
  const Sensor sensor = mounts_named("vlp16-front-1.35-10").front().sensor;
  const World world;
  Scan scan = scan_of(sensor, world, 6);
  const std::vector<float> before = scan_of(sensor, world, 5).points(), fresh = scan.points();
  scan.keep_some(before, -0.2, 0.2);
  std::size_t kept = 0, renewed = 0;
  for (std::size_t k = 0; k < before.size(); k += 4) {
    const double azimuth = std::atan2(static_cast<double>(before[k + 1]), static_cast<double>(before[k]));
    const bool is_frozen = azimuth > -0.2 && azimuth < 0.2;
    const std::vector<float>& expected = is_frozen ? before : fresh;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scan.points()[k + i], expected[k + i]);
    ++(is_frozen ? kept : renewed);
  }
  EXPECT_GT(kept, 100U);
  EXPECT_GT(renewed, 1000U);
}

}  // namespace

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// White box: a wall band in the levelled frame, built surface by surface, for the stages that look for walls. The
// machine stands upright at the origin, +X ahead, the floor 1.4 m below.

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "stages/walls.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall::test {

constexpr double kFloorZ_m = -1.4;

class BandFixture {
 public:
  explicit BandFixture(std::initializer_list<KeyValue> settings = {})
      : settings_(settings_with(settings)), points_(60000), beyond_(60000), noise_(1) {}

  struct Extent {
    double from_m, to_m, low_m, high_m;  // along the road, and above the floor
  };

  // Points every decimetre on the plane through (0, y, any) whose direction is turned left by an angle.
  void add_wall(double y_m, const Extent& e, double turned_left_rad = 0.0, double noise_m = 0.01,
                double lean_rad = 0.0) {
    for (double s = e.from_m; s <= e.to_m; s += 0.1) {
      for (double h = e.low_m; h <= e.high_m; h += 0.1) {
        const double off = noise_.normal(noise_m) + std::tan(lean_rad) * (h + kFloorZ_m) * (y_m > 0.0 ? 1.0 : -1.0);
        const double along = s + noise_.uniform(-0.04, 0.04);
        points_.add(std::cos(turned_left_rad) * along - std::sin(turned_left_rad) * off,
                    y_m + std::sin(turned_left_rad) * along + std::cos(turned_left_rad) * off, h + kFloorZ_m, 4.0F);
      }
    }
  }

  // A surface across the road, x metres ahead.
  void add_face(double x_m, double from_y_m, double to_y_m) {
    for (double y = from_y_m; y <= to_y_m; y += 0.1) {
      for (double h = 0.3; h <= 2.4; h += 0.1) {
        points_.add(x_m + noise_.normal(0.01), y + noise_.uniform(-0.04, 0.04), h + kFloorZ_m, 4.0F);
      }
    }
  }

  WallScene scene() {
    LevelResult level;
    level.floor_z_level_m = kFloorZ_m;
    const Axes axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
    return wall_scene(points_.set(), beyond_.set(), settings_, level, axes, Eigen::Vector3d::Zero());
  }

  WallsResult walls(const Plane* const last_left = nullptr, const Plane* const last_right = nullptr) {
    Placed<WallsScratch> scratch(points_.set().capacity());
    Random random(1);
    const Plane* const last[2] = {last_left, last_right};
    return find_walls(scene(), last, &random, scratch.get());
  }

  Settings& settings() { return settings_; }
  OwnedPoints& points() { return points_; }
  OwnedPoints& beyond() { return beyond_; }  // above and below the band
  Noise& noise() { return noise_; }

 private:
  Settings settings_;
  OwnedPoints points_;
  OwnedPoints beyond_;
  Noise noise_;
};

constexpr BandFixture::Extent kLongWall{-8.0, 8.0, 0.3, 2.4};

}  // namespace pose_wall::test

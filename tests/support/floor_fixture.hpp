// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// White box: clouds in base around the machine, built surface by surface, for the stages that look for the floor. The
// sensor is the base origin.

#pragma once

#include <Eigen/Core>
#include <cmath>

#include "base/math/rotation.hpp"
#include "engine/floor/floor.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall::test {

constexpr double kFloorBelow_m = 1.4;

class FloorFixture {
 public:
  explicit FloorFixture(std::initializer_list<KeyValue> settings = {})
      : settings_(settings_with(settings)), points_(60000), noise_(1) {}

  // The machine's tilt: everything added from now on is seen by a machine rolled and pitched like this.
  void tilt(double roll_rad, double pitch_rad) {
    R_base_level_ = (rotation_zyx(0.0, pitch_rad, 0.0) * rotation_zyx(roll_rad, 0.0, 0.0)).transpose();
  }

  struct Area {
    double x_min_m, x_max_m, y_min_m, y_max_m;
  };

  // A level surface at a height above the floor; a point every decimetre.
  void add_level(const Area& a, double height_m, double noise_m = 0.005, double step_m = 0.1) {
    for (double x = a.x_min_m; x <= a.x_max_m; x += step_m) {
      for (double y = a.y_min_m; y <= a.y_max_m; y += step_m) {
        add(x + noise_.uniform(-0.04, 0.04), y + noise_.uniform(-0.04, 0.04), height_m + noise_.normal(noise_m));
      }
    }
  }

  // A wall along the road.
  void add_wall(double y_m, double height_m = 3.0) {
    for (double x = -8.0; x <= 8.0; x += 0.1) {
      for (double h = 0.0; h <= height_m; h += 0.1) add(x, y_m + noise_.normal(0.005), h);
    }
  }

  void add_road() {
    add_level({-8, 8, -2.5, 2.5}, 0.0);
    add_level({-8, 8, -2.5, 2.5}, 3.2);
    add_wall(2.5);
    add_wall(-2.5);
  }

  void add(double x, double y, double height_m) {
    points_.add(R_base_level_ * Eigen::Vector3d(x, y, height_m - kFloorBelow_m));
  }

  FloorResult floor(const Plane* last = nullptr) {
    Placed<FloorScratch> scratch(points_.set().capacity());
    Random random(1);
    return find_floor(scene(Eigen::Vector3d::Zero(), last), &random, scratch.get());
  }

  // Refers to this fixture.
  FloorScene scene(const Eigen::Vector3d& sensor_base_m = Eigen::Vector3d::Zero(), const Plane* last = nullptr) {
    return {points_.set(), settings_, axes_, sensor_base_m, last};
  }

  OwnedPoints& points() { return points_; }
  Settings& settings() { return settings_; }

 private:
  const Axes axes_{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  Settings settings_;
  OwnedPoints points_;
  Noise noise_;
  Eigen::Matrix3d R_base_level_ = Eigen::Matrix3d::Identity();
};

}  // namespace pose_wall::test

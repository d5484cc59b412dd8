// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// White box: a wall band in the levelled frame, built surface by surface, for the stages that look for walls. The
// machine stands upright at the origin, +X ahead, the floor 1.4 m below. Points of surfaces built so tell nothing about
// the directions a sensor looks in: only what is counted with count_return() does (ray_scene.hpp).

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "engine/walls/walls.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall::test {

constexpr double kFloorZ_m = -1.4;

class BandFixture {
 public:
  explicit BandFixture(std::initializer_list<KeyValue> settings = {})
      : settings_(settings_with(settings)),
        points_(kPointsMax),
        beyond_(kPointsMax),
        cloud_(2 * kPointsMax),
        noise_(1) {
    returns_lidar_->clear();
  }

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

  // A return of the sensor, by the direction it came from.
  void count_return(const Eigen::Vector3d& ray_lidar) {
    returns_lidar_->all_slices.add(Directions::cell_of(ray_lidar), 1);
  }
  void mount_lidar(const Eigen::Matrix3d& R_level_lidar) { extrinsic_.R_base_lidar = R_level_lidar; }

  // Refers to this fixture, as it is now.
  WallScene scene() {
    Levelling levelling;
    levelling.floor_z_level_m = kFloorZ_m;
    const Axes axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
    join_cloud();
    returns_lidar_->settle();
    return wall_scene({points_.set(), beyond_.set(), *cloud_, *returns_lidar_, counts_}, settings_, levelling, axes,
                      extrinsic_);
  }

  WallsResult walls(const Plane* const last_left = nullptr, const Plane* const last_right = nullptr) {
    Placed<WallsScratch> scratch(2 * kPointsMax);
    Random random(1);
    const Plane* const last[2] = {last_left, last_right};
    return find_walls(scene(), last, &random, scratch.get());
  }

  Settings& settings() { return settings_; }
  OwnedPoints& points() { return points_; }
  OwnedPoints& beyond() { return beyond_; }  // above and below the band
  Noise& noise() { return noise_; }

 private:
  static constexpr std::uint32_t kPointsMax = 100000;

  // The machine is level: base is the levelled frame.
  void join_cloud() {
    cloud_->count = 0;
    for (OwnedPoints* part : {&points_, &beyond_}) {
      const PointSet& from = part->set();
      for (std::uint32_t i = 0; i < from.count; ++i) cloud_->set(cloud_->count++, from.at(i), from.weight[i]);
    }
    cloud_->bound();
  }

  Settings settings_;
  Extrinsic extrinsic_{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  OwnedPoints points_;
  OwnedPoints beyond_;
  Placed<BoundedPoints> cloud_;
  Placed<ReturnsByDirection> returns_lidar_;
  IngestCounts counts_;
  Noise noise_;
};

constexpr BandFixture::Extent kLongWall{-8.0, 8.0, 0.3, 2.4};

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// White box: a band as a LiDAR at the origin sees it. Each ray ends on the nearest of some axis-parallel rectangles, so
// that things hide what is behind them; where it ends on a dark one, or on none, nothing comes back.

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "support/band_fixture.hpp"

namespace pose_wall::test {

struct Interval {
  double low, high;
  bool holds(double x) const { return x >= low && x <= high; }
};

constexpr Interval kEverywhere{-1e3, 1e3};

// On the plane x, y or z (axis 0, 1 or 2) = at_m.
struct Panel {
  int axis;
  double at_m;
  Interval x, y, z;
  bool dark = false;
};

inline Panel side_panel(double y_m, Interval x, Interval z, bool dark = false) {
  return {1, y_m, x, kEverywhere, z, dark};
}
inline Panel level_panel(double z_m) {
  return {2, z_m, kEverywhere, kEverywhere, kEverywhere};
}
inline Panel cross_panel(double x_m, Interval y, Interval z) {
  return {0, x_m, kEverywhere, y, z};
}

struct Lidar {
  double elevation_min_deg, elevation_max_deg, line_deg, azimuth_step_deg;
  Eigen::Matrix3d R_level_lidar = Eigen::Matrix3d::Identity();
};

inline const Lidar kVlp16{-15.0, 15.0, 2.0, 0.2};
inline const Lidar kOs0{-45.0, 45.0, 0.7, 0.5};
inline const Lidar kOs1{-22.5, 22.5, 0.7, 0.35};

class RayScene {
 public:
  // Distance a ray goes further, by where it ends: rough rock.
  using Relief = std::function<double(const Eigen::Vector3d&)>;

  RayScene& add(const Panel& panel) {
    panels_.push_back(panel);
    return *this;
  }
  // Of the panels on the plane y = at_m.
  void set_relief(double at_m, Relief relief) {
    relief_at_m_ = at_m;
    relief_ = std::move(relief);
  }
  void set_noise(double sigma_m) { noise_m_ = sigma_m; }
  // As many scans in one cloud, each the same: every direction counted and every point weighed so many times.
  void set_accumulated(std::uint32_t scans) { scans_ = scans; }

  // All around. A return is lost where `lost` says so of its ray in the lidar frame: dust, mud on the window.
  using Lost = std::function<bool(const Eigen::Vector3d&)>;
  void scan(const Lidar& lidar, BandFixture* band, const Lost& lost = nullptr) const {
    constexpr double kDegree = M_PI / 180.0;
    band->mount_lidar(lidar.R_level_lidar);
    const WallScene scene = band->scene();
    const Interval heights{scene.z_min_level_m, scene.z_max_level_m};
    for (double e = lidar.elevation_min_deg; e <= lidar.elevation_max_deg; e += lidar.line_deg) {
      for (double a = 0.0; a < 360.0; a += lidar.azimuth_step_deg) {
        const double flat = std::cos(e * kDegree);
        const Eigen::Vector3d ray_lidar(flat * std::cos(a * kDegree), flat * std::sin(a * kDegree),
                                        std::sin(e * kDegree));
        const Eigen::Vector3d ray = lidar.R_level_lidar * ray_lidar;
        Eigen::Vector3d p;
        if (!end_of(ray, &p) || (lost && lost(ray_lidar))) continue;
        p += band->noise().normal(noise_m_) * ray;
        OwnedPoints& points = heights.holds(p.z()) ? band->points() : band->beyond();
        points.add(p.x(), p.y(), p.z(), static_cast<float>(scans_));
        for (std::uint32_t scan = 0; scan < scans_; ++scan) band->count_return(ray_lidar);
      }
    }
  }

 private:
  static constexpr double kRange_m = 50.0;

  bool end_of(const Eigen::Vector3d& ray, Eigen::Vector3d* end) const {
    const Panel* nearest = nullptr;
    double range_m = kRange_m;
    for (const Panel& panel : panels_) {
      const double t = panel.at_m / ray[panel.axis];
      if (!(t > 0.1 && t < range_m)) continue;
      const Eigen::Vector3d p = t * ray;
      const bool on_it = (panel.axis == 0 || panel.x.holds(p.x())) && (panel.axis == 1 || panel.y.holds(p.y())) &&
                         (panel.axis == 2 || panel.z.holds(p.z()));
      if (!on_it) continue;
      nearest = &panel;
      range_m = t;
    }
    if (nearest == nullptr || nearest->dark) return false;
    *end = range_m * ray;
    if (relief_ && nearest->axis == 1 && nearest->at_m == relief_at_m_) *end *= 1.0 + relief_(*end) / nearest->at_m;
    return true;
  }

  std::vector<Panel> panels_;
  double relief_at_m_ = 0.0, noise_m_ = 0.0;
  std::uint32_t scans_ = 1;
  Relief relief_;
};

}  // namespace pose_wall::test

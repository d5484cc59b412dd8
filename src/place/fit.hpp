// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A pose that lays points on the surfaces of a map: Gauss and Newton on distances across the surfaces, with Cauchy's
// weight. The map is anything that answers
//
//     const Surface* near(double x_m, double y_m) const;   the surface next to a place, or nullptr
//     bool is_seen(double x_m, double y_m) const;          lines of sight went there
//     const Eigen::Vector2d& middle_m() const;             where such places count from

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/span.hpp"
#include "place/beams.hpp"
#include "place/pose2.hpp"
#include "place/surface.hpp"

namespace pose_wall::planar {

// Points of one surface err alike: of so many one counts. An estimate on the safe side, from recorded logs; in the
// simulator each would count (planar/match/README.md).
constexpr double kAlike = 10.0;
constexpr std::uint32_t kFitRoundsMost = 12;  // a bound on the time of a fit, which rests by itself before

// What is known before the scan: a pose and the information about it, in the map's axes.
struct Prior {
  Pose2 pose;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();

  Eigen::Vector3d off(const Pose2& to) const {
    return {to.x_m - pose.x_m, to.y_m - pose.y_m, wrapped(to.yaw_rad - pose.yaw_rad)};
  }
  double squared_distance(const Pose2& to) const { return off(to).dot(information * off(to)); }
};

struct FitRule {
  double sigma_m = 0.0;  // of a point about its surface
  Prior prior = {};
  std::uint32_t stride = 1;  // every so manieth point
  std::uint32_t rounds = kFitRoundsMost;
};

struct Fit {
  Pose2 pose;  // of base in the map
  Eigen::Matrix3d information =
      Eigen::Matrix3d::Zero();  // of x, y, yaw without the prior's, as if points were independent
  double explained = 0.0;       // share of the points in seen parts that lie on surfaces
  double rms_m = 0.0;           // of these, across the surfaces
  double seen = 0.0;            // share of the points that lie in seen parts
  std::uint32_t points = 0;     // in seen parts
  bool is_valid = false;        // enough points lie on surfaces
};

// Sums of one round of Gauss and Newton: of H the upper half.
struct FitSums {
  double xx = 0.0, xy = 0.0, xt = 0.0, yy = 0.0, yt = 0.0, tt = 0.0;
  double x = 0.0, y = 0.0, t = 0.0;
  double squares = 0.0;  // of residuals across, of explained points
  std::uint32_t explained = 0, seen = 0, all = 0;

  Eigen::Matrix3d information() const;
  // A point `turned` into the map's axes from base, at `off` from its surface.
  void add(const Surface& surface, const Eigen::Vector2d& turned, const Eigen::Vector2d& off, double noise_m2) {
    const auto nx = static_cast<double>(surface.normal_x), ny = static_cast<double>(surface.normal_y);
    const double across = nx * off.x() + ny * off.y(), across_m2 = noise_m2 + static_cast<double>(surface.across_m2);
    add_row(nx, ny, turned.x() * ny - turned.y() * nx, across, across_m2);
    constexpr double kExplained = 3.0;  // sigmas: 99.7 % of what lies on the surface
    if (across * across < kExplained * kExplained * across_m2) {
      ++explained;
      squares += across * across;
    }
    // A cluster without direction tells both ways; along a wall, where a point lies in its cell tells nothing. A wall
    // of 0.3 m with a noise of 2 cm has a ratio of 0.05, a round cluster 1.
    constexpr float kRound = 0.25F;
    if (surface.across_m2 > kRound * surface.along_m2) {
      add_row(-ny, nx, turned.x() * nx + turned.y() * ny, nx * off.y() - ny * off.x(),
              noise_m2 + static_cast<double>(surface.along_m2));
    }
  }

 private:
  void add_row(double dx, double dy, double turn, double residual, double variance) {
    // Cauchy's weight: what lies 2.4 sigmas off has half the weight of what fits (the usual 95 % constant).
    constexpr double kPerCauchy2 = 1.0 / (2.385 * 2.385);
    const double weight = 1.0 / (variance + residual * residual * kPerCauchy2);
    const double wx = weight * dx, wy = weight * dy, wt = weight * turn;
    xx += wx * dx;
    xy += wx * dy;
    xt += wx * turn;
    yy += wy * dy;
    yt += wy * turn;
    tt += wt * turn;
    x += wx * residual;
    y += wy * residual;
    t += wt * residual;
  }
};

template <typename Map>
FitSums fit_sums(const Map& map, Span<const ScanPoint> points, const Pose2& pose, const FitRule& rule) {
  FitSums sums;
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - map.middle_m();
  for (std::uint32_t k = 0; k < points.size(); k += rule.stride) {
    const Eigen::Vector2d turned = turn * as_double(points[k]), p = turned + place;
    ++sums.all;
    const Surface* const surface = map.near(p.x(), p.y());
    if (surface == nullptr) {
      sums.seen += map.is_seen(p.x(), p.y()) ? 1U : 0U;
      continue;
    }
    ++sums.seen;
    const Eigen::Vector2d off(p.x() - static_cast<double>(surface->x_m), p.y() - static_cast<double>(surface->y_m));
    sums.add(*surface, turned, off, rule.sigma_m * rule.sigma_m);
  }
  return sums;
}

// One step of the pose by these sums and the prior. False: the fit rests, or would leap.
bool fit_step(const FitSums& sums, const Prior& prior, Pose2* pose);
Fit fit_of(const FitSums& sums, const Pose2& pose);

template <typename Map>
Fit fit_pose(const Map& map, Span<const ScanPoint> points, const Pose2& start, const FitRule& rule) {
  Pose2 pose = start;
  for (std::uint32_t round = 0; round < rule.rounds; ++round) {
    if (!fit_step(fit_sums(map, points, pose, rule), rule.prior, &pose)) break;
  }
  return fit_of(fit_sums(map, points, pose, rule), pose);
}

// Information with no more than `most` left along a direction.
Eigen::Matrix3d less_along(const Eigen::Matrix3d& information, const Eigen::Vector2d& direction, double most);

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A caller's planar scan as the parts read it: checked once, each beam with its direction in base.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/span.hpp"
#include "pose_wall_planar_types.h"

namespace pose_wall::planar {

enum class BeamEnd : std::uint32_t { unknown, open, thing };

struct Beam {
  float direction_x, direction_y;  // unit, in base
  float range_m;                   // of a thing: where it is; open: how far was seen; unknown: 0
  BeamEnd end;
};

struct BeamScan {
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  // in base
  Span<const Beam> beams;
  std::int64_t stamp_ns = 0;
  double sigma_m = 0.0;

  Eigen::Vector2d end_m(const Beam& beam) const {
    return origin_m + static_cast<double>(beam.range_m) *
                          Eigen::Vector2d(static_cast<double>(beam.direction_x), static_cast<double>(beam.direction_y));
  }
};

// POSE_WALL_OK, POSE_WALL_E_NULL, POSE_WALL_E_STRUCT_SIZE or POSE_WALL_PLANAR_E_SCAN.
std::int32_t check_scan(const pose_wall_planar_scan* scan);

// A checked scan. `beams` has room for POSE_WALL_PLANAR_BEAMS_MAX.
BeamScan read_beams(const pose_wall_planar_scan& scan, Span<Beam> beams);

// The points of a scan that are matched: spread evenly along what the scan saw, each the mean of its neighbours.

constexpr std::uint32_t kMatchPointsMost = 720;  // a scanner of half a degree whole; denser ones err alike
constexpr double kMatchSpacing_m = 0.05;         // along a surface: half a cell of surface.hpp

struct ScanPoint {
  float x_m, y_m;  // in base
};

inline Eigen::Vector2d as_double(const ScanPoint& point) {
  return {static_cast<double>(point.x_m), static_cast<double>(point.y_m)};
}

// At most kMatchPointsMost points that are about spacing_m apart. Where more are needed, the spacing grows.
Span<const ScanPoint> even_points(const BeamScan& scan, double spacing_m, Span<ScanPoint> room);

}  // namespace pose_wall::planar

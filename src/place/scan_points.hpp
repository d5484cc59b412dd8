// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The points of a scan that are matched: spread evenly along what the scan saw, each the mean of its neighbours.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/span.hpp"
#include "place/beams.hpp"

namespace pose_wall::planar {

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

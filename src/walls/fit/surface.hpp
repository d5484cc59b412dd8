// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The full fit of a chosen wall: which points are its surface, where it bends, and the plane through it.

#pragma once

#include "walls/fit/strips.hpp"
#include "walls/propose/evidence.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// Indices of the points within gate_m of the plane.
Span<std::uint32_t> points_near(const BoundedPoints& points, const Plane& plane, double gate_m,
                                Span<std::uint32_t> out);

// A few rounds of Tukey from a drawn hypothesis on points of the band, its lean set free. False where nothing holds it.
// It is called first wide, to see the lean of a wall that an upright hypothesis cuts, then narrow.
enum class RefineWidth { kWide, kNarrow };
bool refine_hypothesis(const BoundedPoints& band_level, double thresh_m, const Eigen::Vector3d& along_level,
                       RefineWidth width, WallFitScratch* scratch, Plane* plane);

// Marks the grid with a plane: with the RANSAC threshold to judge a hypothesis, or as wide as the fit reaches.
enum class MarkWidth { kThreshold, kFit };
void mark_wall(const WallScene& scene, const Plane& plane, const Eigen::Vector3d& along_level, MarkWidth width,
               WallGrid* grid);

// The full fit around a hypothesis. Leaves the grid marked with it by the threshold.
WallSurface fit_surface(const WallScene& scene, const Plane& start, WallGrid* grid, WallFitScratch* scratch);

}  // namespace pose_wall

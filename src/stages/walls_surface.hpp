// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The surface of a chosen wall: which points it is, what stands out of it, where it bends, and the plane through it.

#pragma once

#include "containers/arena.hpp"
#include "estimation/irls.hpp"
#include "estimation/patch_fit.hpp"
#include "estimation/tangent_frame.hpp"
#include "estimation/tukey.hpp"
#include "estimation/two_layers.hpp"
#include "stages/walls_evidence.hpp"
#include "stages/walls_scene.hpp"

namespace pose_wall {

struct WallFitScratch {
  Span<std::uint32_t> chosen;
  Span<float> residuals;
  PatchGrid patches;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

// In the levelled frame.
struct Heights {
  double min_m, max_m;
  bool contain(double z_level_m) const { return z_level_m >= min_m && z_level_m <= max_m; }
};

struct WallSurface {
  Span<const std::uint32_t> chosen;  // the points it was fitted on
  IrlsResult irls;
  TwoLayers layers;
  double layer_sigma_m = 0.0;  // what the nearer layer may have moved the surface
  Heights heights{0.0, 0.0};   // where it is one plane
  TangentFrame frame;
  PatchFit patch;  // corrects irls.plane; not solved: there is no surface

  // Weight of a point by its distance from irls.plane.
  double weight(double residual_m) const {
    const double tukey = tukey_weight(residual_m, irls.scale_m);
    return layers.found ? tukey * layers.surface_probability(residual_m) : tukey;
  }
};

// Indices of the points within gate_m of the plane.
Span<std::uint32_t> points_near(const PointSet& points, const Plane& plane, double gate_m, Span<std::uint32_t> out);

// A few rounds of Tukey from a drawn hypothesis, its lean set free. False where nothing holds it.
bool refine_hypothesis(const WallScene& scene, const Eigen::Vector3d& along_level, WallFitScratch* scratch,
                       Plane* plane);

// Marks the grid with a plane: with the RANSAC threshold to judge a hypothesis, or as wide as the fit reaches.
enum class MarkWidth { kThreshold, kFit };
void mark_wall(const WallScene& scene, const Plane& plane, const Eigen::Vector3d& along_level, MarkWidth width,
               WallGrid* grid);

// The full fit around a hypothesis. Leaves the grid marked with it by the threshold.
WallSurface fit_surface(const WallScene& scene, const Plane& start, WallGrid* grid, WallFitScratch* scratch);

}  // namespace pose_wall

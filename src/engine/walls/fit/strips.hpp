// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The wall's own surface and the strips (steel sets, posts) that stand out of it.

#pragma once

#include "base/containers/arena.hpp"
#include "base/containers/work.hpp"
#include "base/estimation/irls.hpp"
#include "base/estimation/patch_fit.hpp"
#include "base/estimation/tukey.hpp"
#include "engine/walls/fit/points.hpp"
#include "engine/walls/fit/strip_profile.hpp"

namespace pose_wall {

struct WallFitScratch {
  Span<std::uint32_t> near;  // indices into the wall band
  WallPoints points;
  PatchGrid patches;
  StripProfile strips;
  Work work;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

// In the levelled frame.
struct Heights {
  double min_m, max_m;
  bool contain(double z_level_m) const { return z_level_m >= min_m && z_level_m <= max_m; }
};

// The fronts of the strips: a plane parallel to the wall's, step_m before it.
struct StripFronts {
  bool found = false;
  double step_m = 0.0;
  double scale_m = 0.0;
};

struct WallSurface {
  const WallPoints* points = nullptr;
  IrlsOver irls;                         // over the points' plane
  const StripProfile* strips = nullptr;  // null: no strips
  StripFronts fronts;
  TwoLayers layers;            // without strips: a nearer layer of points
  double layer_sigma_m = 0.0;  // how far nearer things may have moved the surface
  bool grooved = false;        // along its length, like pipes one above the other
  Heights heights{0.0, 0.0};   // the heights over which it is one plane
  PatchFit patch;              // corrects irls.over; not solved: there is no surface

  const TangentFrame& frame() const { return points->at.frame; }
  Plane irls_plane() const { return points->at.plane_of(irls.over); }
  // The result of the fit.
  PlaneOver over() const {
    PlaneOver out = irls.over;
    out.add(patch.correction);
    return out;
  }
  Plane plane() const { return points->at.plane_of(over()); }

  // Weight of a point as part of the surface, by its place along the road and its distance from the plane of irls.
  double weight(double u_m, double residual_m) const {
    const double weight = flat_top_weight(residual_m, points->range_noise_m, irls.scale_m);
    if (strips != nullptr) return weight * strips->surface_probability(u_m);
    return layers.found ? weight * layers.surface_probability(residual_m) : weight;
  }
};

// Averages the surface's points, and the strips' fronts if there are any, over patches and sets patch.
void fit_patches(PatchGrid::Errors errors, WallFitScratch* scratch, WallSurface* fit);

// Separates strips from the surface, near the sensor first and then further and further out, and repeats the plane fit
// on the surface alone. Without strips nothing changes.
void set_strips_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit);

// Door frames, cables and mesh stand out of a wall by more than its roughness. Without strips but with two layers of
// points, the fit is repeated on the outer layer and the other points are dropped.
void set_layers_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit);

// Where the strips hide the rock between them, their fronts give the wall's direction better than the rock does, if
// they stand out by more than the rock itself. Fronts that do not contradict the rock join the fit with a step of their
// own, and the fit is tested for bends. False if they contradict it or there are none. The plane then stays as it was,
// and its patches are yet to be fitted.
bool join_fronts(WallFitScratch* scratch, WallSurface* fit);

}  // namespace pose_wall

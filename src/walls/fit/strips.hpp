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
#include "walls/fit/points.hpp"
#include "walls/fit/strip_profile.hpp"

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

// What the strips show to the machine: a plane parallel to the wall's, step_m before it.
struct StripFronts {
  bool found = false;
  double step_m = 0.0;
  double scale_m = 0.0;
};

struct WallSurface {
  const WallPoints* points = nullptr;
  IrlsOver irls;                         // over the points' plane
  const StripProfile* strips = nullptr;  // null: none stand out of it
  StripFronts fronts;
  TwoLayers layers;            // without strips: what else stands out of it, point by point
  double layer_sigma_m = 0.0;  // what stands out may have moved the surface by this
  bool grooved = false;        // along its length, like pipes one above the other
  Heights heights{0.0, 0.0};   // where it is one plane
  PatchFit patch;              // corrects irls.over; not solved: there is no surface

  const TangentFrame& frame() const { return points->at.frame; }
  Plane irls_plane() const { return points->at.plane_of(irls.over); }
  // What the fit came to.
  PlaneOver over() const {
    PlaneOver out = irls.over;
    out.add(patch.correction);
    return out;
  }
  Plane plane() const { return points->at.plane_of(over()); }

  // Weight of a point as one of the surface, by its place along the road and its distance from the plane of irls.
  double weight(double u_m, double residual_m) const {
    const double weight = flat_top_weight(residual_m, points->range_noise_m, irls.scale_m);
    if (strips != nullptr) return weight * strips->surface_probability(u_m);
    return layers.found ? weight * layers.surface_probability(residual_m) : weight;
  }
};

// Averages the surface's points, and the strips' fronts if they were found, over patches: sets patch.
void fit_patches(PatchGrid::Errors errors, WallFitScratch* scratch, WallSurface* fit);

// Tells strips and surface apart, near the sensor first and then further and further out, and repeats the plane fit on
// the surface alone. Without strips nothing changes.
void set_strips_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit);

// Door frames, cables and mesh stand out of a wall by more than its roughness: where no strips were found but the
// points lie in two layers, the fit is repeated on the outer one, and the others are dropped.
void set_layers_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit);

// Where the strips hide the rock between them, their fronts tell the wall's direction better than the rock does, if
// they stand out by more than the rock itself. Where they do not contradict the rock they join the fit, with a step of
// their own, and the bends are looked for. False where they do, or there are none: the plane is what it was then, and
// its patches are yet to be fitted.
bool join_fronts(WallFitScratch* scratch, WallSurface* fit);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/fit/surface.hpp"

#include <cmath>

#include "base/containers/even_share.hpp"
#include "base/estimation/near_plane.hpp"
#include "engine/walls/fit/groove_profile.hpp"

namespace pose_wall {
namespace {

constexpr double kCut_m = 0.25;     // height of one cut; swept: half 2 lost 1 won, twice 6 lost
constexpr double kSpanMin_m = 0.5;  // least height left; a sensor that looks up 7 degrees sees half the band (seed 531)
// By chance hardly a wall is cut (0.02 %); swept: half 14 lost, twice 1 lost 3 won.
constexpr double kCurvatureInSigmas = 3.5;
// Smaller bulges are inliers (wall_ransac_thresh, 5 cm); swept: half 2 moved, twice 5 moved.
constexpr double kBulgeMin_m = 0.04;

// Weighted sums over the surface's points, of their heights and their distances from the plane.
struct Row {
  double w = 0.0, z = 0.0, zz = 0.0, r = 0.0, zr = 0.0;
  void add(const Row& other) {
    w += other.w;
    z += other.z;
    zz += other.zz;
    r += other.r;
    zr += other.zr;
  }
  double slope() const {
    const double spread = w * zz - z * z;
    return spread > 1e-9 * w * w ? (w * zr - z * r) / spread : 0.0;
  }
};

// The surface, row by row between two heights.
class Rows {
 public:
  Rows(const WallSurface& fit, const Heights& heights)
      : min_m_(heights.min_m), row_m_((heights.max_m - heights.min_m) / kRows) {
    const double foreshortening = fit.irls.over.foreshortening();
    for (std::uint32_t k = 0; k < fit.points->at.count; ++k) {
      const double z = fit.points->z_level_m(k);
      if (!heights.contain(z)) continue;
      const double r = fit.points->at.distance(k, fit.irls.over, foreshortening);
      const double w = fit.weight(static_cast<double>(fit.points->at.u[k]), r);
      const int i = static_cast<int>((z - min_m_) / row_m_);
      row_[i < kRows ? i : kRows - 1].add({w, w * z, w * z * z, w * r, w * z * r});
    }
    // Leaves out ends with stray points only: a sensor that hardly looks up sees little of the band.
    const double stray = kStrayShare * sum(0, kRows).w;
    while (last_ > first_ && sum(0, first_ + 1).w < stray) ++first_;
    while (last_ > first_ && sum(last_, kRows).w < stray) --last_;
  }

  Heights seen() const { return {min_m_ + first_ * row_m_, min_m_ + (last_ + 1) * row_m_}; }
  // Lean of the lower and the upper half of the seen part, relative to the plane.
  double lower_slope() const { return sum(first_, middle()).slope(); }
  double upper_slope() const { return sum(middle(), last_ + 1).slope(); }

 private:
  static constexpr int kRows = 32;  // of the band, 7 cm each by default
  // Less of the surface at an end is stray points; swept: half 9 moved, twice 10 moved.
  static constexpr double kStrayShare = 0.01;

  int middle() const { return (first_ + last_ + 1) / 2; }
  Row sum(int from, int to) const {
    Row out;
    for (int i = from; i < to; ++i) out.add(row_[i]);
    return out;
  }

  Row row_[kRows];
  double min_m_, row_m_;
  int first_ = 0, last_ = kRows - 1;
};

// The scale follows rough rock up to here; swept: half 2 lost 6 won, twice 5 moved.
constexpr double kScaleMaxInThresholds = 1.5;
constexpr double kStripsLeftOver = 0.05;  // of the strips' step: measured on simulated steel sets
// Of share times step, which leads back to the mean of both layers. The gate that chose them may have moved outwards by
// as much (README, What else stands out).
constexpr double kLayersLeftOver = 1.0;  // swept: half 1 won, twice 1 lost
constexpr int kCutsMax = 6;              // of kCut_m: 1.5 m of a band of 2.25 m; kSpanMin_m is left
// A wall is fitted twice at most: as seen, and again once its bends are cut off. Between them quick fits, on fewer
// points and without a covariance, test whether it still bends. The second fit may cost half the first (2026-11-25).
constexpr std::uint32_t kCutPointsMax = WallPoints::kMost * 3 / 8, kAgainPointsMax = WallPoints::kMost / 2;
constexpr int kRounds = 8;  // most fits settle earlier; swept: half 27 moved, twice 3 moved

IrlsSettings fit_settings(const Settings& s) {
  const double thresh_m = s.wall_ransac_thresh;
  return {kFitGateInThresholds * thresh_m, kFitScaleMin_m, kScaleMaxInThresholds * thresh_m, kRounds, kBeforePatches};
}

// Gathers points only where the plane is solid. Points that lie on it by chance, in a crosscut or on a pipe's line,
// stay out.
void gather(const WallScene& scene, const Plane& start, const Eigen::Vector3d& along, const Heights& heights,
            double gate_m, std::uint32_t most, const WallGrid& grid, WallFitScratch* scratch) {
  const BoundedPoints& band = scene.band_level;
  const Slab slab(start, gate_m);
  const auto along_x = static_cast<float>(along.x()), along_y = static_cast<float>(along.y());
  const FourFloats lowest = all_four(static_cast<float>(heights.min_m)), none{};
  const FourFloats highest = all_four(static_cast<float>(heights.max_m));
  std::uint32_t count = 0;
  FourFloats weights{};
  for_each_four_about(band, slab, [&](std::uint32_t i, FourTruths counts) {
    const FourFloats x = load_four(&band.x[i]), y = load_four(&band.y[i]), z = load_four(&band.z[i]);
    counts &= slab.holds(x, y, z) & (z >= lowest) & (z <= highest);
    if (!any_of(counts)) return;
    counts = grid.solid_at(along_x * x + along_y * y, z, counts);
    weights += counts ? load_four(&band.weight[i]) : none;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] != 0) scratch->near[count++] = i + lane;
    }
  });
  const double measured = sum_of_lanes(weights);
  WallPoints& points = scratch->points;
  points.begin(scene, start, along);
  points.add(scene.band_level, thinned(scratch->near.first(count), most));
  double taken = 0.0;
  for (std::uint32_t k = 0; k < points.at.count; ++k) taken += static_cast<double>(points.at.weight[k]);
  points.measured_per_weight = taken > 0.0 ? measured / taken : 1.0;
  points.sort_by_patch(&scratch->patches, scratch->near);
  scratch->work.add(band.count, steps::kPointGathered);
  scratch->work.add(points.at.count, steps::kPointTaken);
}

bool is_grooved(const WallScene& scene, const WallSurface& surface) {
  const WallPoints& points = *surface.points;
  GrooveProfile profile(scene.z_min_level_m, scene.z_max_level_m, points.sensor.x());
  const double foreshortening = surface.irls.over.foreshortening();
  for_each_four(points.at.count, [&](std::uint32_t k, FourTruths counts) {
    profile.add(load_four(&points.at.u[k]), points.four_z_level_m(k),
                points.at.four_distances(k, surface.irls.over, foreshortening), counts);
  });
  return profile.is_grooved();
}

WallSurface fit_between(const WallScene& scene, const Plane& start, const Eigen::Vector3d& along,
                        const Heights& heights, std::uint32_t points_most, const WallGrid& grid,
                        WallFitScratch* scratch) {
  const IrlsSettings settings = fit_settings(scene.settings);
  gather(scene, start, along, heights, settings.gate_m, points_most, grid, scratch);
  WallSurface fit;
  fit.heights = heights;
  fit.points = &scratch->points;
  fit.irls = irls_tukey(scratch->points.at, scratch->points.at.count, PlaneOver{}, settings);
  scratch->work.add(fit.irls.work);
  if (!fit.irls.solved) return fit;
  set_strips_apart(settings, scratch, &fit);
  if (scratch->work.stops()) return fit;
  // Tested before the layers, which may take the fronts of pipes for the nearer layer.
  fit.grooved = fit.irls.solved && is_grooved(scene, fit);
  if (fit.irls.solved && fit.strips == nullptr) set_layers_apart(settings, scratch, &fit);
  if (!fit.irls.solved) return fit;
  if (!join_fronts(scratch, &fit)) fit_patches(PatchGrid::Errors::kMeasured, scratch, &fit);
  const double left_over_m = fit.strips != nullptr ? kStripsLeftOver * fit.strips->layers().step_m : 0.0;
  const double layers_m = fit.layers.found ? kLayersLeftOver * fit.layers.share * fit.layers.step_m : 0.0;
  fit.layer_sigma_m =
      std::sqrt(fit.patch.visibility_m * fit.patch.visibility_m + left_over_m * left_over_m + layers_m * layers_m);
  return fit;
}

// Uses points gathered between wider heights. The strips stay where they were.
WallSurface fit_for_a_cut(const IrlsSettings& settings, const Heights& heights, const StripProfile* strips,
                          WallFitScratch* scratch) {
  WallPoints& points = scratch->points;
  for (std::uint32_t k = 0; k < points.at.count; ++k) points.spare[k] = heights.contain(points.z_level_m(k)) ? 1 : 0;
  points.keep(points.spare);
  if (strips != nullptr) points.mark_columns(*strips, scratch->near);
  if (strips != nullptr) points.copy_surface();
  const TangentPoints& of = strips != nullptr ? points.surface : points.at;
  WallSurface fit;
  fit.heights = heights;
  fit.points = &points;
  fit.strips = strips;
  fit.irls = irls_tukey(of, of.count, PlaneOver{}, settings);
  scratch->work.add(points.at.count, strips != nullptr ? steps::kPointByColumn : 0);
  scratch->work.add(points.at.count, steps::kPointBent);
  scratch->work.add(fit.irls.work);
  if (fit.irls.solved) fit_patches(PatchGrid::Errors::kBend, scratch, &fit);
  return fit;
}

// Cuts off the bent ends of the surface.
void cut(const WallScene& scene, const WallSurface& fit, const Plane& start, const Eigen::Vector3d& along,
         const WallGrid& grid, WallFitScratch* scratch, Heights* heights) {
  const IrlsSettings settings = fit_settings(scene.settings);
  gather(scene, start, along, *heights, settings.gate_m, kCutPointsMax, grid, scratch);
  for (int cuts = 1; cuts < kCutsMax && !scratch->work.stops(); ++cuts) {
    const WallSurface part = fit_for_a_cut(settings, *heights, fit.strips, scratch);
    if (!part.patch.solved || !cut_bent_rows(part, heights)) return;
  }
}

}  // namespace

bool cut_bent_rows(const WallSurface& fit, Heights* heights) {
  if (!(fit.patch.curvature_v > kCurvatureInSigmas * fit.patch.curvature_v_sigma)) return false;
  const Rows rows(fit, *heights);
  const Heights seen = rows.seen();
  const double span_m = seen.max_m - seen.min_m;
  if (span_m - kCut_m < kSpanMin_m || !(fit.patch.curvature_v * span_m * span_m > kBulgeMin_m)) return false;
  // A wall stands more upright than an arch or a heap, so the half that leans more loses its end.
  const double lean = lean_of(fit.irls_plane());
  if (std::fabs(lean - rows.upper_slope()) >= std::fabs(lean - rows.lower_slope())) {
    heights->max_m = seen.max_m - kCut_m;
  } else {
    heights->min_m = seen.min_m + kCut_m;
  }
  return true;
}

WallSurface fit_surface(const WallScene& scene, const Plane& start, WallGrid* grid, WallFitScratch* scratch) {
  const Eigen::Vector3d along = along_of(start, scene.forward_level);
  mark_wall(scene, start, along, MarkWidth::kFit, grid);
  scratch->work.add(2ULL * scene.band_level.count, steps::kPointMarked);  // now, and again after the fit
  Heights heights{scene.z_min_level_m, scene.z_max_level_m};
  WallSurface fit = fit_between(scene, start, along, heights, WallPoints::kMost, *grid, scratch);
  if (fit.patch.solved && cut_bent_rows(fit, &heights) && !scratch->work.stops()) {
    cut(scene, fit, start, along, *grid, scratch, &heights);
    if (scratch->work.stops()) return fit;
    fit = fit_between(scene, start, along, heights, kAgainPointsMax, *grid, scratch);
  }
  mark_wall(scene, fit.irls_plane(), along, MarkWidth::kThreshold, grid);
  return fit;
}

}  // namespace pose_wall

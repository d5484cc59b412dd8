// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_strips.hpp"

#include <cmath>

#include "estimation/robust_scale.hpp"

namespace pose_wall {
namespace {

// Strips are looked for within this many times the wall's distance: further out they hide the wall between them.
constexpr double kSeenWithin = 1.5;
constexpr double kProfileReach_m = 32.0;
constexpr int kRings = 4;  // each twice as far as the last
constexpr double kLayerPointsMin = 100.0;
constexpr double kLayerGainPerPoint = 0.02;
constexpr double kLayerStepMin_m = 0.045;  // less is the noise of a sensor, parted by the voxels
constexpr double kLayersApartInSigmas = 2.5;
constexpr double kPatch_m = 0.5;
constexpr double kWeightMin = 1e-6;
constexpr int kJointRounds = 3;
constexpr double kAgreeInSigmas = 3.5;
constexpr std::uint32_t kFrontPointsMin = 60;
constexpr double kFrontStepMin_m = 0.06;
constexpr int kFrontRounds = 4;
constexpr double kFrontScaleMin_m = 0.005;
constexpr double kFrontScaleMax_m = 0.03;

void fill_strips(const WallScene& scene, const WallSurface& fit, const Eigen::Vector3d& along, StripProfile* strips) {
  for (const std::uint32_t i : fit.chosen) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    strips->add(along.dot(p), p.z(), fit.irls.plane.signed_distance(p));
  }
}

// Moves the points of the wall's own surface to the front of chosen; returns how many.
std::uint32_t surface_first(const WallScene& scene, const StripProfile& strips, const Eigen::Vector3d& along,
                            Span<std::uint32_t> chosen) {
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < chosen.size(); ++k) {
    if (!(strips.surface_probability(along.dot(scene.band_level.at(chosen[k]))) >= 0.5)) continue;
    const std::uint32_t i = chosen[k];
    chosen[k] = chosen[count];
    chosen[count++] = i;
  }
  return count;
}

// Whether two fits differ by no more than their covariances allow; b uses what a uses, and more (Hausman 1978).
bool agree(const PatchFit& a, const Eigen::Vector3d& a_slopes, const PatchFit& b, const Eigen::Vector3d& b_slopes) {
  for (int k = 1; k < 3; ++k) {
    const double variance = a.covariance(k, k) > b.covariance(k, k) ? a.covariance(k, k) : b.covariance(k, k);
    const double apart = a_slopes[k] - b_slopes[k];
    if (!(apart * apart <= kAgreeInSigmas * kAgreeInSigmas * variance)) return false;
  }
  return true;
}

StripFronts measure_fronts(const WallScene& scene, const Eigen::Vector3d& along, const WallSurface& fit,
                           Span<float> residuals) {
  StripFronts fronts;
  // Small steps may be the rock's own, and a front of rock that was chosen by its residual looks straighter than it is.
  if (!(fit.strips->layers().step_m >= kFrontStepMin_m)) return fronts;
  const double from_m = 0.5 * fit.strips->layers().step_m, range_m = 2.0 * fit.strips->layers().step_m;
  std::uint32_t count = 0;
  double sum = 0.0;
  for (const std::uint32_t i : fit.chosen) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    if (!fit.strips->is_strip(along.dot(p))) continue;
    const double r = fit.irls.plane.signed_distance(p);
    if (!(r >= from_m && r <= from_m + range_m)) continue;
    residuals[count++] = static_cast<float>(r);
    sum += r;
  }
  if (count < kFrontPointsMin) return fronts;
  // Flanks pull the mean down; a few rounds of a narrowing window find where most of the fronts are.
  double centre = sum / count, window = range_m;
  for (int round = 0; round < kFrontRounds; ++round) {
    window *= 0.6;
    double inside = 0.0, inside_sum = 0.0;
    for (const float r : residuals.first(count)) {
      if (!(std::fabs(static_cast<double>(r) - centre) <= window)) continue;
      inside += 1.0;
      inside_sum += static_cast<double>(r);
    }
    if (inside > 0.0) centre = inside_sum / inside;
  }
  for (float& r : residuals.first(count)) r -= static_cast<float>(centre);
  const double scale = robust_scale(residuals.first(count), window);
  fronts.step_m = centre;
  fronts.scale_m = scale < kFrontScaleMin_m ? kFrontScaleMin_m : (scale > kFrontScaleMax_m ? kFrontScaleMax_m : scale);
  fronts.found = true;
  return fronts;
}

}  // namespace

void WallFitScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  chosen = arena.take<std::uint32_t>(points_max);
  residuals = arena.take<float>(points_max);
  patches.lay_out(arena);
  strips.lay_out(arena);
}

void set_layers_apart(const WallScene& scene, const Eigen::Vector3d& along, const IrlsSettings& settings,
                      WallFitScratch* scratch, WallSurface* fit) {
  const Span<float> residuals = scratch->residuals.first(fit->chosen.size());
  signed_distances(scene.band_level, fit->chosen, fit->irls.plane, residuals);
  LayerHistogram histogram(settings.gate_m);
  histogram.add(residuals);
  if (histogram.total() < kLayerPointsMin) return;
  TwoLayers layers =
      find_two_layers(histogram, {settings.scale_min_m, kLayerGainPerPoint * histogram.total(), kLayersApartInSigmas});
  if (!layers.found || !(layers.step_m >= kLayerStepMin_m)) return;
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < fit->chosen.size(); ++k) {
    if (layers.surface_probability(static_cast<double>(residuals[k])) >= 0.5) fit->chosen[count++] = fit->chosen[k];
  }
  fit->chosen = fit->chosen.first(count);
  Plane start = fit->irls.plane;
  start.d -= layers.centre_m;
  fit->irls = irls_tukey(scene.band_level, fit->chosen, start, along, settings, scratch->residuals);
  layers.centre_m = 0.0;  // by the new plane
  fit->layers = layers;
}

void fit_patches(const WallScene& scene, const Eigen::Vector3d& along, PatchGrid::Errors errors, PatchGrid* patches,
                 WallSurface* fit) {
  fit->frame = tangent_frame(fit->irls.plane, Eigen::Vector3d::Zero(), along);
  const TangentFrame& f = fit->frame;
  const WallSurface& surface = *fit;
  const Span<const std::uint32_t> chosen = surface.chosen;
  double u_min = 0.0, u_max = 0.0, v_min = 0.0, v_max = 0.0;
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d q = scene.band_level.at(i) - f.origin;
    const double u = f.u.dot(q), v = f.v.dot(q);
    u_min = u < u_min ? u : u_min;
    u_max = u > u_max ? u : u_max;
    v_min = v < v_min ? v : v_min;
    v_max = v > v_max ? v : v_max;
  }
  patches->begin(u_min, u_max, v_min, v_max, kPatch_m, surface.fronts.found ? 2 : 1);
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d p = scene.band_level.at(i), q = p - f.origin;
    const double r = surface.irls.plane.signed_distance(p), along_m = along.dot(p);
    const double points = static_cast<double>(scene.band_level.weight[i]);
    const double bias = (p - scene.sensor_level_m).normalized().dot(surface.irls.plane.n);
    const double w = surface.weight(along_m, r), front = surface.front_weight(along_m, r);
    if (w > kWeightMin) patches->add(f.u.dot(q), f.v.dot(q), r, w * points, bias, 0);
    if (front > kWeightMin) patches->add(f.u.dot(q), f.v.dot(q), r, front * points, bias, 1);
  }
  fit->patch = patches->fit(errors);
}

void join_fronts(const WallScene& scene, const Eigen::Vector3d& along, Fronts use, WallFitScratch* scratch,
                 WallSurface* fit) {
  WallSurface joint = *fit;
  for (int round = 0; round < kJointRounds; ++round) {
    joint.irls.plane = corrected(joint.irls.plane, joint.frame, joint.patch.correction);
    joint.fronts = measure_fronts(scene, along, joint, scratch->residuals);
    if (!joint.fronts.found) return;
    // Errors are asked for by who compares, after the last round.
    const bool is_step = use == Fronts::kAlways || round + 1 < kJointRounds;
    const PatchGrid::Errors errors = is_step ? PatchGrid::Errors::kPlaneOnly : PatchGrid::Errors::kMeasured;
    fit_patches(scene, along, errors, &scratch->patches, &joint);
    if (!joint.patch.solved) return;
  }
  const Plane alone = corrected(fit->irls.plane, fit->frame, fit->patch.correction);
  const Plane both = corrected(joint.irls.plane, joint.frame, joint.patch.correction);
  const auto slopes = [&](const Plane& p) {
    return Eigen::Vector3d(0.0, p.n.dot(fit->frame.u), p.n.dot(fit->frame.v));
  };
  if (use == Fronts::kAlways || agree(fit->patch, slopes(alone), joint.patch, slopes(both))) *fit = joint;
}

void set_strips_apart(const WallScene& scene, const Eigen::Vector3d& along, const IrlsSettings& settings,
                      WallFitScratch* scratch, WallSurface* fit) {
  const double sensor_m = along.dot(scene.sensor_level_m);
  const double away_m = std::fabs(fit->irls.plane.signed_distance(scene.sensor_level_m));
  StripProfile& strips = scratch->strips;
  strips.begin(sensor_m - kProfileReach_m, fit->heights.min_m, fit->heights.max_m);
  fill_strips(scene, *fit, along, &strips);
  if (!strips.find(sensor_m, kSeenWithin * away_m, settings.gate_m)) return;
  double reach_m = kSeenWithin * away_m;
  for (int ring = 0; ring < kRings; ++ring, reach_m *= 2.0) {
    if (ring > 0) {
      strips.begin_anew();
      fill_strips(scene, *fit, along, &strips);
      strips.judge(sensor_m, reach_m);
    }
    const std::uint32_t count = surface_first(scene, strips, along, fit->chosen);
    fit->irls =
        irls_tukey(scene.band_level, fit->chosen.first(count), fit->irls.plane, along, settings, scratch->residuals);
    if (!fit->irls.solved) return;
    fit->strips = &strips;
    // The next ring is judged by this ring's plane: a drift there would turn rock into strips, and it into more drift.
    WallSurface joint = *fit;
    fit_patches(scene, along, PatchGrid::Errors::kPlaneOnly, &scratch->patches, &joint);
    if (!joint.patch.solved) continue;
    join_fronts(scene, along, Fronts::kAlways, scratch, &joint);
    fit->irls.plane = corrected(joint.irls.plane, joint.frame, joint.patch.correction);
  }
}

}  // namespace pose_wall

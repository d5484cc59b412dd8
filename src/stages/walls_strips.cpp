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

void fill_strips(const WallSurface& fit, StripProfile* strips) {
  const WallPoints& points = *fit.points;
  const double foreshortening = fit.irls.over.foreshortening();
  for (std::uint32_t k = 0; k < fit.count; ++k) {
    const double r = points.at.distance(k, fit.irls.over, foreshortening);
    strips->add(static_cast<double>(points.at.u[k]), points.z_level_m(k), r);
  }
}

// Moves the points of the wall's own surface to the front; returns how many.
std::uint32_t surface_first(const StripProfile& strips, const WallPoints& points, std::uint32_t count) {
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (strips.surface_probability(static_cast<double>(points.at.u[k])) >= 0.5) points.swap(k, first++);
  }
  return first;
}

// Whether two fits differ by no more than their covariances allow; b uses what a uses, and more (Hausman 1978).
bool agree(const WallSurface& a, const WallSurface& b) {
  const Eigen::Vector3d difference = a.over().as_correction() - b.over().as_correction();
  for (int k = 1; k < 3; ++k) {
    const double of_a = a.patch.covariance(k, k), of_b = b.patch.covariance(k, k);
    const double variance = of_a > of_b ? of_a : of_b, apart = difference[k];
    if (!(apart * apart <= kAgreeInSigmas * kAgreeInSigmas * variance)) return false;
  }
  return true;
}

StripFronts measure_fronts(const WallSurface& fit, Span<float> residuals) {
  StripFronts fronts;
  // Small steps may be the rock's own, and a front of rock that was chosen by its residual looks straighter than it is.
  if (!(fit.strips->layers().step_m >= kFrontStepMin_m)) return fronts;
  const double from_m = 0.5 * fit.strips->layers().step_m, range_m = 2.0 * fit.strips->layers().step_m;
  std::uint32_t count = 0;
  double sum = 0.0;
  const TangentPoints& points = fit.points->at;
  const double foreshortening = fit.irls.over.foreshortening();
  for (std::uint32_t k = 0; k < fit.count; ++k) {
    if (!fit.strips->is_strip(static_cast<double>(points.u[k]))) continue;
    const double r = points.distance(k, fit.irls.over, foreshortening);
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

void WallPoints::lay_out(Arena& arena) {
  at.lay_out(arena, kMost);
  bias = arena.take<float>(kMost);
}

void WallPoints::begin(const WallScene& scene, const Plane& around, const Eigen::Vector3d& along_level) {
  at.begin(around, Eigen::Vector3d::Zero(), along_level);
  const TangentFrame& f = at.frame;
  const Eigen::Vector3d from_origin = scene.sensor_level_m - f.origin;
  sensor = Eigen::Vector3d(f.u.dot(from_origin), f.v.dot(from_origin), around.n.dot(from_origin));
  z_at_origin_m = f.origin.z();
  z_per_v = f.v.z();
  z_per_r = around.n.z();
}

void WallPoints::add(const Eigen::Vector3d& p_level, float weight) {
  const std::uint32_t k = at.count;
  at.add(p_level, weight);
  const Eigen::Vector3d ray = Eigen::Vector3d(at.u[k], at.v[k], at.r[k]) - sensor;
  bias[k] = static_cast<float>(ray.z() / std::sqrt(ray.squaredNorm()));
}

void WallPoints::swap(std::uint32_t a, std::uint32_t b) const {
  for (const Span<float>* row : {&at.u, &at.v, &at.r, &at.weight, &bias}) {
    const float kept = (*row)[a];
    (*row)[a] = (*row)[b];
    (*row)[b] = kept;
  }
}

void WallFitScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  near = arena.take<std::uint32_t>(points_max);
  points.lay_out(arena);
  residuals = arena.take<float>(WallPoints::kMost);
  patches.lay_out(arena);
  strips.lay_out(arena);
}

void set_layers_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit) {
  const WallPoints& points = scratch->points;
  const double foreshortening = fit->irls.over.foreshortening();
  LayerHistogram histogram(settings.gate_m);
  for (std::uint32_t k = 0; k < fit->count; ++k) {
    histogram.add(points.at.distance(k, fit->irls.over, foreshortening));
  }
  if (histogram.total() < kLayerPointsMin) return;
  TwoLayers layers =
      find_two_layers(histogram, {settings.scale_min_m, kLayerGainPerPoint * histogram.total(), kLayersApartInSigmas});
  if (!layers.found || !(layers.step_m >= kLayerStepMin_m)) return;
  std::uint32_t outer = 0;
  for (std::uint32_t k = 0; k < fit->count; ++k) {
    const double r = points.at.distance(k, fit->irls.over, foreshortening);
    if (layers.surface_probability(r) >= 0.5) points.swap(k, outer++);
  }
  fit->count = outer;
  PlaneOver start = fit->irls.over;
  start.offset_m += layers.centre_m;
  fit->irls = irls_tukey(points.at, outer, start, settings);
  layers.centre_m = 0.0;  // by the new plane
  fit->layers = layers;
}

void fit_patches(PatchGrid::Errors errors, PatchGrid* patches, WallSurface* fit) {
  const WallSurface& surface = *fit;
  const WallPoints& points = *surface.points;
  float u_min = 0.0F, u_max = 0.0F, v_min = 0.0F, v_max = 0.0F;
  for (std::uint32_t k = 0; k < surface.count; ++k) {
    const float u = points.at.u[k], v = points.at.v[k];
    u_min = u < u_min ? u : u_min;
    u_max = u > u_max ? u : u_max;
    v_min = v < v_min ? v : v_min;
    v_max = v > v_max ? v : v_max;
  }
  patches->begin(static_cast<double>(u_min), static_cast<double>(u_max), static_cast<double>(v_min),
                 static_cast<double>(v_max), kPatch_m, surface.fronts.found ? 2 : 1);
  const double foreshortening = surface.irls.over.foreshortening();
  for (std::uint32_t k = 0; k < surface.count; ++k) {
    const double u = static_cast<double>(points.at.u[k]), v = static_cast<double>(points.at.v[k]);
    const double r = points.at.distance(k, surface.irls.over, foreshortening);
    const double stands_for = static_cast<double>(points.at.weight[k]), bias = static_cast<double>(points.bias[k]);
    const double w = surface.weight(u, r), front = surface.front_weight(u, r);
    if (w > kWeightMin) patches->add(u, v, r, w * stands_for, bias, 0);
    if (front > kWeightMin) patches->add(u, v, r, front * stands_for, bias, 1);
  }
  fit->patch = patches->fit(errors);
}

void join_fronts(Fronts use, WallFitScratch* scratch, WallSurface* fit) {
  WallSurface joint = *fit;
  for (int round = 0; round < kJointRounds; ++round) {
    joint.irls.over = joint.over();
    joint.fronts = measure_fronts(joint, scratch->residuals);
    if (!joint.fronts.found) return;
    // Errors are asked for by who compares, after the last round.
    const bool is_step = use == Fronts::kAlways || round + 1 < kJointRounds;
    const PatchGrid::Errors errors = is_step ? PatchGrid::Errors::kPlaneOnly : PatchGrid::Errors::kMeasured;
    fit_patches(errors, &scratch->patches, &joint);
    if (!joint.patch.solved) return;
  }
  if (use == Fronts::kAlways || agree(*fit, joint)) *fit = joint;
}

void set_strips_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit) {
  const WallPoints& points = scratch->points;
  const double sensor_m = points.sensor.x();
  const PlaneOver& over = fit->irls.over;
  const double away_m = std::fabs(points.sensor.z() - over.offset_m - over.slope_u * points.sensor.x() -
                                  over.slope_v * points.sensor.y());
  StripProfile& strips = scratch->strips;
  strips.begin(sensor_m - kProfileReach_m, fit->heights.min_m, fit->heights.max_m);
  fill_strips(*fit, &strips);
  if (!strips.find(sensor_m, kSeenWithin * away_m, settings.gate_m)) return;
  double reach_m = kSeenWithin * away_m;
  for (int ring = 0; ring < kRings; ++ring, reach_m *= 2.0) {
    if (ring > 0) {
      strips.begin_anew();
      fill_strips(*fit, &strips);
      strips.judge(sensor_m, reach_m);
    }
    const std::uint32_t of_surface = surface_first(strips, points, fit->count);
    fit->irls = irls_tukey(points.at, of_surface, fit->irls.over, settings);
    if (!fit->irls.solved) return;
    fit->strips = &strips;
    // The next ring is judged by this ring's plane: a drift there would turn rock into strips, and it into more drift.
    WallSurface joint = *fit;
    fit_patches(PatchGrid::Errors::kPlaneOnly, &scratch->patches, &joint);
    if (!joint.patch.solved) continue;
    join_fronts(Fronts::kAlways, scratch, &joint);
    fit->irls.over = joint.over();
  }
}

}  // namespace pose_wall

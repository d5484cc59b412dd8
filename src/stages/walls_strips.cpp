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
constexpr int kStepRounds = 4;  // of the surface alone: it tells its roughness, the plane comes of both
constexpr int kJointRounds = 3;
constexpr int kLastRounds = 8;
constexpr double kStandsStill = 5e-5;  // metres, and slopes
constexpr double kAgreeInSigmas = 3.5;
constexpr std::uint32_t kFrontPointsMin = 60;
constexpr double kFrontStepMin_m = 0.06;
constexpr int kFrontRounds = 4;
constexpr double kFrontScaleMin_m = 0.005;
constexpr double kFrontScaleMax_m = 0.03;

void fill_strips(const WallSurface& fit, StripProfile* strips) {
  const WallPoints& points = *fit.points;
  const double foreshortening = fit.irls.over.foreshortening();
  for_each_four(points.at.count, [&](std::uint32_t k, FourTruths counts) {
    const FourFloats r = points.at.four_distances(k, fit.irls.over, foreshortening);
    strips->add(load_four(&points.at.u[k]), points.four_z_level_m(k), r, counts);
  });
}

// The points with the weights they have where the wall's own surface is seen.
TangentPoints surface_points(const WallPoints& points) {
  for_each_four(points.at.count, [&](std::uint32_t k, FourTruths) {
    const FourTruths is_surface = points.columns_of(k).surface_probability >= 0.5F;
    store_four(is_surface ? load_four(&points.at.weight[k]) : FourFloats{}, &points.spare[k]);
  });
  TangentPoints out = points.at;
  out.weight = points.spare;
  return out;
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

// Residuals between the two of points in strips' columns.
Span<float> fronts_between(const WallSurface& fit, double from_m, double to_m) {
  const WallPoints& points = *fit.points;
  const double foreshortening = fit.irls.over.foreshortening();
  const FourFloats from = all_four(static_cast<float>(from_m)), to = all_four(static_cast<float>(to_m));
  std::uint32_t count = 0;
  for_each_four(points.at.count, [&](std::uint32_t k, FourTruths counts) {
    const FourFloats r = points.at.four_distances(k, fit.irls.over, foreshortening);
    FourTruths stands_out = counts & (r >= from) & (r <= to);
    if (!any_of(stands_out)) return;
    stands_out &= points.columns_of(k).is_strip;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (stands_out[lane] != 0) points.spare[count++] = r[lane];
    }
  });
  return points.spare.first(count);
}

// Flanks pull the mean down; a few rounds of a narrowing window find where most of the fronts are.
double where_most_are(Span<float> residuals, double* window_m) {
  double sum = 0.0;
  for (const float r : residuals) sum += static_cast<double>(r);
  double centre = sum / residuals.size();
  for (int round = 0; round < kFrontRounds; ++round) {
    *window_m *= 0.6;
    double inside = 0.0, inside_sum = 0.0;
    for (const float r : residuals) {
      if (!(std::fabs(static_cast<double>(r) - centre) <= *window_m)) continue;
      inside += 1.0;
      inside_sum += static_cast<double>(r);
    }
    if (inside > 0.0) centre = inside_sum / inside;
  }
  return centre;
}

StripFronts measure_fronts(const WallSurface& fit) {
  StripFronts fronts;
  // Small steps may be the rock's own, and a front of rock that was chosen by its residual looks straighter than it is.
  const double step_m = fit.strips->layers().step_m;
  if (!(step_m >= kFrontStepMin_m)) return fronts;
  const Span<float> residuals = fronts_between(fit, 0.5 * step_m, 2.5 * step_m);
  if (residuals.size() < kFrontPointsMin) return fronts;
  double window_m = 2.0 * step_m;
  fronts.step_m = where_most_are(residuals, &window_m);
  for (float& r : residuals) r -= static_cast<float>(fronts.step_m);
  const double scale = robust_scale(residuals, window_m);
  fronts.scale_m = scale < kFrontScaleMin_m ? kFrontScaleMin_m : (scale > kFrontScaleMax_m ? kFrontScaleMax_m : scale);
  fronts.found = true;
  return fronts;
}

}  // namespace

void WallFitScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  near = arena.take<std::uint32_t>(points_max);
  points.lay_out(arena);
  patches.lay_out(arena);
  strips.lay_out(arena);
}

void set_layers_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit) {
  WallPoints& points = scratch->points;
  const double foreshortening = fit->irls.over.foreshortening();
  LayerHistogram histogram(settings.gate_m);
  for (std::uint32_t k = 0; k < points.at.count; ++k) {
    histogram.add(points.at.distance(k, fit->irls.over, foreshortening));
  }
  if (histogram.total() < kLayerPointsMin) return;
  TwoLayers layers =
      find_two_layers(histogram, {settings.scale_min_m, kLayerGainPerPoint * histogram.total(), kLayersApartInSigmas});
  if (!layers.found || !(layers.step_m >= kLayerStepMin_m)) return;
  for (std::uint32_t k = 0; k < points.at.count; ++k) {
    const double r = points.at.distance(k, fit->irls.over, foreshortening);
    points.spare[k] = layers.surface_probability(r) >= 0.5 ? 1.0F : 0.0F;
  }
  points.keep(points.spare);
  PlaneOver start = fit->irls.over;
  start.offset_m += layers.centre_m;
  fit->irls = irls_tukey(points.at, points.at.count, start, settings);
  layers.centre_m = 0.0;  // by the new plane
  fit->layers = layers;
}

namespace {

// What four points weigh: as WallSurface::weight(), and as a part of the strips' fronts.
class FourWeights {
 public:
  explicit FourWeights(const WallSurface& surface)
      : surface_(surface),
        per_cutoff_(static_cast<float>(1.0 / (kTukeyCutoff * surface.irls.scale_m))),
        front_per_cutoff_(surface.fronts.found ? static_cast<float>(1.0 / (kTukeyCutoff * surface.fronts.scale_m))
                                               : 0.0F) {}

  void look_at(std::uint32_t k, FourFloats r) {
    of_surface = flat_top_weights(r, static_cast<float>(kSensorNoise_m), per_cutoff_);
    if (surface_.strips != nullptr) {
      const StripProfile::FourColumns columns = surface_.points->columns_of(k);
      of_surface *= columns.surface_probability;
      if (surface_.fronts.found) {
        const FourFloats front = tukey_weights(r - static_cast<float>(surface_.fronts.step_m), front_per_cutoff_);
        of_fronts = columns.is_strip ? front : FourFloats{};
      }
    } else if (surface_.layers.found) {
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        of_surface[lane] *= static_cast<float>(surface_.layers.surface_probability(static_cast<double>(r[lane])));
      }
    }
  }

  FourFloats of_surface{}, of_fronts{};

 private:
  const WallSurface& surface_;
  float per_cutoff_, front_per_cutoff_;
};

}  // namespace

void fit_patches(PatchGrid::Errors errors, PatchGrid* patches, WallSurface* fit) {
  const WallSurface& surface = *fit;
  const WallPoints& points = *surface.points;
  const double foreshortening = surface.irls.over.foreshortening();
  FourWeights weights(surface);
  patches->begin_anew(surface.fronts.found ? 2 : 1);
  std::uint32_t k = 0;
  for (std::uint32_t patch = 0; patch < patches->patches(); ++patch) {
    PatchGrid::Sums of_surface, of_fronts;
    const std::uint32_t end = points.patch_end[patch];
    for (; k < end; k += kFour) {
      const FourTruths counts = first_of_four(end - k);
      const FourFloats r = points.at.four_distances(k, surface.irls.over, foreshortening);
      const FourFloats stands_for = counts ? load_four(&points.at.weight[k]) : FourFloats{};
      const FourPoints four{load_four(&points.at.u[k]), load_four(&points.at.v[k]), r, load_four(&points.bias[k])};
      weights.look_at(k, r);
      of_surface.add(four, weights.of_surface * stands_for);
      if (surface.fronts.found) of_fronts.add(four, weights.of_fronts * stands_for);
    }
    k = end;
    patches->set(patch, 0, of_surface);
    if (surface.fronts.found) patches->set(patch, 1, of_fronts);
  }
  fit->patch = patches->fit(errors);
}

namespace {

// Fits surface and fronts together, again and again from where the last fit left the plane, until it stands still.
// False where no fronts are found.
bool step_with_fronts(int rounds_max, const WallSurface& surface, WallFitScratch* scratch, PlaneOver* over) {
  WallSurface joint = surface;
  joint.irls.over = *over;
  for (int round = 0; round < rounds_max; ++round) {
    joint.fronts = measure_fronts(joint);
    if (!joint.fronts.found) return false;
    fit_patches(PatchGrid::Errors::kPlaneOnly, &scratch->patches, &joint);
    if (!joint.patch.solved) return false;
    joint.irls.over = joint.over();
    if (joint.patch.correction.cwiseAbs().maxCoeff() < kStandsStill) break;
  }
  *over = joint.irls.over;
  return true;
}

}  // namespace

void join_fronts(WallFitScratch* scratch, WallSurface* fit) {
  WallSurface joint = *fit;
  joint.irls.over = fit->over();
  if (!step_with_fronts(kLastRounds, *fit, scratch, &joint.irls.over)) return;
  joint.fronts = measure_fronts(joint);
  if (!joint.fronts.found) return;
  fit_patches(PatchGrid::Errors::kMeasured, &scratch->patches, &joint);
  if (joint.patch.solved && agree(*fit, joint)) *fit = joint;
}

void set_strips_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit) {
  WallPoints& points = scratch->points;
  const double sensor_m = points.sensor.x();
  const PlaneOver& first = fit->irls.over;
  const double away_m = std::fabs(points.sensor.z() - first.offset_m - first.slope_u * points.sensor.x() -
                                  first.slope_v * points.sensor.y());
  StripProfile& strips = scratch->strips;
  strips.begin(sensor_m - kProfileReach_m, fit->heights.min_m, fit->heights.max_m);
  fill_strips(*fit, &strips);
  if (!strips.find(sensor_m, kSeenWithin * away_m, settings.gate_m)) return;
  double reach_m = kSeenWithin * away_m;
  IrlsSettings step = settings;
  step.stands_still = kStandsStill;
  step.rounds = kStepRounds;
  for (int ring = 0; ring < kRings; ++ring, reach_m *= 2.0) {
    if (ring > 0) {
      strips.begin_anew();
      fill_strips(*fit, &strips);
      if (!strips.judge(sensor_m, reach_m)) continue;  // an opening: the wall may go on behind it
    }
    points.mark_columns(strips);
    fit->irls = irls_tukey(surface_points(points), points.at.count, fit->irls.over, step);
    if (!fit->irls.solved) return;
    fit->strips = &strips;
    // The next ring is judged by this ring's plane: a drift there would turn rock into strips, and it into more drift.
    PlaneOver over = fit->irls.over;
    if (step_with_fronts(kJointRounds, *fit, scratch, &over)) {
      fit->irls.over = over;
      continue;
    }
    WallSurface alone = *fit;
    fit_patches(PatchGrid::Errors::kPlaneOnly, &scratch->patches, &alone);
    if (alone.patch.solved) fit->irls.over = alone.over();
  }
}

}  // namespace pose_wall

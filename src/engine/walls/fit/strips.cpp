// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/fit/strips.hpp"

#include <cmath>

#include "base/estimation/protection.hpp"
#include "base/estimation/robust_scale.hpp"

namespace pose_wall {
namespace {

// Times the wall's distance; further, strips hide the rock; swept: half 1 lost 2 won, twice 1 won.
constexpr double kSeenWithin = 1.5;
constexpr double kProfileReach_m = 32.0;  // to each side, as far as the wall's grid
constexpr int kRings = 4;  // each twice as far; three and four times as far changed nothing (bench/README.md)
// A ring that adds a smaller share of points is judged, but not fitted: no error grows, and 2.2 M of 59.8 M
// instructions are saved (bench/README.md). Its points count in the last fit.
constexpr double kWorthAFit = 0.12;
constexpr double kLayerPointsMin = 100.0;    // fewer points show no layers; swept: half and twice change nothing
constexpr double kLayerGainPerPoint = 0.02;  // of log likelihood; swept: half nothing, twice 1 won
// Less is a sensor's noise, split by voxels; swept: half 2 moved, twice 1 lost.
constexpr double kLayerStepMin_m = 0.045;
// Clearly apart; two tops need two; swept: half 1 lost, twice 1 lost 4 won.
constexpr double kLayersApartInSigmas = 2.5;
// For the surface's roughness; both give the plane; swept: half 21 moved, twice 12 moved.
constexpr int kStepRounds = 4;
// A round that moves the plane less is the last. Of a ring's fit the next ring needs only the direction.
struct JointRounds {
  int most;
  double offset_stands_still_m, slopes_stand_still;
};
constexpr double kAnyOffset_m = 1e9;  // beyond every offset
constexpr JointRounds kOfARing{3, kAnyOffset_m, 5e-4};
constexpr JointRounds kLast{8, 2e-4, 2e-4};
// Fronts that disagree more are out (Hausman 1978). Not the factor of the levels: a smaller risk must not let more
// join.
constexpr double kAgreeInSigmas = 5.0;         // swept: half 1 moved, twice nothing
constexpr std::uint32_t kFrontPointsMin = 60;  // fewer points are no fronts; swept: half 1 moved, twice 2 moved
constexpr double kFrontStepMin_m = 0.06;       // fronts of a smaller step, chosen by residual, look too straight
constexpr int kFrontRounds = 4;                // 0.6^4 = 0.13: the window narrows from two steps to a quarter of one
constexpr double kFrontScaleMin_m = 0.005;     // voxels average a range's noise; swept: half 1 moved, twice 7 moved
constexpr double kFrontScaleMax_m = 0.03;      // fronts of steel are straight; swept: half 7 moved, twice nothing

void fill_strips(const WallPoints& points, StripProfile* strips) {
  const TangentPoints& at = points.at;
  for_each_four(at.count, [&](std::uint32_t k, FourTruths counts) {
    strips->add(load_four(&at.u[k]), load_four(&at.v[k]), load_four(&at.r[k]), points.four_z_level_m(k), counts);
  });
}

// True if two fits differ by no more than their covariances allow. b uses all that a uses, and more (Hausman 1978).
bool agree(const WallSurface& a, const WallSurface& b) {
  const Eigen::Vector3d difference = a.over().as_correction() - b.over().as_correction();
  for (int k = 1; k < 3; ++k) {
    const Spread of_a = a.patch.errors.spread_of(Eigen::Vector3d::Unit(k), kAgreeInSigmas);
    const Spread of_b = b.patch.errors.spread_of(Eigen::Vector3d::Unit(k), kAgreeInSigmas);
    const Spread& wider = of_a.variance > of_b.variance ? of_a : of_b;
    const double factor = protection_factor(kAgreeInSigmas, wider.dof), apart = difference[k];
    if (!(apart * apart <= factor * factor * wider.variance)) return false;
  }
  return true;
}

// Residuals from from_m to to_m of points in strips' columns.
Span<float> fronts_between(const WallSurface& fit, double from_m, double to_m) {
  const WallPoints& points = *fit.points;
  const double foreshortening = fit.irls.over.foreshortening();
  const FourFloats from = all_four(static_cast<float>(from_m)), to = all_four(static_cast<float>(to_m));
  std::uint32_t count = 0;
  points.for_each_patch([&](const WallPoints::Patch& patch, std::uint32_t) {
    for_each_four(patch.surface_only_end, patch.strip_end, [&](std::uint32_t k, FourTruths counts) {
      const FourFloats r = points.at.four_distances(k, fit.irls.over, foreshortening);
      const FourTruths stands_out = counts & (r >= from) & (r <= to);
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        if (stands_out[lane] != 0) points.spare[count++] = r[lane];
      }
    });
  });
  return points.spare.first(count);
}

// Mean of the residuals within the window around the centre; the centre if there are none.
double mean_within(Span<const float> residuals, double centre, double window_m) {
  const FourFloats middle = all_four(static_cast<float>(centre)), reach = all_four(static_cast<float>(window_m)),
                   none{};
  FourFloats sum{};
  FourInts count{};  // true is -1
  for_each_four(residuals.size(), [&](std::uint32_t k, FourTruths counts) {
    const FourFloats off = load_four(&residuals[k]) - middle;
    const FourTruths inside = counts & (magnitude_of(off) <= reach);
    sum += inside ? off : none;
    count -= inside;
  });
  const std::uint32_t inside = sum_of_lanes(count);
  return inside > 0 ? centre + sum_of_lanes(sum) / inside : centre;
}

// Flanks pull the mean down. A few rounds with a narrowing window find most of the fronts.
double where_most_are(Span<const float> residuals, double* window_m) {
  double centre = mean_within(residuals, 0.0, 1e3);
  for (int round = 0; round < kFrontRounds; ++round) {
    *window_m *= 0.6;
    centre = mean_within(residuals, centre, *window_m);
  }
  return centre;
}

StripFronts measure_fronts(const WallSurface& fit) {
  StripFronts fronts;
  // Small steps may be the rock's own, and rock chosen by its residual looks straighter than it is.
  if (fit.strips == nullptr || !(fit.strips->layers().step_m >= kFrontStepMin_m)) return fronts;
  const double step_m = fit.strips->layers().step_m;
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
  scratch->work.add(fit->irls.work);
  layers.centre_m = 0.0;  // relative to the new plane
  fit->layers = layers;
}

namespace {

// Weights of four points: as the surface, like WallSurface::weight(), and as a strip's front.
class FourWeights {
 public:
  explicit FourWeights(const WallSurface& surface)
      : surface_(surface),
        per_cutoff_(static_cast<float>(1.0 / (kTukeyCutoff * surface.irls.scale_m))),
        front_per_cutoff_(surface.fronts.found ? static_cast<float>(1.0 / (kTukeyCutoff * surface.fronts.scale_m))
                                               : 0.0F) {}

  FourFloats of_surface(std::uint32_t k, FourFloats r) const {
    FourFloats weights = flat_top_weights(r, static_cast<float>(surface_.points->range_noise_m), per_cutoff_);
    if (surface_.strips != nullptr) return weights * surface_.points->surface_probability(k);
    return surface_.layers.found ? weights * surface_.layers.surface_probability(r) : weights;
  }

  FourFloats of_fronts(FourFloats r) const {
    return tukey_weights(r - static_cast<float>(surface_.fronts.step_m), front_per_cutoff_);
  }

 private:
  const WallSurface& surface_;
  float per_cutoff_, front_per_cutoff_;
};

// Sums the patches of the surface and of the fronts, if found. Not inlined, since it is called from two places.
[[gnu::noinline]] void sum_patches(const WallSurface& surface, PatchGrid* patches) {
  const WallPoints& points = *surface.points;
  const double foreshortening = surface.irls.over.foreshortening();
  const FourWeights weights(surface);
  patches->begin_anew(surface.fronts.found ? 2 : 1);
  // of_four(k, distances): weights of four points.
  const auto sums = [&](std::uint32_t begin, std::uint32_t end, const auto& of_four) {
    PatchLanes out;
    for_each_four(begin, end, [&](std::uint32_t k, FourTruths counts) {
      const FourFloats r = points.at.four_distances(k, surface.irls.over, foreshortening);
      const FourFloats stands_for = counts ? load_four(&points.at.weight[k]) : FourFloats{};
      out.add({load_four(&points.at.u[k]), load_four(&points.at.v[k]), r, load_four(&points.bias[k])},
              of_four(k, r) * stands_for);
    });
    return out;
  };
  std::uint32_t index = 0;
  points.for_each_patch([&](const WallPoints::Patch& patch, std::uint32_t begin) {
    patches->set(index, 0, sums(begin, patch.surface_end, [&](std::uint32_t k, FourFloats r) {
                   return weights.of_surface(k, r);
                 }));
    if (surface.fronts.found) {
      patches->set(index, 1, sums(patch.surface_only_end, patch.strip_end, [&](std::uint32_t, FourFloats r) {
                     return weights.of_fronts(r);
                   }));
    }
    ++index;
  });
}

}  // namespace

void fit_patches(PatchGrid::Errors errors, WallFitScratch* scratch, WallSurface* fit) {
  sum_patches(*fit, &scratch->patches);
  fit->patch = scratch->patches.fit(errors);
  scratch->work.add(scratch->points.at.count, steps::kPointSummed);
  scratch->work.add(fit->patch.work);
}

namespace {

// Fits surface and fronts together, each time from the last plane, until it settles. The last correction is left to
// over(), since the patches' sums belong to the plane before it. False if no fronts are found. alone: gets the
// surface's own fit from the first plane with its covariance, unless null.
bool fit_with_fronts(const JointRounds& rounds, WallFitScratch* scratch, WallSurface* joint,
                     PatchFit* alone = nullptr) {
  for (int round = 1;; ++round) {
    joint->fronts = measure_fronts(*joint);
    if (!joint->fronts.found) return false;
    sum_patches(*joint, &scratch->patches);
    scratch->work.add(scratch->points.at.count, steps::kPointSummed);
    if (round == 1 && alone != nullptr) {
      scratch->patches.begin_anew(1);
      *alone = scratch->patches.fit(PatchGrid::Errors::kCovariance);
      scratch->work.add(alone->work);
      if (!alone->solved) return false;
      scratch->patches.begin_anew(PatchGrid::kLayersMax);
    }
    joint->patch = scratch->patches.fit(PatchGrid::Errors::kPlaneOnly);
    scratch->work.add(joint->patch.work);
    if (!joint->patch.solved) return false;
    const Eigen::Vector3d moved = joint->patch.correction.cwiseAbs();
    const bool stands_still =
        moved[0] < rounds.offset_stands_still_m && moved.tail<2>().maxCoeff() < rounds.slopes_stand_still;
    if (stands_still || round == rounds.most || scratch->work.stops()) return true;
    joint->irls.over = joint->over();
  }
}

}  // namespace

bool join_fronts(WallFitScratch* scratch, WallSurface* fit) {
  WallSurface joint = *fit;
  if (!fit_with_fronts(kLast, scratch, &joint, &fit->patch)) return false;
  joint.patch = scratch->patches.fit(PatchGrid::Errors::kMeasured);
  scratch->work.add(joint.patch.work);
  if (!joint.patch.solved || !agree(*fit, joint)) return false;
  *fit = joint;
  return true;
}

namespace {

// Results of one ring's fit for the next ring.
struct LastRing {
  PlaneOver surface_alone, left_off;
  bool had_fronts = false;
};

// Fits the wall by the columns judged so far: the surface alone, then with the strips' fronts. False if the surface
// cannot be fitted.
bool fit_ring(const IrlsSettings& step, WallFitScratch* scratch, LastRing* last, WallSurface* fit) {
  WallPoints& points = scratch->points;
  points.copy_surface();
  fit->irls = irls_tukey(points.surface, points.surface.count, last->surface_alone, step);
  scratch->work.add(fit->irls.work);
  if (!fit->irls.solved) return false;
  fit->strips = &scratch->strips;
  last->surface_alone = fit->irls.over;
  // This ring's plane judges the next ring only. A drift there would turn rock into strips, and these into more drift.
  WallSurface next = *fit;
  if (last->had_fronts) next.irls.over = last->left_off;
  last->had_fronts = fit_with_fronts(kOfARing, scratch, &next);
  if (!last->had_fronts) {
    next = *fit;
    fit_patches(PatchGrid::Errors::kPlaneOnly, scratch, &next);
  }
  if (next.patch.solved) fit->irls.over = last->left_off = next.over();
  return true;
}

}  // namespace

void set_strips_apart(const IrlsSettings& settings, WallFitScratch* scratch, WallSurface* fit) {
  WallPoints& points = scratch->points;
  const double sensor_m = points.sensor.x();
  const PlaneOver& first = fit->irls.over;
  const double away_m = std::fabs(points.sensor.z() - first.offset_m - first.slope_u * points.sensor.x() -
                                  first.slope_v * points.sensor.y());
  StripProfile& strips = scratch->strips;
  strips.begin(sensor_m - kProfileReach_m, fit->heights.min_m, fit->heights.max_m);
  fill_strips(points, &strips);
  scratch->work.add(steps::kProfile);
  if (!strips.find(fit->irls.over, sensor_m, kSeenWithin * away_m, settings.gate_m)) return;
  double reach_m = kSeenWithin * away_m;
  IrlsSettings step = settings;
  step.rounds = kStepRounds;
  LastRing last;
  last.surface_alone = fit->irls.over;
  bool marked = false;  // the points are marked by the columns
  for (int ring = 0; ring < kRings && !scratch->work.stops(); ++ring, reach_m *= 2.0) {
    const double added = ring > 0 ? strips.judge(fit->irls.over, sensor_m, reach_m) : 1.0;
    if (ring > 0) scratch->work.add(steps::kProfile);
    if (added > 0.0) marked = false;
    if (!(added > kWorthAFit)) continue;  // also at an opening, since the wall may go on behind it
    points.mark_columns(strips, scratch->near);
    scratch->work.add(points.at.count, steps::kPointByColumn);
    marked = true;
    if (!fit_ring(step, scratch, &last, fit)) return;
  }
  if (!marked) points.mark_columns(strips, scratch->near);
}

}  // namespace pose_wall

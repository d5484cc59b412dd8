// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/floor/fit.hpp"

#include <cmath>

#include "base/containers/even_share.hpp"
#include "base/estimation/irls.hpp"
#include "base/estimation/near_plane.hpp"
#include "base/estimation/plane_halves.hpp"
#include "base/estimation/tangent_frame.hpp"
#include "base/estimation/tukey.hpp"
#include "base/math/rotation.hpp"
#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// Relative to a range's noise. Centroids of dense voxels scatter far less. But at a finer scale the thinner half of a
// voxel layer that the plane cuts became outliers: mean z2 2 to 6 (README, tried and dropped).
constexpr double kScaleLeastInNoise = 2.0 / 3.0;
constexpr double kStretch = 1.25;  // a floor of 30 degrees stretches a radius by 1.155; the gate adds height
constexpr int kRounds = 5;         // most fits settle earlier; swept: half 26 moved, twice 3 moved
// The gate widens after the first; two more let the fit settle; swept: half 26 moved, twice 13 moved.
constexpr int kSelections = 3;

IrlsSettings irls_settings(const Settings& s) {
  return {kOwnInThresholds * s.ground_ransac_thresh, kScaleLeastInNoise * s.range_noise, s.ground_ransac_thresh,
          kRounds, kBeforePatches};
}

// If the scale fills so much of its limit, the gate cuts off waves, and doubles:
constexpr double kFull = 0.7;   // swept: half 43 moved, twice 2 lost 6 won 1 beyond
constexpr double kWider = 2.0;  // swept: half 2 lost 6 won 1 beyond, twice 1 won

void widen(IrlsSettings* tukey) {
  tukey->gate_m *= kWider;
  tukey->scale_max_m *= kWider;
}

// True if the plane moved so little that a new selection would pick the same points.
bool stands_still(const Plane& a, const Plane& b) {
  // Metres and slopes: hardly a point crosses the gate; swept: half 9 moved, twice 4 moved.
  constexpr double kStill = 2e-4;
  return std::fabs(a.d - b.d) < kStill && (a.n - b.n).cwiseAbs().maxCoeff() < kStill;
}

// Selects points by height over the plane and clear of anything that stands on the floor. The radius cuts where the ray
// meets the plane. By measured place, a ring of the sensor at the radius would keep its short ranges only, which look
// like a higher floor.
Span<std::uint32_t> select(const FloorLook& look, const FloorGrid& grid, const Plane& plane, double gate_m,
                           const Eigen::Vector3d& sensor_base_m, Span<std::uint32_t> out) {
  const double sensor_m = plane.signed_distance(sensor_base_m);
  if (!(sensor_m > gate_m)) return {};
  const auto gate = static_cast<float>(gate_m), inside = static_cast<float>(sensor_m);
  const auto radius2 = static_cast<float>(look.radius_m * look.radius_m);
  const Eigen::Vector3f sensor = sensor_base_m.cast<float>();
  const FourDistances distances(plane);
  EvenShare share(look.open_most, look.open_base.count);
  std::uint32_t count = 0;
  for_each_four_points(
      look.open_base, [&](std::uint32_t k, FourFloats px, FourFloats py, FourFloats pz, FourTruths counts) {
        if (!share.takes()) return;
        const FourFloats height = distances.of(px, py, pz);
        counts &= (height >= -gate) & (height <= gate);
        if (!any_of(counts)) return;
        const FourFloats way = inside / (inside - height);  // to where the ray meets the plane
        const FourFloats x = sensor.x() + (px - sensor.x()) * way, y = sensor.y() + (py - sensor.y()) * way;
        counts &= x * x + y * y <= radius2;
        if (!any_of(counts)) return;
        counts = grid.clear_around(x, y, counts);
        for (std::uint32_t lane = 0; lane < kFour; ++lane) {
          if (counts[lane] != 0) out[count++] = k + lane;
        }
      });
  return out.first(count);
}

// Response of an angle to the fit's correction (offset, slope u, slope v): the normal moves by -slope u - slope v.
Eigen::Vector3d response(const Eigen::Vector3d& gradient, const TangentFrame& f) {
  return {0.0, -gradient.dot(f.u), -gradient.dot(f.v)};
}

// Works in the coordinates of the fit's points. Their residuals are from the plane over these coordinates.
void fill_patches(const FloorScene& scene, const IrlsResult& irls, double radius_m, FloorScratch* scratch) {
  const Eigen::Vector3d& sensor_base_m = scene.sensor_base_m;
  const double range_noise_m = scene.settings.range_noise;
  const TangentPoints& points = scratch->points;
  const double reach_m = kStretch * radius_m;
  scratch->patches.begin(-reach_m, reach_m, -reach_m, reach_m, PatchGrid::kPatch_m, range_noise_m);
  scratch->surface.begin(reach_m, PatchGrid::kPatch_m);
  // A range error moves a point along the ray. Height and place err together, which tilts a plane seen over a short
  // length. On a floor no rougher than the ranges the error is taken back along the ray, to where it meets the plane.
  const double rougher = irls.scale_m / (kScaleLeastInNoise * range_noise_m) - 1.0;
  const auto noise_share = static_cast<float>(rougher < 1.0 ? 1.0 - rougher : 0.0);
  const auto inside = static_cast<float>(irls.plane.signed_distance(sensor_base_m));
  const auto per_cutoff = static_cast<float>(1.0 / (kTukeyCutoff * irls.scale_m));
  const double foreshortening = irls.over.foreshortening();
  const Eigen::Vector3f sensor = points.in_frame(sensor_base_m).cast<float>();
  for_each_four(points.count, [&](std::uint32_t k, FourTruths counts) {
    const FourFloats r = points.four_distances(k, irls.over, foreshortening);
    const FourFloats du = load_four(&points.u[k]) - sensor.x(), dv = load_four(&points.v[k]) - sensor.y();
    const FourFloats dr = load_four(&points.r[k]) - sensor.z();
    const FourFloats bias = (r - inside) / root_of(du * du + dv * dv + dr * dr);
    const FourFloats way = 1.0F + noise_share * (inside / (inside - r) - 1.0F);
    const FourFloats u = sensor.x() + du * way, v = sensor.y() + dv * way;
    const FourFloats weights =
        flat_top_weights(r, static_cast<float>(range_noise_m), per_cutoff) * load_four(&points.weight[k]);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] == 0 || !(weights[lane] > kPatchWeightLeast)) continue;
      const PatchPoint point = PatchPoint::of(u[lane], v[lane], r[lane], weights[lane], bias[lane]);
      scratch->patches.add(point);
      scratch->surface.add(point);
    }
  });
}

void count_inliers(const PointSet& within_base, double thresh_m, PlaneFit* fit) {
  const FourDistances distances(fit->plane);
  const FourFloats thresh = all_four(static_cast<float>(thresh_m)), none{};
  FourFloats squares{}, measured{};
  FourInts voxels{};  // true is -1
  for_each_four(within_base.count, [&](std::uint32_t k, FourTruths counts) {
    const FourFloats r = distances.of(within_base, k);
    counts &= magnitude_of(r) <= thresh;
    squares += counts ? r * r : none;
    measured += counts ? load_four(&within_base.weight[k]) : none;
    voxels -= counts;
  });
  const std::uint32_t inside = sum_of_lanes(voxels);
  fit->inliers = static_cast<std::uint32_t>(sum_of_lanes(measured));
  fit->rms_m = inside > 0 ? std::sqrt(sum_of_lanes(squares) / inside) : 0.0;
}

// bend: from PatchGrid, which tests the floor for a bend as a whole. The rest is from the plane through its waves.
void set_uncertainty(const UnevenFit& uneven, const PatchFit& bend, Span<const SurfacePatch> patches,
                     const TangentFrame& f, const Plane& plane, const Settings& s, FloorResult* out) {
  const RollPitchGradients gradients(plane.n);
  const Eigen::Vector3d roll = response(gradients.roll, f), pitch = response(gradients.pitch, f);
  out->roll.sigma_rad = std::sqrt(roll.dot(uneven.covariance * roll));
  out->pitch.sigma_rad = std::sqrt(pitch.dot(uneven.covariance * pitch));
  // If the floor bends, the tilt under the machine (u = v = 0) differs from that of the whole fit.
  const Eigen::Vector3d here(0.0, bend.bend_slope_u_at(0.0, 0.0), bend.bend_slope_v_at(0.0, 0.0));
  // A bend absorbs part of a kerb, and a kerb part of a bend.
  const auto not_a_plane = [&](const Eigen::Vector3d& of) {
    return std::fabs(of.dot(here)) + reach_of_halves(patches, uneven.correction, of);
  };
  out->roll.bound_rad[POSE_WALL_PART_RANGE_BIAS] = s.range_bias_max * std::fabs(roll.dot(uneven.bias_response));
  out->pitch.bound_rad[POSE_WALL_PART_RANGE_BIAS] = s.range_bias_max * std::fabs(pitch.dot(uneven.bias_response));
  out->roll.bound_rad[POSE_WALL_PART_BEND] = not_a_plane(roll);
  out->pitch.bound_rad[POSE_WALL_PART_BEND] = not_a_plane(pitch);
  out->roll.dof = out->pitch.dof = uneven.dof;
  out->frame = f;
  out->uneven = uneven;
}

// Fits the plane to the points about it and selects again until it settles. The points stay in the scratch.
IrlsResult fit_selected(const FloorScene& scene, const FloorLook& look, const Plane& start, FloorScratch* scratch) {
  IrlsSettings tukey = irls_settings(scene.settings);
  const Eigen::Vector3d u_hint = Eigen::Vector3d::UnitX();
  IrlsResult irls;
  irls.plane = start;
  for (int selection = 0; selection < kSelections; ++selection) {
    scratch->grid.mark_rising(scene.cloud_base, irls.plane, tukey.gate_m);
    scratch->work.add(scene.cloud_base.count, steps::kPointMarked);
    // The low points are not needed any more. Their room holds the selection.
    const Span<std::uint32_t> chosen =
        select(look, scratch->grid, irls.plane, tukey.gate_m, scene.sensor_base_m, scratch->low);
    const Plane before = irls.plane;
    const std::uint32_t half = look.open_most / 2, room = scratch->points.capacity();
    const std::uint32_t taken_most = half < room ? half : room;
    irls = irls_tukey(look.open_base, thinned(chosen, taken_most), before, u_hint, tukey, &scratch->points);
    const std::uint32_t offered = look.open_base.count < look.open_most ? look.open_base.count : look.open_most;
    scratch->work.add(offered, steps::kPointSelected);
    scratch->work.add(irls.work);
    if (!irls.solved || (selection > 0 && stands_still(before, irls.plane))) break;
    if (selection + 1 < kSelections && scratch->work.stops()) break;
    if (selection == 0 && irls.scale_m > kFull * tukey.scale_max_m) widen(&tukey);
  }
  return irls;
}

}  // namespace

FloorResult fit_floor(const FloorScene& scene, const FloorLook& look, const Plane& start, FloorScratch* scratch) {
  const Settings& settings = scene.settings;
  FloorResult out;
  const IrlsResult irls = fit_selected(scene, look, start, scratch);
  out.fit.plane = irls.plane;
  if (scratch->work.stops()) {
    out.fit.refuse(POSE_WALL_R_WORK_LIMIT);
    return out;
  }
  if (irls.solved) fill_patches(scene, irls, look.radius_m, scratch);
  const PatchFit bend = irls.solved ? scratch->patches.fit(PatchGrid::Errors::kBend) : PatchFit{};
  const Span<const SurfacePatch> patches = bend.solved ? scratch->surface.collect() : Span<const SurfacePatch>();
  scratch->work.add(scratch->points.count, steps::kPointPatched);
  scratch->work.add(bend.work);
  scratch->work.add(patches.size(), steps::kPatchWaved);
  const UnevenFit uneven =
      bend.solved ? scratch->patches.waves().fit(patches, settings.protection_sigmas) : UnevenFit{};
  if (!demand<gate::FLOOR_FIT>(&out.fit, uneven.solved)) return out;
  PlaneOver over = irls.over;
  over.add(uneven.correction);
  out.fit.plane = scratch->points.plane_of(over);
  out.fit.found = true;
  count_inliers(look.within_base, settings.ground_ransac_thresh, &out.fit);
  set_uncertainty(uneven, bend, patches, scratch->points.frame, out.fit.plane, settings, &out);
  return out;
}

}  // namespace pose_wall

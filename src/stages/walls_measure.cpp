// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_measure.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "math/elementary.hpp"
#include "math/larger.hpp"
#include "stages/walls_at_sample.hpp"
#include "trace/trace.hpp"

namespace pose_wall {
namespace {

constexpr double kExtrapolated_m = 0.75;
// A bend is told where it takes up this much of an alert limit.
constexpr double kBendMatters = 0.2;
// By how much more the direction errs than the covariance says. Which columns are strips is told by the plane that they
// then tell. And rock is rough over more lengths than one: of what neighbouring patches have in common, a part reaches
// further than is looked at. Measured on simulated roads, thousands of looks by four sensors: 1.3 to 1.7 times with
// strips, 1.1 to 1.25 times on rock without, once on flat walls. Distances near the sensor hang on the offset, which
// has standard deviations of its own for both.
constexpr double kStripsStretch = 1.5;
constexpr double kRockStretch = 1.2;
constexpr double kRockFrom_m = 0.005;  // roughness between patches

void count_inliers(const WallSurface& surface, double thresh_m, PlaneFit* fit) {
  const TangentPoints& points = surface.points->at;
  const PlaneOver over = surface.over();
  const double foreshortening = over.foreshortening();
  double squares = 0.0, measured = 0.0, voxels = 0.0;
  for (std::uint32_t k = 0; k < points.count; ++k) {
    const double r = points.distance(k, over, foreshortening);
    if (!(r >= -thresh_m && r <= thresh_m)) continue;
    squares += r * r;
    voxels += 1.0;
    measured += static_cast<double>(points.weight[k]);
  }
  fit->inliers = static_cast<std::uint32_t>(measured * surface.points->measured_per_weight);
  fit->rms_m = voxels > 0.0 ? std::sqrt(squares / voxels) : 0.0;
}

// Turning the plane by its slope along u turns the yaw by as much; the sign follows from which way u points.
void set_yaw(const WallScene& scene, const WallSurface& surface, WallResult* out) {
  const PatchFit& patch = surface.patch;
  const TangentFrame& f = surface.frame();
  const Eigen::Vector3d turned = Eigen::Vector3d::UnitZ().cross(out->fit.plane.n);
  const double sign = turned.dot(f.u) > 0.0 ? 1.0 : -1.0;
  out->yaw_rad = yaw_of(out->along_level, scene.forward_level);
  const double upright = std::sqrt(turned.squaredNorm());  // a leaning plane turns more about the vertical
  out->yaw_sigma_rad = std::sqrt(patch.covariance(1, 1)) / upright;
  const bool rock = patch.tau_m >= kRockFrom_m;
  out->yaw_sigma_rad *= surface.strips != nullptr ? kStripsStretch : (rock ? kRockStretch : 1.0);
  out->yaw_bias_rad_per_m = -sign * patch.bias_response[1] / upright;
  out->yaw_bound_rad = std::fabs(patch.bend_slope_u_at(0.0, 0.0));
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_BEND, out->yaw_bound_rad,
                             kBendMatters * radians(scene.settings.alert_limit_angle_deg),
                             !(out->yaw_bound_rad > kBendMatters * radians(scene.settings.alert_limit_angle_deg))));
  if (out->yaw_bound_rad > kBendMatters * radians(scene.settings.alert_limit_angle_deg)) {
    out->fit.reasons |= POSE_WALL_R_CURVED;
  }
}

// Where the wall was cut off below or above a sampling point, the plane is prolonged to it; this is how far the surface
// seen a little below that height or a little above it lies from the plane, whichever is further: it bends.
double offset_at_height(const WallScene& scene, const Plane& plane, double z_level_m) {
  constexpr double kWindow_m = 0.3;
  constexpr double kGate_m = 0.4;
  constexpr double kPointsMin = 10.0;
  double sum[2] = {}, count[2] = {};
  for (std::uint32_t i = 0; i < scene.band_level.count; ++i) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = plane.signed_distance(p), above_m = p.z() - z_level_m;
    if (!(std::fabs(above_m) <= kWindow_m) || !(std::fabs(r) <= kGate_m)) continue;
    sum[above_m > 0.0 ? 1 : 0] += std::fabs(r);
    count[above_m > 0.0 ? 1 : 0] += 1.0;
  }
  double offset_m = -1.0;
  for (int half = 0; half < 2; ++half) {
    if (count[half] >= kPointsMin) offset_m = larger(offset_m, sum[half] / count[half]);
  }
  return offset_m >= 0.0 ? offset_m : kGate_m;
}

// Whether the wall is one plane at this height. Next to where it was cut off it begins to bend.
bool clear_of_cuts(const WallScene& scene, const Heights& heights, double z_level_m) {
  constexpr double kBegins_m = 0.25;
  const bool top_is_cut = heights.max_m < scene.z_max_level_m;
  const bool foot_is_cut = heights.min_m > scene.z_min_level_m;
  return z_level_m <= heights.max_m - (top_is_cut ? kBegins_m : 0.0) &&
         z_level_m >= heights.min_m + (foot_is_cut ? kBegins_m : 0.0);
}

#ifdef POSE_WALL_TRACE
void note_sample(int quantity, double gap_m, const AtSample& seen) {
  const auto subject = static_cast<std::uint32_t>(POSE_WALL_TRACE_QUANTITY + quantity);
  trace::gate_of(subject, POSE_WALL_TRACE_SAMPLE_GAP, gap_m, kExtrapolated_m, !(gap_m > kExtrapolated_m));
  trace::gate_of(subject, POSE_WALL_TRACE_SAMPLE_STEP, seen.bound_m, 0.0, !seen.interrupted);
}
#endif

void set_distances(const WallScene& scene, const WallSurface& surface, int side, const WallGrid& grid,
                   WallResult* out) {
  const TangentFrame& f = surface.frame();
  const PatchFit& patch = surface.patch;
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d& sample = scene.sample_level_m[side][end];
    const double u = f.u.dot(sample - f.origin), v = f.v.dot(sample - f.origin);
    const double bias = patch.bias_response[0] + patch.bias_response[1] * u + patch.bias_response[2] * v;
    out->distance_m[end] = distance_at(out->fit.plane, sample);
    out->distance_sigma_m[end] = std::sqrt(patch.variance_at(u, v));
    double& bound = out->distance_bound_m[end];
    const double bend = std::fabs(patch.bend_at(u, v));
    POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_SAMPLE_BEND, bend, kBendMatters * scene.settings.alert_limit_distance,
                               !(bend > kBendMatters * scene.settings.alert_limit_distance)));
    if (bend > kBendMatters * scene.settings.alert_limit_distance) out->fit.reasons |= POSE_WALL_R_CURVED;
    bound = scene.settings.range_bias_max * std::fabs(bias) + bend;
    const bool in_band = scene.in_band(sample.z());
    if (in_band && !clear_of_cuts(scene, surface.heights, sample.z())) {
      bound += offset_at_height(scene, out->fit.plane, sample.z());
    }
    const double along_m = out->along_level.dot(sample);
    const AtSample seen = look_at_sample(scene, surface, grid, *out, sample, out->distance_m[end]);
    out->extrapolated[end] = seen.interrupted || grid.gap_to_solid_m(along_m) > kExtrapolated_m;
    POSE_WALL_NOTE(note_sample(POSE_WALL_D_LF + 2 * side + end, grid.gap_to_solid_m(along_m), seen));
    bound += seen.bound_m;
  }
}

}  // namespace

WallResult measure_wall(const WallScene& scene, const WallSurface& surface, int side, const WallGrid& grid) {
  WallResult out;
  const PatchFit& patch = surface.patch;
  POSE_WALL_NOTE(trace::gate(POSE_WALL_TRACE_WALL_FIT, patch.solved));
  if (!patch.solved) {
    out.fit.refused = true;
    out.fit.reasons = POSE_WALL_R_WALL_SHORT;
    return out;
  }
  out.fit.found = true;
  out.fit.plane = surface.plane();
  out.along_level = along_of(out.fit.plane, scene.forward_level);
  out.lean_rad = lean_of(out.fit.plane);
  out.dof = patch.dof;
  out.dof_slope = patch.dof_slope;
  out.layer_sigma_m = surface.layer_sigma_m;
  count_inliers(surface, scene.settings.wall_ransac_thresh, &out.fit);
  set_yaw(scene, surface, &out);
  // Where offset and slope are uncorrelated.
  out.pivot_level_m = surface.frame().origin - surface.frame().u * (patch.covariance(0, 1) / patch.covariance(1, 1));
  set_distances(scene, surface, side, grid, &out);
  return out;
}

}  // namespace pose_wall

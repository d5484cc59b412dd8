// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/sample/measure.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/math/finite.hpp"
#include "engine/gates/gate.hpp"
#include "engine/walls/sample/at_sample.hpp"

namespace pose_wall {
namespace {

// With strips yaw errs more than its covariance: the plane chooses the strips that then determine it. Measured on
// simulated looks by four sensors: 1.8 to 2.1 times, with heavier tails than a normal one (2026-11-26). Without it the
// mean z² of yaw is 3.1 in the scenes steel_sets and nominal (2026-11-27). The offset has standard deviations of its
// own for that.
constexpr double kStripsStretch = 2.5;

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

// A turn of the plane by its slope along u turns yaw by as much. The sign follows from the direction of u.
void set_yaw(const WallScene& scene, const WallSurface& surface, FittedWall* out) {
  const PatchFit& patch = surface.patch;
  const TangentFrame& f = surface.frame();
  const Eigen::Vector3d turned = Eigen::Vector3d::UnitZ().cross(out->fit.plane.n);
  const double sign = turned.dot(f.u) > 0.0 ? 1.0 : -1.0;
  out->yaw_rad = yaw_of(out->along_level, scene.forward_level);
  const double upright = std::sqrt(turned.squaredNorm());  // a leaning plane turns more about the vertical
  out->yaw_per_slope = (surface.strips != nullptr ? kStripsStretch : 1.0) / upright;
  out->yaw_bias_rad_per_m = -sign * patch.bias_response[1] / upright;
  const double bend_rad = std::fabs(patch.bend_slope_u_at(0.0, 0.0));
  out->yaw_bound_rad[POSE_WALL_PART_BEND] = bend_rad;
  demand<gate::WALL_BEND>(&out->fit, bend_rad, scene.settings);
}

// Largest distance of the surface from the plane, seen a little below or above a height, ahead or behind.
double offset_at_height(const WallScene& scene, const Plane& plane, const Eigen::Vector3d& along, double z_level_m) {
  constexpr double kWindow_m = 0.3;    // above and below, a row of the grid; swept: half 1 lost 1 won, twice 8 lost
  constexpr double kGate_m = 0.4;      // so near, an arch is no further off its plane; swept: half 8 won, twice 1 lost
  constexpr double kPointsMin = 10.0;  // ten points make a mean; swept: half nothing, twice 1 won
  double sum[4] = {}, count[4] = {};
  for (const BoundedPoints* const points : {&scene.band_level, &scene.beyond_level}) {
    for_each_in(*points, Slab(plane, kGate_m), [&](std::uint32_t i, float r) {
      const double above_m = static_cast<double>(points->z[i]) - z_level_m;
      if (!(std::fabs(above_m) <= kWindow_m)) return;
      const bool ahead = along.dot(points->at(i)) > 0.0;
      const int part = (above_m > 0.0 ? 1 : 0) + (ahead ? 2 : 0);
      sum[part] += static_cast<double>(r);
      count[part] += 1.0;
    });
  }
  double offset_m = -1.0;
  for (int part = 0; part < 4; ++part) {
    if (count[part] >= kPointsMin) offset_m = larger(offset_m, std::fabs(sum[part] / count[part]));
  }
  return offset_m >= 0.0 ? offset_m : kGate_m;
}

// True if the curvature of the whole wall is so many standard deviations, or not known.
bool may_bend(const PatchFit& patch, double in_sigmas) {
  return !(patch.curvature_v_sigma > 0.0 && std::fabs(patch.curvature_v) <= in_sigmas * patch.curvature_v_sigma);
}

// How far the wall leaves its plane at this height, in ways that its roughness does not cover: where it was cut off,
// and where the plane is prolonged above the band. Else a bend must show twice: in the curvature of the whole, and
// where the surface is seen further off than rock scatters. Things before a wall are seen off it, too, and some rock
// looks bent.
double leaves_plane_by(const WallScene& scene, const WallSurface& surface, const FittedWall& wall, double z_level_m) {
  // Suspected; kCurvatureInSigmas, which cuts, is sure; swept: half 6 lost, twice 6 won.
  constexpr double kMayBendInSigmas = 2.0;
  constexpr double kPerRoughness = 3.0;  // standard deviations of one patch; the offset is a mean of many
  const Heights& heights = surface.heights;
  const bool is_prolonged =
      heights.max_m < scene.z_max_level_m || heights.min_m > scene.z_min_level_m || z_level_m > scene.z_max_level_m;
  if (z_level_m < scene.z_min_level_m || !(is_prolonged || may_bend(surface.patch, kMayBendInSigmas))) return 0.0;
  const double offset_m = offset_at_height(scene, wall.fit.plane, wall.along_level, z_level_m);
  return is_prolonged || offset_m > kPerRoughness * surface.patch.tau_m ? offset_m : 0.0;
}

#ifdef POSE_WALL_TRACE
std::uint32_t quantity_subject(int side, int end) {
  return static_cast<std::uint32_t>(POSE_WALL_TRACE_QUANTITY) + POSE_WALL_D_LF +
         static_cast<std::uint32_t>(2 * side + end);
}
#endif

void set_distances(const WallScene& scene, const WallSurface& surface, int side, const WallGrid& grid,
                   FittedWall* out) {
  const TangentFrame& f = surface.frame();
  const PatchFit& patch = surface.patch;
  const Settings& s = scene.settings;
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d& sample = scene.sample_level_m[side][end];
    const double u = f.u.dot(sample - f.origin), v = f.v.dot(sample - f.origin);
    const double bias = patch.bias_response[0] + patch.bias_response[1] * u + patch.bias_response[2] * v;
    out->distance_m[end] = distance_at(out->fit.plane, sample);
    out->at_sample[end] = {1.0, u, v};
    const double bend = std::fabs(patch.bend_at(u, v));
    POSE_WALL_NOTE(const trace::About about(quantity_subject(side, end)));
    const double offset_m = leaves_plane_by(scene, surface, *out, sample.z());
    const AtSample seen = look_at_sample(scene, surface, grid, *out, sample);
    const bool unseen = !passes<gate::SAMPLE_HOLE>(seen.hole_m, s);
    // A distance has no sign: a point in the rock has that of one before it.
    const bool in_rock = out->fit.plane.signed_distance(sample) < 0.0;
    const bool interrupted = !passes<gate::SAMPLE_STEP>(seen.bound_m, s);
    out->extrapolated[end] = interrupted || unseen || in_rock;
    ProtectionParts& bound = out->distance_bound_m[end];
    bound[POSE_WALL_PART_RANGE_BIAS] = s.range_bias_max * std::fabs(bias);
    bound[POSE_WALL_PART_BEND] = bend + offset_m;
    bound[POSE_WALL_PART_EXTRAPOLATION] =
        seen.bound_m + (unseen ? kMayStep_m : 0.0) + (in_rock ? 2.0 * out->distance_m[end] : 0.0);
  }
}

void set_sigmas_of_one(const PatchErrors& errors, double sigmas, FittedWall* wall) {
  const Spread slope = errors.spread_of(Eigen::Vector3d::UnitY(), sigmas);
  wall->yaw_sigma_rad = wall->yaw_per_slope * std::sqrt(slope.variance);
  wall->yaw_dof = slope.dof;
  for (int end = 0; end < 2; ++end) {
    const Spread at = errors.spread_of(wall->at_sample[end], sigmas);
    wall->distance_sigma_m[end] = std::sqrt(at.variance);
    wall->distance_dof[end] = at.dof;
  }
  // The place where offset and slope are uncorrelated.
  wall->covariance = errors.covariance();
  wall->pivot_level_m = wall->frame.origin - wall->frame.u * (wall->covariance(0, 1) / slope.variance);
}

}  // namespace

FittedWall measure_wall(const WallScene& scene, const WallSurface& surface, int side, const WallGrid& grid,
                        PatchErrors* errors) {
  FittedWall out;
  const PatchFit& patch = surface.patch;
  out.grooved = surface.grooved;
  if (!demand<gate::WALL_FIT>(&out.fit, patch.solved)) return out;
  out.fit.found = true;
  out.fit.plane = surface.plane();
  out.along_level = along_of(out.fit.plane, scene.forward_level);
  out.lean_rad = lean_of(out.fit.plane);
  out.layer_sigma_m = surface.layer_sigma_m;
  count_inliers(surface, scene.settings.wall_ransac_thresh, &out.fit);
  set_yaw(scene, surface, &out);
  out.frame = surface.frame();
  out.bias_response = patch.bias_response;
  set_distances(scene, surface, side, grid, &out);
  // Two thirds of straight walls (arch, seed 185); swept: half 4 lost, twice 47 moved.
  constexpr double kStraightInSigmas = 1.0;
  out.straight = !may_bend(patch, kStraightInSigmas);
  *errors = patch.errors;
  return out;
}

void set_sigmas(const PatchErrors (&errors)[2], double sigmas, JudgedWall (*walls)[2]) {
  const bool both = !(*walls)[0].fit.refused && !(*walls)[1].fit.refused;
  for (int side = 0; side < 2; ++side) {
    JudgedWall& wall = (*walls)[side];
    if (!wall.fit.found) continue;
    PatchErrors own = errors[side];
    // A wall that may bend looks as if it had long waves, and other rock knows nothing of that. A thing that may be no
    // wall shows no rock.
    if (both && wall.straight && !(*walls)[1 - side].may_be_no_wall)
      own.layer[0].weigh(errors[1 - side].layer[0].evidence);
    set_sigmas_of_one(own, sigmas, &wall);
  }
}

}  // namespace pose_wall

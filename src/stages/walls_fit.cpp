// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_fit.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "estimation/irls.hpp"
#include "estimation/tangent_frame.hpp"
#include "estimation/tukey.hpp"
#include "math/elementary.hpp"

namespace pose_wall {
namespace {

constexpr double kScaleMin_m = 0.003;
constexpr double kFirstGateInThresholds = 5.0;  // wide enough to see the lean of a wall cut by a vertical hypothesis
constexpr double kGateInThresholds = 4.0;
constexpr double kScaleMaxInThresholds = 1.5;  // rough rock: the scale follows the rock
constexpr double kPatch_m = 0.5;
constexpr double kExtrapolated_m = 0.75;
constexpr int kQuickRounds = 3;
constexpr int kRounds = 8;

template <typename Allowed>
Span<const std::uint32_t> gather(const PointSet& points, const Plane& plane, double gate_m, Span<std::uint32_t> out,
                                 const Allowed& allowed) {
  const float nx = static_cast<float>(plane.n.x()), ny = static_cast<float>(plane.n.y());
  const float nz = static_cast<float>(plane.n.z()), d = static_cast<float>(plane.d);
  const float gate = static_cast<float>(gate_m);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < points.count; ++i) {
    const float r = nx * points.x[i] + ny * points.y[i] + nz * points.z[i] + d;
    if (r >= -gate && r <= gate && allowed(i)) out[count++] = i;
  }
  return Span<const std::uint32_t>(out.data(), count);
}

void fill_patches(const WallScene& scene, Span<const std::uint32_t> chosen, const IrlsResult& irls,
                  const TangentFrame& f, PatchGrid* patches) {
  double u_min = 0.0, u_max = 0.0, v_min = 0.0, v_max = 0.0;
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d q = scene.band_level.at(i) - f.origin;
    const double u = f.u.dot(q), v = f.v.dot(q);
    u_min = u < u_min ? u : u_min;
    u_max = u > u_max ? u : u_max;
    v_min = v < v_min ? v : v_min;
    v_max = v > v_max ? v : v_max;
  }
  patches->begin(u_min, u_max, v_min, v_max, kPatch_m);
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = irls.plane.signed_distance(p);
    const double w = tukey_weight(r, irls.scale_m) * static_cast<double>(scene.band_level.weight[i]);
    if (!(w > 0.0)) continue;
    const Eigen::Vector3d ray = (p - scene.sensor_level_m).normalized();
    const Eigen::Vector3d q = p - f.origin;
    patches->add(f.u.dot(q), f.v.dot(q), r, w, ray.dot(irls.plane.n));
  }
}

void count_inliers(const WallScene& scene, Span<const std::uint32_t> chosen, PlaneFit* fit) {
  const double thresh_m = scene.settings.wall_ransac_thresh;
  double squares = 0.0, measured = 0.0, voxels = 0.0;
  for (const std::uint32_t i : chosen) {
    const double r = fit->plane.signed_distance(scene.band_level.at(i));
    if (!(r >= -thresh_m && r <= thresh_m)) continue;
    squares += r * r;
    voxels += 1.0;
    measured += static_cast<double>(scene.band_level.weight[i]);
  }
  fit->inliers = static_cast<std::uint32_t>(measured);
  fit->rms_m = voxels > 0.0 ? std::sqrt(squares / voxels) : 0.0;
}

// Turning the plane by its slope along u turns the yaw by as much; the sign follows from which way u points.
void set_yaw(const WallScene& scene, const PatchFit& patch, const TangentFrame& f, WallResult* out) {
  const Eigen::Vector3d turned = Eigen::Vector3d::UnitZ().cross(out->fit.plane.n);
  const double sign = turned.dot(f.u) > 0.0 ? 1.0 : -1.0;
  out->yaw_rad = yaw_of(out->along_level, scene.forward_level);
  out->yaw_sigma_rad = std::sqrt(patch.covariance(1, 1));
  out->yaw_bias_rad_per_m = -sign * patch.bias_response[1];
  out->yaw_bound_rad = std::fabs(patch.bend_slope_u_at(0.0, 0.0));
}

void set_distances(const WallScene& scene, int side, const PatchFit& patch, const TangentFrame& f, const WallGrid& grid,
                   WallResult* out) {
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d& sample = scene.sample_level_m[side][end];
    const double u = f.u.dot(sample - f.origin), v = f.v.dot(sample - f.origin);
    const double bias = patch.bias_response[0] + patch.bias_response[1] * u + patch.bias_response[2] * v;
    out->distance_m[end] = distance_at(out->fit.plane, sample);
    out->distance_sigma_m[end] = std::sqrt(patch.variance_at(u, v));
    out->distance_bound_m[end] = scene.settings.range_bias_max * std::fabs(bias) + std::fabs(patch.bend_at(u, v));
    out->extrapolated[end] = grid.gap_to_solid_m(out->along_level.dot(sample)) > kExtrapolated_m;
  }
}

}  // namespace

void WallFitScratch::lay_out(Arena& arena, std::uint32_t points_max) {
  chosen = arena.take<std::uint32_t>(points_max);
  residuals = arena.take<float>(points_max);
  patches.lay_out(arena);
}

Eigen::Vector3d along_of(const Plane& wall, const Eigen::Vector3d& forward_level) {
  const Eigen::Vector3d along = Eigen::Vector3d(-wall.n.y(), wall.n.x(), 0.0).normalized();
  return along.dot(forward_level) >= 0.0 ? along : Eigen::Vector3d(-along);
}

double yaw_of(const Eigen::Vector3d& along_level, const Eigen::Vector3d& forward_level) {
  const double cross = forward_level.x() * along_level.y() - forward_level.y() * along_level.x();
  return arc_tangent2(cross, forward_level.dot(along_level));
}

double lean_of(const Plane& wall) {
  return arc_tangent2(wall.n.z(), std::sqrt(wall.n.x() * wall.n.x() + wall.n.y() * wall.n.y()));
}

double distance_at(const Plane& wall, const Eigen::Vector3d& sample_level_m) {
  return std::fabs(wall.signed_distance(sample_level_m));
}

bool refine_hypothesis(const WallScene& scene, const SideView& view, WallFitScratch* scratch, Plane* plane) {
  const double thresh_m = scene.settings.wall_ransac_thresh;
  for (const double gate : {kFirstGateInThresholds * thresh_m, 3.0 * thresh_m}) {
    const Span<const std::uint32_t> near =
        gather(scene.band_level, *plane, gate, scratch->chosen, [](std::uint32_t) { return true; });
    const IrlsSettings quick{3.0 * thresh_m, kScaleMin_m, thresh_m, kQuickRounds};
    const IrlsResult refined = irls_tukey(scene.band_level, near, *plane, view.along_level, quick, scratch->residuals);
    if (!refined.solved) return false;
    *plane = refined.plane;
  }
  return true;
}

WallResult fit_wall(const WallScene& scene, const Plane& start, int side, const WallGrid& grid,
                    WallFitScratch* scratch) {
  WallResult out;
  const double thresh_m = scene.settings.wall_ransac_thresh;
  const Eigen::Vector3d along = along_of(start, scene.forward_level);
  // Only where the plane is solid: points that lie on it by chance, in a crosscut or on a pipe's line, stay out.
  const Span<const std::uint32_t> chosen =
      gather(scene.band_level, start, kGateInThresholds * thresh_m, scratch->chosen, [&](std::uint32_t i) {
        const Eigen::Vector3d p = scene.band_level.at(i);
        return grid.solid_at(along.dot(p), p.z());
      });
  const IrlsSettings settings{kGateInThresholds * thresh_m, kScaleMin_m, kScaleMaxInThresholds * thresh_m, kRounds};
  const IrlsResult irls = irls_tukey(scene.band_level, chosen, start, along, settings, scratch->residuals);
  const TangentFrame frame = tangent_frame(irls.plane, Eigen::Vector3d::Zero(), along);
  if (irls.solved) fill_patches(scene, chosen, irls, frame, &scratch->patches);
  const PatchFit patch = irls.solved ? scratch->patches.fit() : PatchFit{};
  if (!patch.solved) {
    out.fit.refused = true;
    out.fit.reasons = POSE_WALL_R_WALL_SHORT;
    return out;
  }
  out.fit.found = true;
  out.fit.plane = corrected(irls.plane, frame, patch.correction);
  out.along_level = along_of(out.fit.plane, scene.forward_level);
  out.lean_rad = lean_of(out.fit.plane);
  out.dof = patch.dof;
  if (patch.bends) out.fit.reasons |= POSE_WALL_R_CURVED;
  count_inliers(scene, chosen, &out.fit);
  set_yaw(scene, patch, frame, &out);
  // Where offset and slope are uncorrelated.
  out.pivot_level_m = frame.origin - frame.u * (patch.covariance(0, 1) / patch.covariance(1, 1));
  set_distances(scene, side, patch, frame, grid, &out);
  return out;
}

}  // namespace pose_wall

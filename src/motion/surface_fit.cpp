// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/surface_fit.hpp"

#include <cmath>

#include "base/math/finite.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall::motion {
namespace {

// Standard deviation of a range, typical of LiDARs in mines (OS1 1 to 3 cm, VLP-16 3 cm typical accuracy). It sets only
// the weights of near against far surfaces. Covariances come from the differences between patches of rock.
constexpr float kRangeSigma_m = 0.012F;
// The rock's error within cells, independent of the range.
constexpr float kCellSigma_m = 0.004F;
// Rock about a plane where its relief is not known yet.
constexpr float kRockSigma_m = 0.04F;

// The distance of the point from the rock, and its expectation from noise alone, for a fit that holds surface and
// incidence.
void measure(Fit* fit, bool by_plane = false) {
  Relief relief;
  fit->has_relief = !by_plane && ReliefMap::relief(fit->surface, &relief);
  const float above_rock_m = fit->surface.above_m - (fit->has_relief ? relief.height_m : 0.0F);
  fit->distance_m = above_rock_m * fit->surface.tile->cosine;
  fit->variance_m2 = kRangeSigma_m * kRangeSigma_m * fit->incidence2 * (fit->has_relief ? relief.spread : 1.0F) +
                     kCellSigma_m * kCellSigma_m + (fit->has_relief ? 0.0F : kRockSigma_m * kRockSigma_m);
}

// Of a point that left its tile. Begins at the tile where the one before lay.
bool fit_beyond(const Scan& scan, const Eigen::Vector3f& p, bool by_plane, Fit* fit, float* misfit) {
  Surface surface;
  if (!scan.map->find_again(p, fit->surface.tile, &surface)) return false;
  fit->surface = surface;
  measure(fit);
  *misfit = fit->distance_m / std::sqrt(fit->variance_m2);
  return fit->has_relief || by_plane;
}

}  // namespace

bool fit_observation(const Scan& scan, const LocalPose& pose, const Observation& o, Fit* fit, bool by_plane) {
  const Eigen::Vector3f base(o.x, o.y, o.z);
  fit->p = pose(base);
  if (!scan.map->find(fit->p, o.facing, &fit->surface)) return false;
  fit->normal = fit->surface.tile->normal();
  const Eigen::Vector3f ray = base - scan.sensor_base_m;
  const float towards = (pose.R * ray).dot(fit->normal);
  fit->incidence2 = towards * towards / ray.squaredNorm();
  measure(fit, by_plane);
  return true;
}

std::uint32_t fit_shifted(const Scan& scan, const Fit& fit, const Shifts& shifts, bool by_plane, std::uint32_t apart,
                          float* misfit) {
  const Tile& tile = *fit.surface.tile;
  const float by_u = shifts.axis[kU[tile.facing]], by_v = shifts.axis[kV[tile.facing]];
  const float by_above = shifts.axis[tile.facing] - tile.slope_u * by_u - tile.slope_v * by_v;
  const FourFloats ray_variance = all_four(kRangeSigma_m * kRangeSigma_m * fit.incidence2);
  Fit beyond = fit;
  std::uint32_t known = 0;
  for (std::uint32_t k = 0; k < shifts.count; k += kFour) {
    const float first = static_cast<float>(k);
    const FourFloats shift = (FourFloats{0.0F, 1.0F, 2.0F, 3.0F} + first) * shifts.step_m + shifts.first_m;
    const FourSurfaces at = {&tile, fit.surface.u + shift * by_u, fit.surface.v + shift * by_v,
                             fit.surface.above_m + shift * by_above};
    const FourTruths inside = (magnitude_of(at.u) <= 0.5F) & (magnitude_of(at.v) <= 0.5F);
    const FourTruths on = inside & (magnitude_of(at.above_m) < kLayer_m);
    FourReliefs relief;
    const FourTruths has_relief = on & ReliefMap::relief(at, &relief);
    const FourFloats zero = all_four(0.0F);
    const FourFloats distance = (at.above_m - (has_relief ? relief.height_m : zero)) * tile.cosine;
    const FourFloats variance = ray_variance * (has_relief ? relief.spread : all_four(1.0F)) +
                                kCellSigma_m * kCellSigma_m +
                                (has_relief ? zero : all_four(kRockSigma_m * kRockSigma_m));
    const FourFloats misfits = distance / root_of(variance);
    for (std::uint32_t lane = 0; lane < kFour && k + lane < shifts.count; ++lane) {
      bool is_known = has_relief[lane] != 0 || (by_plane && on[lane] != 0);
      float found = misfits[lane];
      if (inside[lane] == 0) {
        is_known = fit_beyond(scan, fit.p + shift[lane] * shifts.axis, by_plane, &beyond, &found);
      }
      misfit[(k + lane) * apart] = is_known ? found : static_cast<float>(not_a_number());
      known += is_known ? 1U : 0U;
    }
  }
  return known;
}

}  // namespace pose_wall::motion

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/irls.hpp"

#include <cmath>

#include "base/containers/work.hpp"
#include "base/estimation/normal_equations.hpp"
#include "base/estimation/robust_scale.hpp"
#include "base/estimation/tukey.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {
namespace {

// A voxel right in front of the sensor stands for hundreds of points, but the rock under it is one piece; a larger cap
// gives the near rock more say, a smaller one wastes ranges that average out.
constexpr float kWeightCap = 8.0F;  // swept: half 5 lost 7 won, twice 1 won
// Least standard deviation of the points across their longer side: below it a slope is unknown. The default voxel's
// edge.
constexpr double kSpreadMin_m = 0.05;  // swept: half and twice change nothing

// The plane and the weights of a round, as floats.
struct Round {
  float offset, slope_u, slope_v, foreshortening, gate, per_cutoff;
};

std::uint32_t points_with_weight(const TangentPoints& p, std::uint32_t count) {
  FourInts with{};  // true is -1
  for_each_four(count,
                [&](std::uint32_t k, FourTruths counts) { with -= counts & (load_four(&p.weight[k]) > FourFloats{}); });
  return sum_of_lanes(with);
}

// Of lists that are thinned, one of so many is taken, an odd number: neighbours may lie in two layers by turns, and an
// even stride would take but one of them. Here it is one of so many fours.
double scale_of(const TangentPoints& p, std::uint32_t count, std::uint32_t stride, const Round& round, double gate_m) {
  ScaleHistogram histogram(gate_m);
  for (std::uint32_t k = 0; k < count; k += stride * kFour) {
    const FourFloats over =
        load_four(&p.r[k]) - round.offset - round.slope_u * load_four(&p.u[k]) - round.slope_v * load_four(&p.v[k]);
    histogram.add(over * round.foreshortening, first_of_four(count - k) & (load_four(&p.weight[k]) > FourFloats{}));
  }
  return histogram.scale_m();
}

// Weighted sums of four points at a time, each lane for itself.
struct LaneSums {
  FourFloats w{}, wu{}, wv{}, wuu{}, wuv{}, wvv{}, wr{}, wur{}, wvr{};

  void add(FourFloats u, FourFloats v, FourFloats over, FourFloats stands_for, const Round& round) {
    const FourFloats r = (over - round.offset - round.slope_u * u - round.slope_v * v) * round.foreshortening;
    const FourFloats x = r * round.per_cutoff, none{};
    const FourFloats left = 1.0F - x * x;
    const FourFloats tukey = magnitude_of(r) <= round.gate ? (left > none ? left : none) : none;
    const FourFloats weight = tukey * tukey * smaller_of(stands_for, all_four(kWeightCap));
    const FourFloats weight_u = weight * u, weight_v = weight * v;
    w += weight;
    wu += weight_u;
    wv += weight_v;
    wuu += weight_u * u;
    wuv += weight_u * v;
    wvv += weight_v * v;
    wr += weight * r;
    wur += weight_u * r;
    wvr += weight_v * r;
  }

  NormalEquations equations() const {
    return NormalEquations(sum_of_lanes(w), sum_of_lanes(wu), sum_of_lanes(wv), sum_of_lanes(wuu), sum_of_lanes(wuv),
                           sum_of_lanes(wvv), sum_of_lanes(wr), sum_of_lanes(wur), sum_of_lanes(wvr));
  }
};

NormalEquations equations_of(const TangentPoints& p, std::uint32_t count, const Round& round) {
  LaneSums sums;
  std::uint32_t k = 0;
  for (; k + kFour <= count; k += kFour) {
    sums.add(load_four(&p.u[k]), load_four(&p.v[k]), load_four(&p.r[k]), load_four(&p.weight[k]), round);
  }
  if (k < count) {
    const FourTruths counts = first_of_four(count - k);
    const auto some = [&](const Span<float>& row) { return counts ? load_four(&row[k]) : FourFloats{}; };
    sums.add(some(p.u), some(p.v), some(p.r), some(p.weight), round);
  }
  return sums.equations();
}

}  // namespace

IrlsOver irls_tukey(const TangentPoints& points, std::uint32_t count, const PlaneOver& start,
                    const IrlsSettings& settings) {
  IrlsOver result;
  result.over = start;
  const std::uint32_t stride = (points_with_weight(points, count) / settings.scale_points + 1) | 1U;
  for (int i = 0; i < settings.rounds; ++i) {
    Round round{static_cast<float>(result.over.offset_m), static_cast<float>(result.over.slope_u),
                static_cast<float>(result.over.slope_v),  static_cast<float>(result.over.foreshortening()),
                static_cast<float>(settings.gate_m),      0.0F};
    double scale = scale_of(points, count, stride, round, settings.gate_m);
    if (scale < settings.scale_min_m) scale = settings.scale_min_m;
    if (scale > settings.scale_max_m) scale = settings.scale_max_m;
    result.scale_m = scale;
    result.work += count * steps::kPointRound;
    round.per_cutoff = static_cast<float>(1.0 / (kTukeyCutoff * scale));
    Eigen::Vector3d correction;
    result.solved = equations_of(points, count, round).solve(kSpreadMin_m, &correction);
    if (!result.solved) return result;
    result.over.add(correction);
    if (correction.cwiseAbs().maxCoeff() < settings.stands_still) break;
  }
  return result;
}

IrlsResult irls_tukey(const PointSet& cloud, Span<const std::uint32_t> indices, const Plane& start,
                      const Eigen::Vector3d& u_hint, const IrlsSettings& settings, TangentPoints* points) {
  points->begin(start, Eigen::Vector3d::Zero(), u_hint);
  points->add(cloud, indices);
  const IrlsOver fit = irls_tukey(*points, points->count, PlaneOver{}, settings);
  return {points->plane_of(fit.over), fit.over, fit.scale_m, fit.solved, fit.work};
}

}  // namespace pose_wall

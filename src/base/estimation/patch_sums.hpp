// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Sums over the points of one patch of a surface, as floats: their rounding is far below the accuracy of a patch's
// mean.

#pragma once

#include <cstdint>

#include "base/math/finite.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// Points of almost no weight would still count in the scatter of the points: up to here they are left out.
constexpr float kPatchWeightLeast = 1e-6F;
// A patch's own scatter counts beside this many more points of the scatter that is expected; fewer believe the scatter
// of a few points, more deny patches their own.
constexpr double kPatchPriorPoints = 10.0;  // swept: half 2 lost, twice 1 lost 3 won
// Floor of the noise of one point: no LiDAR repeats better than a millimetre.
constexpr double kPatchNoiseMin_m = 0.001;

struct PatchSums {
  static constexpr double kWeightMin = 1e-9;  // below a single point's least (kPatchWeightLeast)

  FourFloats first{};   // w, wu, wv, wr
  FourFloats second{};  // wrr, wb, and without weights r, rr
  std::uint32_t count = 0;

  void add(const PatchSums& other) {
    first += other.first;
    second += other.second;
    count += other.count;
  }

  double w() const { return static_cast<double>(first[0]); }
  double wu() const { return static_cast<double>(first[1]); }
  double wv() const { return static_cast<double>(first[2]); }
  double wr() const { return static_cast<double>(first[3]); }
  double wrr() const { return static_cast<double>(second[0]); }
  double wb() const { return static_cast<double>(second[1]); }
  double r() const { return static_cast<double>(second[2]); }
  double rr() const { return static_cast<double>(second[3]); }
  double share() const { return wb() / w(); }
  bool has_weight() const { return w() > kWeightMin; }
  // Weighted squares about the mean. Rounding may leave less than nothing; the other cuts that off.
  double scatter() const { return wrr() - wr() * wr() / w(); }
  double scatter_or_none() const { return larger(scatter(), 0.0); }
};

// One point: its place in the plane and its part in the patch.
struct PatchPoint {
  float u_m, v_m;
  PatchSums sums;

  // residual_m: signed distance of a centroid from the plane; weight: points it stands for times its robust weight;
  // bias: change of the residual per metre of range bias (ray direction . normal).
  static PatchPoint of(float u_m, float v_m, float residual_m, float weight, float bias) {
    const FourFloats first = weight * FourFloats{1.0F, u_m, v_m, residual_m};
    return {
        u_m, v_m, {first, FourFloats{first[3] * residual_m, weight * bias, residual_m, residual_m * residual_m}, 1}};
  }
};

// Four points of a surface: where they are, their residuals, and how these answer to a range bias.
struct FourPoints {
  FourFloats u_m, v_m, residual_m, bias;
};

// Sums of one patch's points, lane by lane. Points that do not count have no weight, but must be numbers.
class PatchLanes {
 public:
  void add(const FourPoints& p, FourFloats weights) {
    const FourTruths counts = weights > all_four(kPatchWeightLeast);
    const FourFloats none{}, w = counts ? weights : none, r = counts ? p.residual_m : none;
    w_ += w;
    wu_ += w * p.u_m;
    wv_ += w * p.v_m;
    wr_ += w * r;
    wrr_ += w * r * r;
    wb_ += w * p.bias;
    r_ += r;
    rr_ += r * r;
    count_ -= counts;
  }

  PatchSums total() const {
    return {four_sums_of_lanes(w_, wu_, wv_, wr_), four_sums_of_lanes(wrr_, wb_, r_, rr_), sum_of_lanes(count_)};
  }

 private:
  FourFloats w_{}, wu_{}, wv_{}, wr_{}, wrr_{}, wb_{}, r_{}, rr_{};
  FourInts count_{};
};

}  // namespace pose_wall

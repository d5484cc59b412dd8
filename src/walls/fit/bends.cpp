// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/fit/bends.hpp"

#include <cmath>

namespace pose_wall {
namespace {

constexpr double kCut_m = 0.25;     // judgement, 2026-11-21: rows are cut off by so much at a time
constexpr double kSpanMin_m = 0.5;  // is left; a sensor that looks up by 7 degrees sees half of the band (seed 531)
constexpr double kCurvatureInSigmas = 3.5;  // judgement, 2026-11-21: by chance hardly a wall is cut (0.02 %)
constexpr double kBulgeMin_m = 0.04;  // judgement, 2026-11-21: smaller bulges are inliers (wall_ransac_thresh, 5 cm)

// Weighted sums over the surface's points: their heights and their distances from the plane.
struct Row {
  double w = 0.0, z = 0.0, zz = 0.0, r = 0.0, zr = 0.0;
  void add(const Row& other) {
    w += other.w;
    z += other.z;
    zz += other.zz;
    r += other.r;
    zr += other.zr;
  }
  double slope() const {
    const double spread = w * zz - z * z;
    return spread > 1e-9 * w * w ? (w * zr - z * r) / spread : 0.0;
  }
};

// The surface, row by row between two heights.
class Rows {
 public:
  Rows(const WallSurface& fit, const Heights& heights)
      : min_m_(heights.min_m), row_m_((heights.max_m - heights.min_m) / kRows) {
    const double foreshortening = fit.irls.over.foreshortening();
    for (std::uint32_t k = 0; k < fit.points->at.count; ++k) {
      const double z = fit.points->z_level_m(k);
      if (!heights.contain(z)) continue;
      const double r = fit.points->at.distance(k, fit.irls.over, foreshortening);
      const double w = fit.weight(static_cast<double>(fit.points->at.u[k]), r);
      const int i = static_cast<int>((z - min_m_) / row_m_);
      row_[i < kRows ? i : kRows - 1].add({w, w * z, w * z * z, w * r, w * z * r});
    }
    // A sensor that hardly looks up sees little of the band.
    const double stray = kStrayShare * sum(0, kRows).w;
    while (last_ > first_ && sum(0, first_ + 1).w < stray) ++first_;
    while (last_ > first_ && sum(last_, kRows).w < stray) --last_;
  }

  Heights seen() const { return {min_m_ + first_ * row_m_, min_m_ + (last_ + 1) * row_m_}; }
  // Of the lower and the upper half of what is seen: how the surface leans more than the plane does.
  double lower_slope() const { return sum(first_, middle()).slope(); }
  double upper_slope() const { return sum(middle(), last_ + 1).slope(); }

 private:
  static constexpr int kRows = 32;             // of the band, 7 cm each by default
  static constexpr double kStrayShare = 0.01;  // judgement, 2026-11-22: of the surface: less at an end is stray points

  int middle() const { return (first_ + last_ + 1) / 2; }
  Row sum(int from, int to) const {
    Row out;
    for (int i = from; i < to; ++i) out.add(row_[i]);
    return out;
  }

  Row row_[kRows];
  double min_m_, row_m_;
  int first_ = 0, last_ = kRows - 1;
};

}  // namespace

bool cut_bent_rows(const WallSurface& fit, Heights* heights) {
  if (!(fit.patch.curvature_v > kCurvatureInSigmas * fit.patch.curvature_v_sigma)) return false;
  const Rows rows(fit, *heights);
  const Heights seen = rows.seen();
  const double span_m = seen.max_m - seen.min_m;
  if (span_m - kCut_m < kSpanMin_m || !(fit.patch.curvature_v * span_m * span_m > kBulgeMin_m)) return false;
  // A wall stands more upright than an arch or a heap: the half that leans more loses its end.
  const double lean = lean_of(fit.irls_plane());
  if (std::fabs(lean - rows.upper_slope()) >= std::fabs(lean - rows.lower_slope())) {
    heights->max_m = seen.max_m - kCut_m;
  } else {
    heights->min_m = seen.min_m + kCut_m;
  }
  return true;
}

}  // namespace pose_wall

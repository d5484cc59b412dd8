// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>

namespace pose_wall {

// Weighted least squares of r = a + b u + c v, summed up point by point.
class NormalEquations {
 public:
  NormalEquations() = default;
  // From sums made elsewhere: of w, wu, wv, wuu, wuv, wvv, wr, wur, wvr.
  NormalEquations(double w, double wu, double wv, double wuu, double wuv, double wvv, double wr, double wur, double wvr)
      : w_(w), wu_(wu), wv_(wv), wuu_(wuu), wuv_(wuv), wvv_(wvv), wr_(wr), wur_(wur), wvr_(wvr) {}

  void add(double u, double v, double r, double w) { add_row({1.0, u, v}, r, w); }
  // For a row of the design other than (1, u, v). After it only information() and right_side() are defined.
  void add_row(const Eigen::Vector3d& row, double r, double w) {
    const double w0 = w * row[0], wu = w * row[1], wv = w * row[2];
    w_ += w0 * row[0];
    wu_ += w0 * row[1];
    wv_ += w0 * row[2];
    wuu_ += wu * row[1];
    wuv_ += wu * row[2];
    wvv_ += wv * row[2];
    wr_ += w0 * r;
    wur_ += wu * r;
    wvr_ += wv * r;
  }

  double weight() const { return w_; }

  Eigen::Matrix3d information() const {
    Eigen::Matrix3d m;
    m << w_, wu_, wv_, wu_, wuu_, wuv_, wv_, wuv_, wvv_;
    return m;
  }
  Eigen::Vector3d right_side() const { return {wr_, wur_, wvr_}; }

  // False where the points do not span the plane: their spread across their main direction is below spread_min_m.
  bool solve(double spread_min_m, Eigen::Vector3d* solution) const;
  // Standard deviation of the points across their main direction, metres.
  double smaller_spread_m() const;
  // Unit vector along their main direction. Needs a point.
  Eigen::Vector2d main_direction() const;

 private:
  // The 2 x 2 scatter of the points: its mean and half the difference of its variances, and its covariance.
  struct Scatter {
    double mean, half, uv;
    double radius() const;  // its eigenvalues are mean + radius and mean - radius
  };
  Scatter scatter() const;

  double w_ = 0, wu_ = 0, wv_ = 0, wuu_ = 0, wuv_ = 0, wvv_ = 0, wr_ = 0, wur_ = 0, wvr_ = 0;
};

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A plane through a surface that waves: over decimetres like broken rock or over metres like a trodden floor.
//
// A plane takes much of a long wave into itself, so the residuals look smoother and less correlated than the surface
// is. Their likelihood, given that a plane was taken out, allows for that (REML: Patterson and Thompson 1971). The
// surface is a plane, a Gaussian process with Matern's correlation of smoothness 3/2, a part of each patch's own, and
// the noise of its points. Length and share of the wave are not chosen but averaged over, weighted by likelihood
// (Handcock and Stein 1993). Waves longer than the greatest length are the surface's own slope.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/estimation/panel_cholesky.hpp"
#include "base/estimation/surface_patches.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

struct UnevenFit {
  bool solved = false;
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();  // offset m, slope along u, slope along v
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d bias_response = Eigen::Vector3d::Zero();  // change of the correction per metre of range bias
  double dof = 0.0;  // the variance is known as well as from so many independent pieces
};

class UnevenPlane {
 public:
  void lay_out(Arena& arena);
  UnevenFit fit(Span<const SurfacePatch> patches);

 private:
  struct Model;
  struct Models;

  // Matern's correlation by distance, from a table, since every two patches and length need it. It ends at 16 lengths,
  // where 2e-6 are left. Between its steps of a 64th, linear interpolation errs by 3e-5 at most:
  static constexpr std::uint32_t kMaternSteps = 1024;
  static constexpr double kMaternPerUnit = 64.0;
  void fill_matern();
  FourFloats matern(FourFloats r) const;
  void fill_correlation(Span<const SurfacePatch> patches, double length_m);
  [[gnu::noinline]] void consider(Span<const SurfacePatch> patches, double own_share, double tau2, Models* models);
  bool factor(Span<const SurfacePatch> patches, double own_share, double tau2);
  double whiten(Span<const SurfacePatch> patches, bool correlated, double tau2);
  bool solve(std::uint32_t patches, double log_determinant, Model* model) const;

  Span<float> correlation_;  // in panels of four rows, as the factor's
  PanelCholesky factor_;
  Span<float> right_sides_;
  Span<float> matern_;
  bool matern_filled_ = false;
};

}  // namespace pose_wall

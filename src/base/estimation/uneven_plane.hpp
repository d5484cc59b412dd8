// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A plane through a surface that waves: over decimetres like broken rock or over metres like a trodden floor.
//
// A plane takes much of a long wave into itself, so the residuals look smoother and less correlated than the surface
// is. Their likelihood, given that a plane was taken out, allows for that (REML: Patterson and Thompson 1971). The
// surface is a plane, a Gaussian process with Matern's correlation of smoothness 3/2, a part of each patch's own, and
// the noise of its points. Length and share of the wave are not chosen but averaged over, weighted by likelihood
// (Handcock and Stein 1993). Each patch is predicted from its nearest neighbours instead of from all (Vecchia 1988;
// Datta et al. 2016), so that the work grows with the number of patches and not with its cube. Waves longer than the greatest length are the surface's own slope.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
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

// How an estimator errs that is linear in the patches' residuals, on the surface that the patches show.
struct LinearErrors {
  bool solved = false;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of offset and slopes
  double dof_offset = 0.0, dof_slopes = 0.0;             // the variance is known as well as from so many pieces
};

class UnevenPlane {
 public:
  void lay_out(Arena& arena);
  // The plane that the waves allow best.
  UnevenFit fit(Span<const SurfacePatch> patches);
  // responses: of an estimator's offset and slopes to each patch's residual.
  LinearErrors errors_of(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses);

 private:
  // Each patch is predicted from its nearest ones before it. Judgement, 2026-11-26: a screen of eight on a grid of
  // patches leaves nothing that a ninth would add.
  static constexpr std::uint32_t kNeighbours = 8;
  // Patches before it among which the nearest are looked for: two rows of a floor of 12 m.
  static constexpr std::uint32_t kLookBack = 64;
  static constexpr int kShares = 2;  // models of one length that are computed together
  static constexpr std::uint16_t kNone = 0xFFFF;

  struct Model;
  struct Models;
  struct Whitened;

  // Matern's correlation by distance, from a table, since every two patches and length need it. It ends at 16 lengths,
  // where 2e-6 are left. Between its steps of a 64th, linear interpolation errs by 3e-5 at most:
  static constexpr std::uint32_t kMaternSteps = 1024;
  static constexpr double kMaternPerUnit = 64.0;
  void fill_matern();
  FourFloats matern(FourFloats r) const;

  void find_neighbours(Span<const SurfacePatch> patches);
  Models weighed_models(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses);
  void consider_independent(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses, double tau2,
                            Models* models) const;
  [[gnu::noinline]] void consider_length(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses,
                                         double length_m, double tau2, Models* models);
  Eigen::Matrix3d passed_on(int share, Span<const Eigen::Vector3d> responses);

  Span<std::uint16_t> neighbours_;  // kNeighbours of each patch, the nearest first, kNone behind the last
  // Of each model of a length, for four patches: their share in the prediction, and the variance that it leaves.
  Span<FourFloats> predicts_[kShares], left_[kShares];
  Span<FourFloats> passed_;  // scratch of passed_on()
  Span<float> matern_;
  bool matern_filled_ = false;
};

}  // namespace pose_wall

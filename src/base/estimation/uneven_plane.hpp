// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A plane through a surface that waves: over decimetres like broken rock or over metres like a trodden floor.
//
// A plane takes much of a long wave into itself, so the residuals look smoother and less correlated than the surface
// is. Their likelihood, given that a plane was taken out, allows for that (REML: Patterson and Thompson 1971). The
// surface is a plane, a Gaussian process with Matern's correlation of smoothness 3/2, a part of each patch's own, and
// the noise of its points. The models differ in the waves' length and share (wave_models.hpp). Each patch is predicted
// from its nearest neighbours instead of from all (Vecchia 1988; Datta et al. 2016), so that the work grows with the
// number of patches and not with its cube. Waves longer than the greatest length are the surface's own slope.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/estimation/surface_patches.hpp"
#include "base/estimation/wave_models.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

struct UnevenFit {
  bool solved = false;
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();  // offset m, slope along u, slope along v
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d bias_response = Eigen::Vector3d::Zero();  // change of the correction per metre of range bias
  double dof = 0.0;  // the variance is known as well as from so many independent pieces
};

// The plane of a region, by what is seen of it alone.
struct PredictedPlane : UnevenFit {
  // The same, where the endless plane that the waves ride on is known from elsewhere, and its change by that plane.
  UnevenFit by_endless;
  Eigen::Matrix3d of_endless = Eigen::Matrix3d::Zero();
  // How the waves turn and shift it about the endless plane.
  Eigen::Matrix3d about_endless = Eigen::Matrix3d::Zero();
  // What is missing of the correction where the surface bends by u² or v², in 1 / m: none where all is seen.
  Eigen::Matrix<double, 3, 2> missing_of_bend = Eigen::Matrix<double, 3, 2>::Zero();
};

class UnevenPlane {
 public:
  void lay_out(Arena& arena);
  // The plane that the waves allow best. sigmas: as in spread_of_mixture().
  UnevenFit fit(Span<const SurfacePatch> patches, double sigmas);
  // The plane of a region, which is linear in its heights: what is seen of them, and what the waves predict of the
  // rest. The first patches are seen; of the others u and v count. responses: of offset and slopes to each height.
  // endless: what is known from elsewhere of the plane below all heights, or nothing (not solved).
  PredictedPlane predict(Span<const SurfacePatch> patches, std::uint32_t seen, Span<const Eigen::Vector3d> responses,
                         const UnevenFit& endless, double sigmas);
  // How an estimator errs that is linear in the patches' residuals, on the surface that they show. responses: of its
  // offset and slopes to each residual.
  LinearErrors errors_of(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses);

 private:
  // Each patch is predicted from its nearest ones before it. On simulated rock six and eight give the same levels, four
  // are 10 % wider (2026-11-26).
  static constexpr std::uint32_t kNeighbours = 6;
  // Patches before it among which the nearest are looked for: two rows of a floor of 12 m.
  static constexpr std::uint32_t kLookBack = 64;
  static constexpr std::uint32_t kLengths = 4, kShares = 2;    // the models' lengths and shares of the waves
  static constexpr std::uint32_t kWaves = kLengths * kShares;  // models with waves: each length with each share
  static_assert(kWaveModels == 1 + kWaves, "these, and none");
  static constexpr std::uint32_t kFours = SurfacePatches::kMost / kFour;  // all patches, four at a time
  static_assert(SurfacePatches::kMost % kFour == 0, "the last four are whole");
  static constexpr int kColumns = 5;              // of each patch: 1, u, v, residual, bias
  static constexpr std::uint16_t kNone = 0xFFFF;  // no patch has this number

  struct Model;
  struct Models;
  struct Whitened;
  struct FourPatches;
  struct Neighbourhood;
  // A patch, in floats.
  struct Values {
    float of[kColumns], noise;
  };

  // Matern's correlation by distance, from a table, since every two patches and length need it. It ends at 16 lengths,
  // where 2e-6 are left. Between its steps of a 64th, linear interpolation errs by 3e-5 at most:
  static constexpr std::uint32_t kMaternSteps = 1024;
  static constexpr double kMaternPerUnit = 64.0;
  void fill_matern();
  FourFloats matern(FourFloats r) const;

  void find_neighbours(std::uint32_t patches, std::uint32_t seen);
  bool any_of_four_is_nearer(std::uint32_t i, std::uint32_t first, float m2) const;
  Neighbourhood neighbourhood(std::uint32_t first, std::uint32_t patches) const;
  Models models_of(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses);
  void read(Span<const SurfacePatch> patches);
  void consider_independent(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses, double tau2,
                            Models* models) const;
  struct WaveSums;
  void sum_waves(std::uint32_t patches, std::uint32_t seen, std::uint32_t lengths, double tau2, WaveSums* sums);
  void consider_waves(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses, double tau2,
                      Models* models);
  void pass_on(std::uint32_t first, Span<const Eigen::Vector3d> responses, const std::uint32_t* wave);
  Eigen::Vector3d passed(std::uint32_t i) const;
  double left_of(const std::uint32_t* wave, double tau2, std::uint32_t i) const;
  Eigen::Matrix<double, 3, 2> missing_of_bend(Span<const SurfacePatch> patches, std::uint32_t seen,
                                              Span<const Eigen::Vector3d> responses, const std::uint32_t* wave) const;
  void complete(Span<const SurfacePatch> patches, std::uint32_t seen, Span<const Eigen::Vector3d> responses,
                const std::uint32_t* wave, double tau2, Model* model);
  static void predict(const Neighbourhood& at, const FourFloats (&to_own)[kNeighbours],
                      const FourFloats (&between)[kNeighbours][kNeighbours], float own_share, float tau2,
                      FourTruths seen, FourFloats* predicts, FourFloats* left, Whitened* sums);
  Eigen::Matrix3d passed_on(const std::uint32_t* wave, double tau2, Span<const Eigen::Vector3d> responses);

  Span<Values> values_;
  Span<float> u_m_, v_m_;           // of the patches once more, to compare four at a time
  Span<std::uint16_t> neighbours_;  // kNeighbours of each patch, the nearest first, kNone behind the last
  // Of each model of waves, for four patches: their neighbours' shares in the prediction, and the variance that it
  // leaves.
  Span<FourFloats> predicts_, left_;
  Span<FourFloats> passed_;  // scratch of passed_on()
  Span<float> matern_;
  bool matern_filled_ = false;
};

}  // namespace pose_wall

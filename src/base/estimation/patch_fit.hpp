// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The last step of every plane fit, and the source of a wall's covariance.
//
// Rock is rough over decimetres: the residuals of neighbouring points are one piece of rock, not independent draws, and
// a covariance that counts points is an order of magnitude too small. So points are first averaged over patches of half
// a metre. A patch mean varies for two reasons: the noise of its points, which averages out, and the rock, which does
// not:  var(mean_j) = tau^2 + s_j^2 / W_j.  This is the random-effects model; tau^2 comes from the method of moments
// (DerSimonian and Laird 1986). On a flat wall tau^2 is 0 and the fit weighs by points, near the Cramer-Rao bound. On
// rough rock every patch weighs alike. How the fit errs follows from the waves that the patches show
// (uneven_plane.hpp).

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/estimation/patch_sums.hpp"
#include "base/estimation/uneven_plane.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// How a plane errs. Its patches may come in two layers, each with its own waves.
struct PatchErrors {
  static constexpr std::uint32_t kLayersMax = 2;  // the surface, and the fronts of strips

  LinearErrors layer[kLayersMax];
  std::uint32_t layers = 0;

  // Of at.dot(errors of offset, slope along u, slope along v). sigmas: as in spread_of_mixture().
  Spread spread_of(const Eigen::Vector3d& at, double sigmas) const;
  Eigen::Matrix3d covariance() const;
};

struct PatchFit {
  bool solved = false;
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();     // offset m, slope along u, slope along v
  PatchErrors errors;                                       // of the correction
  Eigen::Vector3d bias_response = Eigen::Vector3d::Zero();  // change of the correction per metre of range bias
  double tau_m = 0.0;                                       // roughness of the surface between patches
  // From a shallow angle the bumps of rough rock are seen and its hollows are not: the surface seen lies about this
  // much before the rock's mean.
  double visibility_m = 0.0;
  std::uint32_t patches = 0;
  std::uint64_t work = 0;
  bool bends = false;  // a quadratic surface fits significantly better
  // Curvature along v (half the second derivative, 1/m) and its standard deviation, whether significant or not.
  double curvature_v = 0.0;
  double curvature_v_sigma = 0.0;
  // Quadratic minus plane, as coefficients of 1, u, v, uu, uv, vv. Zero unless bends.
  Eigen::Matrix<double, 6, 1> bend = Eigen::Matrix<double, 6, 1>::Zero();

  // How far the surface leaves the plane there, by the quadratic.
  double bend_at(double u_m, double v_m) const;
  double bend_slope_u_at(double u_m, double v_m) const;
  double bend_slope_v_at(double u_m, double v_m) const;
};

// Points may come in two layers: the surface, and strips at a constant but unknown step before it. The strips then say
// nothing about the offset, but as much about the slopes as their own straightness allows.
class PatchGrid {
 public:
  // Of floors and walls: longer than most roughness correlates, short enough for many.
  static constexpr double kPatch_m = 0.5;  // swept: half 23 lost 15 won, twice 12 lost 21 won
  // Of all layers: 64 m by 3 m in half metres, twice; an extent beyond gets larger patches. 4096 at first, 2026-11-21.
  static constexpr std::uint32_t kCapacity = 1536;
  static constexpr std::uint32_t kLayersMax = PatchErrors::kLayersMax;  // the surface, and the fronts of strips
  static constexpr std::uint32_t kPatchesMin = 8;  // of the surface: more than the six terms of a quadratic
  // Patches further apart, 2.5 m, count as independent; the test for bends allows for longer correlation, and a longer
  // reach costs pairs.
  static constexpr int kLags = 5;

  void lay_out(Arena& arena);

  // Patches of patch_m, or larger where the extent needs more than there is room for. range_noise_m: standard deviation
  // of one range.
  void begin(double u_min_m, double u_max_m, double v_min_m, double v_max_m, double patch_m, double range_noise_m,
             std::uint32_t layers = 1);
  void add(const PatchPoint& point, std::uint32_t layer = 0);

  // For callers with points in the order of their patches, who read all of them many times. patch_of: the patch of each
  // point, until the next begin(). patches: their number in a layer. set: the sums of every patch, for a fit of as many
  // layers as begun or fewer.
  FourInts patch_of(FourFloats u_m, FourFloats v_m) const;
  std::uint32_t patches() const { return columns_ * rows_; }
  void begin_anew(std::uint32_t layers) { layers_ = layers; }
  void set(std::uint32_t patch, std::uint32_t layer, const PatchLanes& sums);

  // kPlaneOnly: the correction alone, without covariance and test for bends. These are most of the work, and a fit that
  // is only a step to the next one needs neither. kCovariance: all but the bends and the visibility. kBend: the
  // correction and the bends.
  enum class Errors { kMeasured, kCovariance, kBend, kPlaneOnly };
  PatchFit fit(Errors errors = Errors::kMeasured);
  // Its models of waves, for another surface between two fits.
  UnevenPlane& waves() { return uneven_; }

 private:
  static constexpr std::uint32_t kQuadraticTerms = 6;  // 1, u, v, uu, uv, vv
  using Quadratic = Eigen::Matrix<double, kQuadraticTerms, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  // A patch with points, averaged.
  struct Mean {
    double u, v, r, b;
    double noise_variance;  // s_j^2 / W_j
    double information;     // 1 / (tau^2 + noise_variance)
    double error;           // r minus the current fit; after test_bend, minus the quadratic
    // Row of the design matrix. The strips' step is projected out: their rows and residuals are about their own mean
    // (Frisch and Waugh 1933).
    Eigen::Vector3d a;
    double r_centred, b_centred;
    // Of test_bend: inputs of the sums over pairs, as floats, four sums at a time. Their rounding is far below the
    // accuracy of a correlation. The quadratic's response to an error here, divided by its information: error and
    // responses of 1, u, v; of uu, uv, vv, and 1, which counts pairs; these times the information.
    FourFloats of_pairs[3];
    std::int32_t iu, iv;
    std::uint32_t layer;
  };
  // Each takes from the variance found by the last; swept: half 1 lost, twice nothing.
  static constexpr int kGiveBackRounds = 2;
  // Of one layer: variance of the rock between patches and its correlation by distance.
  struct Roughness {
    double tau2 = 0.0;
    double at_lag[kLags + 1] = {};
  };

  // Variance of one measured point about its patch's mean, by the share of the range that lies across the surface.
  struct Scatter {
    double surface = 0.0, range = 0.0;
    double at(double share2) const;
  };

  Scatter scatter_by_incidence(std::uint32_t first, std::uint32_t cells, int rounds) const;
  std::uint32_t collect_means(Errors errors);
  struct StripCentre {
    double u, v, r, b;
  };
  StripCentre strip_centre(std::uint32_t n) const;
  std::uint64_t work_of(std::uint32_t patches, Errors errors) const;
  bool solve(std::uint32_t n, Eigen::Vector3d* solution, Eigen::Matrix3d* inverse);
  double between_patch_variance(std::uint32_t n, std::uint32_t layer, const Eigen::Matrix3d& inverse) const;
  struct Neighbour {
    const Mean* mean;
    int lag;
  };
  // Over the pairs of patches of one layer, by how far apart they are.
  struct PairSums {
    struct Lag {
      double pairs = 0.0;
      double errors = 0.0;                                 // products of errors
      Eigen::Matrix3d weighted = Eigen::Matrix3d::Zero();  // products of answers
    };
    Lag lag[kLags + 1];
  };
  struct BendSums {
    PairSums pairs;  // weighted: of the answers of uu, uv and vv
    double taken_by_fit[kLags + 1] = {};
    double leverage = 0.0, patches = 0.0;
    Eigen::Matrix3d rock = Eigen::Matrix3d::Zero();   // times the rock's variance
    Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();  // of the points: together, the variance were no rock shared
  };
  // Pairs cost the most of a fit: bounds its work; fewer know the correlation less well.
  static constexpr std::uint32_t kPairedMost = 384;                                // swept: half 2 moved, twice nothing
  static constexpr std::uint32_t kNeighboursMost = (kLags + 1) * (2 * kLags + 1);  // its own row and those above
  // Neighbours in p's layer within kLags, in its own row and the rows above, each pair of patches once. Returns their
  // number.
  std::uint32_t neighbours_after(const Mean& p, Neighbour* out) const;
  template <typename Visit>
  double for_each_neighbourhood(std::uint32_t n, const Visit& visit) const;
  static void correlate_errors(const PairSums& sums, const double (&taken_by_fit)[kLags + 1], Roughness* rough);
  double visibility(double tau2_surface) const;
  struct Block {
    double w = 0.0, u = 0.0, v = 0.0, r = 0.0, noise = 0.0;
    Eigen::Vector3d response = Eigen::Vector3d::Zero();
  };
  Block sum_block(std::int32_t first, std::int32_t row, std::int32_t column, std::int32_t side,
                  const Eigen::Matrix3d& inverse) const;
  std::uint32_t collect_blocks(std::uint32_t layer, const Eigen::Matrix3d& inverse, std::int32_t* patches_wide);
  bool measure_errors(std::uint32_t n, const Eigen::Matrix3d& inverse, PatchFit* out);
  static Quadratic quadratic_terms(const Mean& p);
  double rock_about_quadratic(std::uint32_t n) const;
  BendSums sum_bend_pairs(std::uint32_t n) const;
  static Eigen::Matrix3d bend_sandwich(const BendSums& sums, const Roughness& rough);
  Eigen::Matrix3d covariance_of_bend(std::uint32_t n, const Matrix6& inverse) const;
  void test_bend(std::uint32_t n, PatchFit* out);

  Span<PatchSums> cells_;
  Span<Mean> means_;
  Span<std::int32_t> mean_of_cell_;  // index into means_, -1 for an empty cell
  // Of one layer: its patches, or blocks of them, and how the fit answers to each.
  Span<SurfacePatch> blocks_;
  Span<Eigen::Vector3d> responses_;
  UnevenPlane uneven_;
  double range_noise_m_ = 0.0;  // standard deviation of one range
  std::uint32_t columns_ = 1, rows_ = 1, layers_ = 1;
  float u_min_ = 0, v_min_ = 0, cells_per_m_ = 1;  // of the patches
};

}  // namespace pose_wall

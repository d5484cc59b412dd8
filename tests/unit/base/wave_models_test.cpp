// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a mixture's level has the mixture's tail; a surface's own evidence outvotes that of another; the errors of
// least squares over many rough and waving surfaces are what errors_of says, on few patches and on hundreds.

#include "base/estimation/wave_models.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "base/estimation/protection.hpp"
#include "base/estimation/uneven_plane.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

WaveEvidence evidence_of(std::initializer_list<float> log_likelihoods) {
  WaveEvidence out;
  out.exists = true;
  std::uint32_t k = 0;
  for (const float value : log_likelihoods) {
    out.solved[k] = true;
    out.log_likelihood[k++] = value;
  }
  return out;
}

double level_of(const Spread& s, double sigmas) {
  return protection_factor(sigmas, s.dof) * std::sqrt(s.variance);
}

TEST(WaveModels, WeightsFollowTheLikelihoodAndAddUp) {
  double weights[kWaveModels];
  ASSERT_TRUE(weigh_models(evidence_of({0.0F, std::log(3.0F)}), WaveEvidence{}, &weights));
  EXPECT_NEAR(weights[0], 0.25, 1e-6);
  EXPECT_NEAR(weights[1], 0.75, 1e-6);
  EXPECT_EQ(weights[2], 0.0) << "not solved";
  double shifted[kWaveModels];
  ASSERT_TRUE(weigh_models(evidence_of({-700.0F, -700.0F + std::log(3.0F)}), WaveEvidence{}, &shifted));
  EXPECT_NEAR(shifted[1], 0.75, 1e-4) << "a constant that all share changes nothing";
  EXPECT_FALSE(weigh_models(WaveEvidence{}, evidence_of({0.0F, 1.0F}), &weights));
}

TEST(WaveModels, AnotherSurfaceHelpsWhereTheOwnCannotTell) {
  const WaveEvidence unsure = evidence_of({0.0F, 0.0F, 0.0F});
  double weights[kWaveModels];
  ASSERT_TRUE(weigh_models(unsure, evidence_of({0.0F, -30.0F, -30.0F}), &weights));
  EXPECT_GT(weights[0], 0.9);
  EXPECT_GT(weights[1], 0.01) << "it may be other rock";
  ASSERT_TRUE(weigh_models(evidence_of({-30.0F, 0.0F, -30.0F}), evidence_of({0.0F, -30.0F, -30.0F}), &weights));
  EXPECT_GT(weights[1], 0.999) << "the own evidence outvotes";
  WaveEvidence coarse = evidence_of({0.0F, -30.0F, -30.0F});
  coarse.patch_m = 1.0F;
  ASSERT_TRUE(weigh_models(unsure, coarse, &weights));
  EXPECT_NEAR(weights[0], 1.0 / 3.0, 1e-6) << "patches of another size";
}

TEST(WaveModels, TheLevelHasTheTailOfTheMixture) {
  const double one[kWaveModels] = {1.0};
  const double variances[kWaveModels] = {4.0, 100.0};
  for (const double risk : {1e-2, 1e-4, 1e-6, 1e-9}) {
    const double sigmas = sigmas_at_risk(risk);
    const Spread alone = spread_of_mixture(one, variances, 30.0, sigmas);
    EXPECT_NEAR(alone.variance, 4.0, 1e-12);
    EXPECT_NEAR(alone.dof, 30.0, 1e-3);
    double last = level_of(alone, sigmas);
    for (const double wide : {1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.5}) {
      const double weights[kWaveModels] = {1.0 - wide, wide};
      const double level = level_of(spread_of_mixture(weights, variances, 1e6, sigmas), sigmas);
      // Share of the two normal distributions beyond the level, by the normal distribution itself.
      const double beyond =
          (1.0 - wide) * std::erfc(level / 2.0 / std::sqrt(2.0)) + wide * std::erfc(level / 10.0 / std::sqrt(2.0));
      EXPECT_LT(beyond, 1.02 * risk) << wide << " at " << risk;
      EXPECT_LE(level, 10.0 * sigmas * 1.01) << wide << " at " << risk;
      if (wide > risk) {
        EXPECT_GT(level, last) << wide << " at " << risk;
        EXPECT_GT(beyond, 0.9 * risk) << wide << " at " << risk;
      }
      last = level;
    }
  }
}

// A model whose variance is a thousandth of another's: far out it has no tail at all.
TEST(WaveModels, ANarrowModelTakesNothingFromTheTailOfAWideOne) {
  const double weights[kWaveModels] = {0.5, 0.5};
  for (const double narrow : {1e-2, 1e-4, 1e-8}) {
    const double variances[kWaveModels] = {narrow, 1.0};
    const double level = level_of(spread_of_mixture(weights, variances, 1e6, 5.0), 5.0);
    EXPECT_NEAR(0.5 * std::erfc(level / std::sqrt(2.0)) / std::erfc(5.0 / std::sqrt(2.0)), 1.0, 0.01) << narrow;
  }
}

TEST(WaveModels, ASumIsKnownAsWellAsItsLargerPart) {
  const Spread sum = sum_of({9.0, 5.0}, {1e-6, 1.0});
  EXPECT_NEAR(sum.variance, 9.0, 1e-5);
  EXPECT_NEAR(sum.dof, 5.0, 1e-3);
  EXPECT_NEAR(sum_of({1.0, 10.0}, {1.0, 10.0}).dof, 20.0, 1e-9);
}

// Least squares over columns by rows of half a metre: mean of the squared errors of its slopes over their variances.
double mean_z2(int columns, int rows, double waves_m, int runs) {
  double sum = 0.0;
  test::Placed<UnevenPlane> plane;
  for (int run = 0; run < runs; ++run) {
    test::Noise noise(static_cast<std::uint32_t>(run) + 1);
    std::vector<SurfacePatch> patches;
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        patches.push_back({0.5 * (i - 0.5 * columns), 0.5 * (j - 0.5 * rows), noise.normal(0.01), 0.0, 1e-6});
      }
    }
    for (int hill = 0; hill < columns * rows && waves_m > 0.0; ++hill) {
      const double u = noise.uniform(-0.3 * columns, 0.3 * columns), v = noise.uniform(-0.3 * rows, 0.3 * rows);
      const double height = noise.normal(0.02);
      for (SurfacePatch& p : patches) {
        const double r2 = (p.u - u) * (p.u - u) + (p.v - v) * (p.v - v);
        p.residual += height * std::exp(-r2 / (2.0 * waves_m * waves_m));
      }
    }
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const SurfacePatch& p : patches) {
      const Eigen::Vector3d a(1.0, p.u, p.v);
      normal += a * a.transpose();
      right += p.residual * a;
    }
    const Eigen::Matrix3d inverse = normal.inverse();
    const Eigen::Vector3d error = inverse * right;
    std::vector<Eigen::Vector3d> responses;
    for (SurfacePatch& p : patches) {
      const Eigen::Vector3d a(1.0, p.u, p.v);
      p.residual -= error.dot(a);
      responses.push_back(inverse * a);
    }
    const auto count = static_cast<std::uint32_t>(patches.size());
    const LinearErrors errors = plane->errors_of({patches.data(), count}, {responses.data(), count});
    EXPECT_TRUE(errors.solved());
    for (const int k : {1, 2}) {
      const Eigen::Vector3d at = Eigen::Vector3d::Unit(k);
      sum += error.dot(at) * error.dot(at) / errors.spread_of(at, 5.0).variance / (2.0 * runs);
    }
  }
  return sum;
}

TEST(WaveModels, LeastSquaresErrsAsErrorsOfSays) {
  for (const auto& [columns, rows] : {std::pair(4, 3), std::pair(12, 4), std::pair(48, 8)}) {
    for (const double waves_m : {0.0, 0.3}) {
      const double z2 = mean_z2(columns, rows, waves_m, 60);
      EXPECT_GT(z2, 0.15) << columns << " " << waves_m;
      EXPECT_LT(z2, 1.6) << columns << " " << waves_m;
    }
  }
}

TEST(WaveModels, FewerPatchesThanAPlaneNeedsHaveNoErrors) {
  test::Placed<UnevenPlane> plane;
  const std::vector<SurfacePatch> patches(7, SurfacePatch{0.0, 0.0, 0.01, 0.0, 1e-6});
  const std::vector<Eigen::Vector3d> responses(7, Eigen::Vector3d::UnitX());
  EXPECT_FALSE(plane->errors_of({patches.data(), 7}, {responses.data(), 7}).solved());
}

}  // namespace
}  // namespace pose_wall

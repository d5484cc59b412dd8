// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the covariance of a fit over patches is the spread that is really seen, on flat walls and on rock whose
// roughness is one piece over half a metre; the level of a bent wall reaches it and a flat one is not called bent; the
// response to a range bias is the change that the bias makes. Does not prove it for every roughness; the scenario tests
// look at more.

#include "base/estimation/patch_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/estimation/protection.hpp"
#include "base/estimation/tukey.hpp"
#include "support/rock.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kRangeNoise_m = 0.015;

using test::Rock;

constexpr double kLength_m = 8.0, kHeight_m = 2.0;
constexpr int kPoints = 1500;
constexpr int kRuns = 300;

template <typename Surface>
PatchFit fit(PatchGrid* grid, double noise_m, double scale_m, test::Noise* noise, const Surface& surface,
             int points = kPoints) {
  grid->begin(-kLength_m / 2, kLength_m / 2, 0.0, kHeight_m, 0.5, kRangeNoise_m);
  for (int i = 0; i < points; ++i) {
    const double u = noise->uniform(-kLength_m / 2, kLength_m / 2), v = noise->uniform(0.0, kHeight_m);
    const double r = surface(u, v) + noise->normal(noise_m);
    // As the stages do: Tukey weights of the robust scale.
    grid->add(test::patch_point(u, v, r, tukey_weight(r, scale_m), 1.0));
  }
  return grid->fit();
}

struct Scatter {
  double squares[3] = {}, claimed[3] = {}, z2[3] = {};
  void add(const PatchFit& f) {
    for (int k = 0; k < 3; ++k) {
      squares[k] += f.correction[k] * f.correction[k] / kRuns;
      claimed[k] += f.errors.covariance()(k, k) / kRuns;
      z2[k] += f.correction[k] * f.correction[k] / f.errors.covariance()(k, k) / kRuns;
    }
  }
};

// A variance out of 300 runs has a standard error of 8 %.
TEST(PatchFit, OnAFlatWallTheCovarianceIsTheSpread) {
  test::Placed<PatchGrid> grid;
  test::Noise noise(1);
  Scatter spread;
  for (int run = 0; run < kRuns; ++run) {
    const PatchFit f = fit(grid.get(), 0.02, 0.02, &noise, [](double, double) { return 0.0; });
    ASSERT_TRUE(f.solved);
    spread.add(f);
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::sqrt(spread.claimed[k] / spread.squares[k]), 1.0, 0.3) << "parameter " << k;
    EXPECT_GT(spread.z2[k], 0.5) << "parameter " << k;
    EXPECT_LT(spread.z2[k], 1.5) << "parameter " << k;
  }
}

// One look cannot exclude waves longer than these, so that the claimed errors are larger than those of this rock. z^2
// has a standard error of some 0.1 here.
TEST(PatchFit, OnRoughRockTheErrorsAreWhatTheCovarianceSays) {
  for (const double length_m : {0.2, 0.5}) {
    test::Placed<PatchGrid> grid;
    test::Noise noise(2);
    Scatter spread;
    for (int run = 0; run < kRuns; ++run) {
      const Rock rock(0.05, length_m, &noise);
      const PatchFit f = fit(grid.get(), 0.01, 0.05, &noise, [&](double u, double v) { return rock.at(u, v); });
      ASSERT_TRUE(f.solved);
      spread.add(f);
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(spread.z2[k], 0.3) << "parameter " << k << ", correlation length " << length_m;
      EXPECT_LT(spread.z2[k], 1.5) << "parameter " << k << ", correlation length " << length_m;
    }
    // Counting points as if they were independent would claim a hundredth of this.
    EXPECT_GT(spread.claimed[0], 10.0 * 0.05 * 0.05 / kPoints);
  }
}

// Sums over pairs are in floats: far from the origin they leave as much as near it. With a hole, and with a second
// layer.
TEST(PatchFit, FarFromTheOriginTheErrorsAreTheSame) {
  for (const std::uint32_t layers : {1U, 2U}) {
    test::Placed<PatchGrid> grid;
    PatchFit fits[2];
    for (int far = 0; far < 2; ++far) {
      test::Noise noise(7);
      const Rock rock(0.03, 0.5, &noise);
      const double from_m = far != 0 ? 24.0 : 0.0;
      grid->begin(from_m, from_m + 8.0, 0.0, 2.0, 0.5, kRangeNoise_m, layers);
      for (int i = 0; i < kPoints; ++i) {
        const double u = noise.uniform(0.0, 8.0), v = noise.uniform(0.0, 2.0);
        if (u > 2.0 && u < 3.0 && v < 1.0) continue;  // a hole
        const std::uint32_t layer = layers == 2 && u > 5.0 && u < 6.0 ? 1U : 0U;
        grid->add(test::patch_point(from_m + u, v, rock.at(u, v) + noise.normal(0.01), 1.0, 1.0), layer);
      }
      fits[far] = grid->fit();
      ASSERT_TRUE(fits[far].solved);
    }
    for (const double u : {0.0, 4.0, 8.0}) {
      const double near = fits[0].errors.spread_of({1.0, u, 1.0}, 5.0).variance,
                   far = fits[1].errors.spread_of({1.0, 24.0 + u, 1.0}, 5.0).variance;
      EXPECT_NEAR(far / near, 1.0, 1e-3) << layers << " layers, u " << u;
    }
    EXPECT_NEAR(fits[1].curvature_v_sigma / fits[0].curvature_v_sigma, 1.0, 2e-2) << layers << " layers";
    EXPECT_EQ(fits[0].bends, fits[1].bends);
  }
}

TEST(PatchFit, GivesBackAnOffsetAndSlopes) {
  test::Placed<PatchGrid> grid;
  test::Noise noise(3);
  const PatchFit f =
      fit(grid.get(), 0.005, 0.05, &noise, [](double u, double v) { return 0.01 + 0.003 * u - 0.004 * v; });
  ASSERT_TRUE(f.solved);
  const double expected[3] = {0.01, 0.003, -0.004};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(f.correction[k], expected[k], 5.0 * std::sqrt(f.errors.covariance()(k, k)));
  // The variance at a place is that of a + b u + c v.
  const Eigen::Vector3d a(1.0, 2.0, 0.5);
  const double variance = a.dot(f.errors.covariance() * a);
  EXPECT_NEAR(f.errors.spread_of(a, 5.0).variance, variance, 1e-9 * variance);
  EXPECT_GT(f.errors.spread_of({1.0, 20.0, 0.5}, 5.0).variance, variance);
}

TEST(PatchFit, ABiasMovesTheFitAsTheResponseSays) {
  constexpr double kBias_m = 0.02;
  test::Placed<PatchGrid> grid;
  PatchFit fits[2];
  for (int biased = 0; biased < 2; ++biased) {
    test::Noise noise(4);
    grid->begin(-4, 4, 0, 2, 0.5, kRangeNoise_m);
    for (int i = 0; i < kPoints; ++i) {
      const double u = noise.uniform(-4, 4), v = noise.uniform(0, 2);
      const double along_normal = -2.0 / std::sqrt(4.0 + u * u);  // ray . normal of a wall 2 m away
      grid->add(test::patch_point(u, v, noise.normal(0.003) + biased * kBias_m * along_normal, 1.0, along_normal));
    }
    fits[biased] = grid->fit();
    ASSERT_TRUE(fits[biased].solved);
  }
  const Eigen::Vector3d moved = fits[1].correction - fits[0].correction;
  // Weights of the patches change a little with the bias, by the curve that it looks like: a few per cent.
  EXPECT_NEAR(moved[0], kBias_m * fits[0].bias_response[0], 0.15 * std::fabs(moved[0]));
}

// Whether a bend is called one or taken for roughness of one piece: the level reaches the surface.
TEST(PatchFit, TheLevelOfABentWallReachesItsSurface) {
  test::Placed<PatchGrid> grid;
  test::Noise noise(5);
  for (const double bend : {0.003, 0.01, -0.02}) {  // 0.05, 0.16 and 0.32 m at the ends
    const PatchFit f = fit(grid.get(), 0.01, 0.2, &noise, [&](double u, double) { return bend * u * u; });
    ASSERT_TRUE(f.solved);
    for (const double u : {-3.0, 0.0, 2.0, 3.0}) {
      const double plane = f.correction[0] + f.correction[1] * u + f.correction[2];
      const Spread at = f.errors.spread_of({1.0, u, 1.0}, 5.0);
      const double level = protection_factor(5.0, at.dof) * std::sqrt(at.variance) + std::fabs(f.bend_at(u, 1.0));
      EXPECT_LE(std::fabs(plane - bend * u * u), level) << bend << " at " << u;
    }
  }
}

TEST(PatchFit, AFlatWallIsNotBent) {
  test::Placed<PatchGrid> grid;
  test::Noise noise(6);
  int bent = 0;
  for (int run = 0; run < kRuns; ++run) {
    bent += fit(grid.get(), 0.02, 0.02, &noise, [](double, double) { return 0.0; }).bends ? 1 : 0;
  }
  EXPECT_LE(bent, 1);  // one in ten thousand by design
}

// Rock is straight on the average: what curvature a draw of it has, its standard deviation explains, on short walls
// too.
TEST(PatchFit, OnRoughRockTheCurvatureIsChance) {
  for (const double length_m : {0.2, 0.4}) {
    for (const double half_wall_m : {kLength_m / 4, kLength_m / 2}) {
      test::Placed<PatchGrid> grid;
      test::Noise noise(5);
      double z2 = 0.0;
      int bends = 0;
      for (int run = 0; run < kRuns; ++run) {
        const Rock rock(0.05, length_m, &noise);
        grid->begin(-half_wall_m, half_wall_m, 0.0, kHeight_m, 0.5, kRangeNoise_m);
        for (int i = 0; i < kPoints / 2; ++i) {
          const double u = noise.uniform(-half_wall_m, half_wall_m), v = noise.uniform(0.0, kHeight_m);
          const double r = rock.at(u, v) + noise.normal(0.01);
          grid->add(test::patch_point(u, v, r, tukey_weight(r, 0.1), 1.0));
        }
        const PatchFit f = grid->fit();
        ASSERT_TRUE(f.solved);
        z2 += f.curvature_v * f.curvature_v / (f.curvature_v_sigma * f.curvature_v_sigma) / kRuns;
        bends += f.bends ? 1 : 0;
      }
      EXPECT_GT(z2, 0.4) << length_m << " on " << 2.0 * half_wall_m;
      EXPECT_LT(z2, 1.5) << length_m << " on " << 2.0 * half_wall_m;
      EXPECT_LE(bends, kRuns / 50) << length_m << " on " << 2.0 * half_wall_m;
    }
  }
}

// Two rows of points, as a sparse sensor may see: nothing is known of a curvature across them.
TEST(PatchFit, CurvatureThatNoPointsShowIsUnknown) {
  for (const double rock_m : {0.0, 0.03}) {
    test::Placed<PatchGrid> grid;
    test::Noise noise(7);
    const Rock rock(rock_m, 0.3, &noise);
    grid->begin(-kLength_m / 2, kLength_m / 2, 0.0, kHeight_m, 0.5, kRangeNoise_m);
    for (int i = 0; i < kPoints; ++i) {
      const double u = noise.uniform(-kLength_m / 2, kLength_m / 2), v = i % 2 == 0 ? 0.3 : 0.8;
      grid->add(test::patch_point(u, v, rock.at(u, v) + noise.normal(0.01), 1.0, 1.0));
    }
    const PatchFit f = grid->fit();
    ASSERT_TRUE(f.solved);
    EXPECT_GT(f.curvature_v_sigma, 0.1) << rock_m;
    EXPECT_FALSE(f.bends) << rock_m;
  }
}

// A heap along the foot of a rough wall: its patches err alike all along, which is no reason to doubt it.
TEST(PatchFit, AFootThatStandsOutAllAlongIsABendForSure) {
  test::Placed<PatchGrid> grid;
  test::Noise noise(6);
  int sure = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Rock rock(0.02, 0.3, &noise);
    const PatchFit f = fit(grid.get(), 0.01, 0.1, &noise, [&](double u, double v) {
      const double heap_m = v < 0.6 ? 0.25 * (0.6 - v) : 0.0;
      return rock.at(u, v) + heap_m;
    });
    ASSERT_TRUE(f.solved);
    sure += f.curvature_v > 3.5 * f.curvature_v_sigma ? 1 : 0;
  }
  EXPECT_GT(sure, 0.9 * kRuns);
}

TEST(PatchFit, RefusesWhatHoldsNoPlane) {
  test::Placed<PatchGrid> grid;
  grid->begin(-4, 4, 0, 2, 0.5, kRangeNoise_m);
  EXPECT_FALSE(grid->fit().solved) << "empty";
  for (int i = 0; i < 1000; ++i) grid->add(test::patch_point(1.1, 1.1, 0.0, 1.0, 1.0));
  EXPECT_FALSE(grid->fit().solved) << "one place";
  grid->begin(-4, 4, 0, 2, 0.5, kRangeNoise_m);
  for (int i = 0; i < 1000; ++i) grid->add(test::patch_point(-4.0 + 0.008 * i, 1.1, 0.001 * (i % 3), 1.0, 1.0));
  EXPECT_FALSE(grid->fit().solved) << "one line";
}

TEST(PatchFit, PointsOutsideTheGridAndNaNAreLeftOut) {
  test::Placed<PatchGrid> grid;
  grid->begin(0, 4, 0, 2, 0.5, kRangeNoise_m);
  test::Noise noise(7);
  for (int i = 0; i < 500; ++i)
    grid->add(test::patch_point(noise.uniform(0, 4), noise.uniform(0, 2), noise.normal(0.01), 1.0, 1.0));
  for (const double wild : {-1.0, 1e9, -1e30, std::nan("")}) {
    grid->add(test::patch_point(wild, 1.0, 99.0, 1.0, 1.0));
    grid->add(test::patch_point(1.0, wild, 99.0, 1.0, 1.0));
  }
  const PatchFit f = grid->fit();
  ASSERT_TRUE(f.solved);
  EXPECT_LT(std::fabs(f.correction[0]), 0.01);
}

TEST(PatchFit, AnExtentLargerThanTheGridGetsLargerPatches) {
  test::Placed<PatchGrid> grid;
  grid->begin(-100, 100, 0, 2, 0.5, kRangeNoise_m);
  test::Noise noise(8);
  for (int i = 0; i < 5000; ++i)
    grid->add(test::patch_point(noise.uniform(-100, 100), noise.uniform(0, 2), noise.normal(0.01), 1.0, 1.0));
  const PatchFit f = grid->fit();
  EXPECT_GT(f.patches, 40U);
  EXPECT_LE(f.patches, PatchGrid::kCapacity);
}

// More patches than the models of waves have room for: blocks of them, which have the same errors.
TEST(PatchFit, ALongWallsErrorsAreThoseOfBlocksOfItsPatches) {
  constexpr double kLong_m = 60.0, kHigh_m = 3.0;  // 720 patches, and 384 is the most
  constexpr int kWalls = 60;                       // a mean z2 of so many scatters by a fifth
  test::Placed<PatchGrid> grid;
  test::Noise noise(12);
  double z2[3] = {};
  for (int run = 0; run < kWalls; ++run) {
    const Rock rock(0.03, 0.3, &noise);
    grid->begin(-kLong_m / 2, kLong_m / 2, 0.0, kHigh_m, PatchGrid::kPatch_m, kRangeNoise_m);
    for (int i = 0; i < 8 * kPoints; ++i) {
      const double u = noise.uniform(-kLong_m / 2, kLong_m / 2), v = noise.uniform(0.0, kHigh_m);
      grid->add(test::patch_point(u, v, rock.at(u, v) + noise.normal(0.01), 1.0, 1.0));
    }
    const PatchFit f = grid->fit();
    ASSERT_TRUE(f.solved);
    ASSERT_GT(f.patches, SurfacePatches::kMost);
    ASSERT_EQ(f.errors.layer[0].evidence.patch_m, 2.0F * static_cast<float>(PatchGrid::kPatch_m))
        << "of larger patches a model of waves means another thing";
    ASSERT_LT(f.errors.layer[0].freedom, static_cast<double>(SurfacePatches::kMost));
    for (int k = 0; k < 3; ++k) z2[k] += f.correction[k] * f.correction[k] / f.errors.covariance()(k, k) / kWalls;
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(z2[k], 0.3) << "parameter " << k;
    EXPECT_LT(z2[k], 1.6) << "parameter " << k;
  }
  grid->begin(-kLength_m / 2, kLength_m / 2, 0.0, kHeight_m, PatchGrid::kPatch_m, kRangeNoise_m);
  for (int i = 0; i < kPoints; ++i) {
    const double u = noise.uniform(-kLength_m / 2, kLength_m / 2), v = noise.uniform(0.0, kHeight_m);
    grid->add(test::patch_point(u, v, noise.normal(0.01), 1.0, 1.0));
  }
  EXPECT_EQ(grid->fit().errors.layer[0].evidence.patch_m, static_cast<float>(PatchGrid::kPatch_m)) << "a short wall";
}

// Two layers: a step of unknown size before the surface leaves its offset alone, and lends it the slopes.
TEST(PatchFit, ASecondLayerTellsSlopesButNoOffset) {
  test::Placed<PatchGrid> grid;
  PatchFit fits[3];
  for (int k = 0; k < 3; ++k) {  // no second layer, one 0.1 m before it, one 0.4 m before it
    test::Noise noise(9);
    grid->begin(-8, 8, 0, 2, 0.5, kRangeNoise_m, k == 0 ? 1 : 2);
    const auto surface = [](double u, double v) { return 0.01 + 0.002 * u + 0.001 * v; };
    for (int i = 0; i < kPoints; ++i) {
      const double u = noise.uniform(-1.5, 1.5), v = noise.uniform(0, 2);
      grid->add(test::patch_point(u, v, surface(u, v) + noise.normal(0.01), 1.0, 1.0), 0);
    }
    for (int i = 0; k > 0 && i < kPoints; ++i) {
      const double u = noise.uniform(-8, 8), v = noise.uniform(0, 2);
      grid->add(test::patch_point(u, v, (k == 1 ? 0.1 : 0.4) + surface(u, v) + noise.normal(0.01), 1.0, 1.0), 1);
    }
    fits[k] = grid->fit();
    ASSERT_TRUE(fits[k].solved);
    EXPECT_NEAR(fits[k].correction[0], 0.01, 5.0 * std::sqrt(fits[k].errors.covariance()(0, 0)));
    EXPECT_NEAR(fits[k].correction[1], 0.002, 5.0 * std::sqrt(fits[k].errors.covariance()(1, 1)));
  }
  EXPECT_LT(fits[1].errors.covariance()(1, 1), 0.2 * fits[0].errors.covariance()(1, 1)) << "five times as long a base";
  EXPECT_GT(fits[1].errors.covariance()(0, 0), 0.3 * fits[0].errors.covariance()(0, 0))
      << "the offset rests on the surface alone";
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(fits[1].correction[k], fits[2].correction[k], 1e-6) << "whatever the step: parameter " << k;
  }
}

// Points in the order of their patches, four at a time, come to the same as one by one.
TEST(PatchFit, SumsOfPatchesAreThoseOfTheirPoints) {
  constexpr std::uint32_t kMany = 900;
  test::Placed<PatchGrid> one, sorted;
  for (auto* grid : {one.get(), sorted.get()}) grid->begin(-4, 4, 0, 2, 0.5, kRangeNoise_m);
  test::Noise noise(10);
  std::vector<std::vector<std::array<float, 4>>> of_patch(sorted->patches());
  for (std::uint32_t i = 0; i < kMany; ++i) {
    const auto u = static_cast<float>(noise.uniform(-4, 4)), v = static_cast<float>(noise.uniform(0, 2));
    const auto r = static_cast<float>(0.01 + 0.002 * static_cast<double>(u) + noise.normal(0.01));
    // Next to no weight is none.
    const float weight = i % 5 == 0 ? 1e-9F : 1.0F + static_cast<float>(i % 3);
    if (weight > 1e-6F) {
      one->add(PatchPoint::of(u, v, r, weight, 0.5F));
    }
    const FourInts patch = sorted->patch_of(all_four(u), all_four(v));
    of_patch.at(static_cast<std::size_t>(patch[0])).push_back({u, v, r, weight});
  }
  sorted->begin_anew(1);
  for (std::uint32_t patch = 0; patch < sorted->patches(); ++patch) {
    PatchLanes sums;
    const auto& points = of_patch[patch];
    for (std::size_t k = 0; k < points.size(); k += kFour) {
      FourFloats row[4] = {};
      for (std::size_t lane = 0; lane < kFour && k + lane < points.size(); ++lane) {
        for (std::size_t of = 0; of < 4; ++of) row[of][lane] = points[k + lane][of];
      }
      sums.add({row[0], row[1], row[2], all_four(0.5F)}, row[3]);
    }
    sorted->set(patch, 0, sums);
  }
  const PatchFit a = one->fit(), b = sorted->fit();
  ASSERT_TRUE(a.solved && b.solved);
  EXPECT_EQ(a.patches, b.patches);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(a.correction[k], b.correction[k], 1e-6);
    EXPECT_NEAR(a.errors.covariance()(k, k), b.errors.covariance()(k, k), 1e-3 * a.errors.covariance()(k, k));
  }
  EXPECT_NEAR(a.visibility_m, b.visibility_m, 1e-5);
  const PatchFit without_bends = one->fit(PatchGrid::Errors::kCovariance);
  EXPECT_EQ(without_bends.correction, a.correction);
  EXPECT_EQ(without_bends.errors.covariance(), a.errors.covariance());
  EXPECT_EQ(without_bends.bias_response, a.bias_response);
  EXPECT_EQ(without_bends.errors.spread_of(Eigen::Vector3d::UnitY(), 5.0).dof,
            a.errors.spread_of(Eigen::Vector3d::UnitY(), 5.0).dof);
}

TEST(PatchFit, EveryPlaceHasAPatch) {
  test::Placed<PatchGrid> grid;
  grid->begin(-4, 4, 0, 2, 0.5, kRangeNoise_m);
  const FourInts patch = grid->patch_of(FourFloats{-1e9F, -4.0F, 4.0F, 1e9F}, FourFloats{-1e9F, 0.0F, 2.0F, 1e9F});
  EXPECT_EQ(patch[0], 0);
  EXPECT_EQ(patch[1], 0);
  EXPECT_EQ(patch[2], static_cast<std::int32_t>(grid->patches()) - 1);
  EXPECT_EQ(patch[3], static_cast<std::int32_t>(grid->patches()) - 1);
}

}  // namespace
}  // namespace pose_wall

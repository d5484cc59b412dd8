// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the plane of a region is that of the definition, whatever opens behind it or stands before it. Over many
// waving surfaces of which a half is seen, the plane of the whole is as far off as the standard deviation says, and
// within the level. Where another plane may as well be the region's, where the unseen part bends, or most of it is
// open, that is told.

#include "engine/region/region_plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/estimation/protection.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kNoise_m = 0.01, kDistance_m = 2.5;
const Eigen::Vector3d kOffset(1.0, 0.0, 0.0), kSlope(0.0, 1.0, 0.0);

// How far the surface lies beside the machine, at u along and v up. NaN: nothing is seen there.
using Surface = std::function<double(double u, double v)>;

Region region_beside() {
  Region region;
  region.u = Eigen::Vector3d::UnitX();
  region.v = Eigen::Vector3d::UnitZ();
  region.h = Eigen::Vector3d::UnitY();
  region.u_from_m = 0.0;
  region.u_to_m = 2.5;
  region.v_min_m = -1.125;
  region.v_max_m = 1.125;
  region.h_min_m = 0.3;
  region.sensor_m = Eigen::Vector3d::Zero();
  region.bend_per_m.fill(0.1);
  return region;
}

struct Fitted {
  RegionPlane plane;
  double step_ahead_m, step_behind_m;  // about two metres away
  RegionPlane by_endless;
};

Fitted fitted(const Surface& surface, test::Noise* noise, const Region& region = region_beside(),
              const UnevenFit& endless = {}) {
  test::OwnedPoints points(32768);
  for (double u = -region.u_to_m - 0.46; u < region.u_to_m + 0.5; u += 0.08) {
    for (double v = -1.56; v < 1.6; v += 0.08) {
      const double h = surface(u, v);
      if (!std::isnan(h)) points.add(u, h + noise->normal(kNoise_m), v, 4.0F);
    }
  }
  test::Placed<RegionFit> fit;
  test::Placed<UnevenPlane> waves;
  Work work;
  RegionPlane by_endless;
  const RegionPlane plane =
      fit->fit(points.set(), region, test::settings_with(), waves.get(), &work, endless, &by_endless);
  return {plane, fit->step_at(2.0, plane.at), fit->step_at(-2.0, plane.at), by_endless};
}

RegionPlane plane_of(const Surface& surface, test::Noise* noise) {
  return fitted(surface, noise).plane;
}

Settings without_bias() {
  Settings s = test::settings_with();
  s.range_bias_max = 0.0;
  return s;
}

double level(const RegionPlane& plane, const Eigen::Vector3d& of) {
  const Settings s = without_bias();
  return protection_factor(s.protection_sigmas, plane.dof) * plane.sigma(of) + plane.bound(of, s).sum();
}

// Smooth and random: hills of one width at random places.
class Hills {
 public:
  Hills(double height_m, double width_m, test::Noise* noise) : width_m_(width_m) {
    constexpr int kHills = 200;
    constexpr double kReach_m = 5.0;
    const double per_hill = height_m * 2.0 * kReach_m / (width_m * std::sqrt(3.14159 * kHills));
    for (int k = 0; k < kHills; ++k) {
      hills_.push_back(
          {noise->uniform(-kReach_m, kReach_m), noise->uniform(-kReach_m, kReach_m), noise->normal(per_hill)});
    }
  }
  double operator()(double u, double v) const {
    double sum = 0.0;
    for (const Hill& hill : hills_) {
      const double r2 = (hill.u - u) * (hill.u - u) + (hill.v - v) * (hill.v - v);
      sum += hill.height * std::exp(-r2 / (2.0 * width_m_ * width_m_));
    }
    return sum;
  }

 private:
  struct Hill {
    double u, v, height;
  };
  double width_m_;
  std::vector<Hill> hills_;
};

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

TEST(RegionPlane, OfAFlatWallIsThatWall) {
  test::Noise noise(1);
  const RegionPlane plane = plane_of([](double u, double v) { return kDistance_m + 0.1 * u - 0.05 * v; }, &noise);
  ASSERT_TRUE(plane.is_there());
  // Noise of 10 mm over some 1700 points, 0.3 mm; the range of u is 5 m.
  EXPECT_NEAR(plane.at[0], kDistance_m, 1.5e-3);
  EXPECT_NEAR(plane.at[1], 0.1, 1e-3);
  EXPECT_NEAR(plane.at[2], -0.05, 2e-3);
  EXPECT_LT(level(plane, kOffset), 0.02);
  EXPECT_GT(plane.near, 0.98);
  const Plane in_frame = plane.plane_in(region_beside());
  EXPECT_NEAR(in_frame.signed_distance(Eigen::Vector3d(1.0, plane.at[0] + plane.at[1], 0.0)), 0.0, 1e-12);
  EXPECT_GT(in_frame.signed_distance(Eigen::Vector3d::Zero()), 0.0) << "the normal points to the machine";
}

TEST(RegionPlane, HardlyHeedsAnOpeningBehindOrAPipeBefore) {
  test::Noise noise(2);
  const RegionPlane beside_opening =
      plane_of([](double u, double) { return u > 1.2 ? kDistance_m + 1.5 : kDistance_m; }, &noise);
  ASSERT_TRUE(beside_opening.is_there());
  // 1.5 m off weighs 1/101, so 0.26 of the cells pull by 3.9 mm in all, at 1.9 m from the middle. The others spread by
  // 1.2 m2 about their own middle 0.65 m behind, with a share of 0.74: 5 mm, and 11 mrad.
  EXPECT_NEAR(beside_opening.at[0], kDistance_m, 0.02);
  EXPECT_NEAR(beside_opening.at[1], 0.0, 0.02);
  EXPECT_NEAR(beside_opening.near, 0.74, 0.05);
  const RegionPlane behind_pipe =
      plane_of([](double, double v) { return v > 0.2 && v < 0.7 ? kDistance_m - 0.5 : kDistance_m; }, &noise);
  ASSERT_TRUE(behind_pipe.is_there());
  // 0.5 m before weighs 1/45, a fifth of the cells: 0.5 m x 1/45 x 0.22/0.78 is 3 mm.
  EXPECT_NEAR(behind_pipe.at[0], kDistance_m, 0.01);
}

TEST(RegionPlane, IsAsFarOffAsItSaysWhereHalfOfAWavingSurfaceIsSeen) {
  constexpr int kRuns = 60;
  double squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    test::Noise noise(100 + static_cast<std::uint32_t>(run));
    const double width_m = std::vector<double>{0.3, 0.6, 1.0}[static_cast<std::size_t>(run % 3)];
    const Hills hills(0.03, width_m, &noise);
    const auto whole = [&hills](double u, double v) { return kDistance_m + hills(u, v); };
    // As by a sensor with few rings: half of the heights.
    const auto seen = [&whole](double u, double v) { return v > -0.6 && v < 0.5 ? whole(u, v) : kUnseen; };
    const RegionPlane truth = plane_of(whole, &noise), plane = plane_of(seen, &noise);
    ASSERT_TRUE(truth.found && plane.found);
    for (const Eigen::Vector3d& of : {kOffset, kSlope}) {
      const double error = of.dot(plane.at - truth.at), sigma = plane.sigma(of);
      squares += error * error / (sigma * sigma) / (2.0 * kRuns);
      EXPECT_LT(std::fabs(error), level(plane, of)) << "run " << run;
    }
  }
  // Hills are smoother than the models' waves, and Cauchy's weights bend the chain's linear errors: 2.0 (2026-11-28).
  EXPECT_LT(squares, 2.5);
  EXPECT_GT(squares, 0.1) << "levels are wider than they need be";
}

// All of the surface in view tells which plane the waves ride on. Then what is not seen is known better, and as well as
// is told; where all is seen, it tells nothing.
TEST(RegionPlane, AnEndlessPlaneTellsOfWhatIsNotSeen) {
  constexpr int kRuns = 60;                               // half a second
  constexpr double kOffset_m = 0.003, kPerMetre = 0.001;  // as an endless plane of smooth rock is known
  double alone = 0.0, with = 0.0, scaled = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    test::Noise noise(300 + static_cast<std::uint32_t>(run));
    const Hills hills(0.03, run % 2 == 0 ? 0.25 : 0.5, &noise);
    const auto whole = [&hills](double u, double v) { return kDistance_m + hills(u, v); };
    const auto seen = [&whole](double u, double v) { return u < -0.5 ? whole(u, v) : kUnseen; };
    UnevenFit endless;
    endless.solved = true;
    endless.dof = 40.0;
    endless.correction = {kDistance_m + noise.normal(kOffset_m), noise.normal(kPerMetre), noise.normal(kPerMetre)};
    endless.covariance.diagonal() << kOffset_m * kOffset_m, kPerMetre * kPerMetre, kPerMetre * kPerMetre;
    const RegionPlane truth = plane_of(whole, &noise);
    const Fitted of_seen = fitted(seen, &noise, region_beside(), endless);
    ASSERT_TRUE(truth.found && of_seen.plane.found && of_seen.by_endless.found);
    for (const Eigen::Vector3d& of : {kOffset, kSlope}) {
      const double error = of.dot(of_seen.by_endless.at - truth.at), sigma = of_seen.by_endless.sigma(of);
      scaled += error * error / (sigma * sigma) / (2.0 * kRuns);
      EXPECT_LT(std::fabs(error), level(of_seen.by_endless, of)) << "run " << run;
      EXPECT_LT(level(of_seen.by_endless, of), level(of_seen.plane, of)) << "run " << run;
    }
    alone += std::pow(kSlope.dot(of_seen.plane.at - truth.at), 2);
    with += std::pow(kSlope.dot(of_seen.by_endless.at - truth.at), 2);
    const Fitted of_all = fitted(whole, &noise, region_beside(), endless);
    EXPECT_LT((of_all.by_endless.at - of_all.plane.at).norm(), 1e-3) << "run " << run;
    EXPECT_LT(of_all.by_endless.share_of_endless(kOffset).norm(), 0.1) << "run " << run;
  }
  EXPECT_LT(with, 0.25 * alone) << "half the error";
  EXPECT_LT(scaled, 2.5);
  EXPECT_GT(scaled, 0.1) << "levels are wider than they need be";
}

TEST(RegionPlane, WithoutAnEndlessPlaneNothingIsPredictedFromOne) {
  test::Noise noise(12);
  EXPECT_FALSE(fitted([](double, double) { return kDistance_m; }, &noise).by_endless.found);
}

TEST(RegionPlane, LevelReachesToABendOfWhatIsNotSeen) {
  test::Noise noise(4);
  // Only the upper half is seen; the lower one bends away by a tenth of v².
  const RegionPlane plane = plane_of([](double, double v) { return v > 0.0 ? kDistance_m : kUnseen; }, &noise);
  ASSERT_TRUE(plane.found);
  // The wall's plane with that bend below: the mean of 0.1 v² over the lower half is 4 cm, over all 2 cm.
  EXPECT_GT(plane.bound(kOffset, without_bias())[POSE_WALL_PART_BEND], 0.02);
  const RegionPlane whole = plane_of([](double, double) { return kDistance_m; }, &noise);
  EXPECT_LT(whole.bound(kOffset, test::settings_with())[POSE_WALL_PART_BEND], 1e-3);
}

TEST(RegionPlane, LevelReachesToTheWallBehindThings) {
  test::Noise noise(5);
  for (const double upto_m : {0.3, 0.5, 0.7}) {
    // Pipes that leave the top and the foot of the wall free.
    const auto pipes = [upto_m](double, double v) { return std::fabs(v) < upto_m ? kDistance_m - 0.25 : kDistance_m; };
    const RegionPlane plane = plane_of(pipes, &noise);
    ASSERT_TRUE(plane.found);
    EXPECT_LT(std::fabs(plane.at[0] - kDistance_m), level(plane, kOffset)) << upto_m;
  }
}

// Half of the region lies 0.8 m behind the other half: by the definition there is no wall, or one that is doubted.
TEST(RegionPlane, OfTwoHalvesApartIsNoSureWall) {
  test::Noise noise(8);
  EXPECT_FALSE(plane_of([](double u, double) { return u > 0.0 ? 2.0 : 2.8; }, &noise).is_there());
}

// What lies between the two parts of a region is not of it, whatever it is.
TEST(RegionPlane, OfARingLeavesItsMiddleOut) {
  test::Noise noise(9);
  Region ring = region_beside();
  ring.u_from_m = 4.0;
  ring.u_to_m = 8.0;
  const auto pit = [](double u, double v) {
    return kDistance_m + 0.02 * u + 0.01 * v + (std::fabs(u) < 3.4 ? 1.0 : 0.0);
  };
  const RegionPlane plane = fitted(pit, &noise, ring).plane;
  ASSERT_TRUE(plane.is_there());
  EXPECT_NEAR(plane.at[0], kDistance_m, 5e-3);
  EXPECT_NEAR(plane.at[1], 0.02, 1e-3);
  EXPECT_NEAR(plane.at[2], 0.01, 3e-3);
  EXPECT_GT(plane.seen_at_ends, 0.95);
}

// A niche about one sampling point leaves the wall, but the distance there is that of the niche.
TEST(RegionPlane, StepsAreToldWhereMostOfTheSurfaceIsAnother) {
  test::Noise noise(10);
  const Fitted niche = fitted([](double u, double) { return u > 1.4 ? kDistance_m + 0.6 : kDistance_m; }, &noise);
  EXPECT_NEAR(niche.step_ahead_m, 0.6, 0.1);
  EXPECT_EQ(niche.step_behind_m, 0.0);
}

// An endless plane is uncertain as that of the region by as much as the rock waves.
TEST(RegionPlane, WavesTurnItAboutAnEndlessPlane) {
  test::Noise noise(11);
  const RegionPlane smooth = plane_of([](double, double) { return kDistance_m; }, &noise);
  const auto waves = [](double u, double v) {
    return kDistance_m + 0.05 * std::sin(2.0 * u + 0.7) + 0.05 * std::sin(3.0 * v);
  };
  const RegionPlane wavy = plane_of(waves, &noise);
  const Eigen::Vector3d slope(0.0, 1.0, 0.0);
  EXPECT_LT(smooth.sigma_about_endless(slope), 1e-3);
  EXPECT_GT(wavy.sigma_about_endless(slope), 5e-3);
  EXPECT_LT(wavy.sigma_about_endless(slope), 0.1);
}

TEST(RegionPlane, OfAnOpeningIsNone) {
  test::Noise noise(6);
  for (const double depth_m : {1.5, 4.0, 9.0}) {
    const RegionPlane plane = plane_of(
        [depth_m](double u, double v) {
          return u < -1.0 ? kDistance_m : kDistance_m + depth_m + 0.9 * std::fabs(u) + v;
        },
        &noise);
    ASSERT_TRUE(plane.found);
    EXPECT_TRUE(plane.is_none()) << depth_m;
  }
}

TEST(RegionPlane, NeedsCellsThatSpreadOut) {
  test::Noise noise(7);
  EXPECT_FALSE(plane_of([](double, double) { return kUnseen; }, &noise).found);
  EXPECT_FALSE(plane_of([](double u, double) { return std::fabs(u) < 0.2 ? kDistance_m : kUnseen; }, &noise).found);
  EXPECT_FALSE(plane_of([](double, double) { return 12.0; }, &noise).found) << "beyond what is looked at";
}

}  // namespace
}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a distance's level reaches to where the wall leaves its plane at the height of the sampling point. That is
// above the band, and where the wall's top was cut off. It reaches no further inside a band that is one plane. A wall
// is told to be straight over its height if it is and shows it. Does not prove yaw and distances: walls_test does.

#include "engine/walls/sample/measure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/band_fixture.hpp"
#include "support/rock.hpp"
#include "support/wall_profiles.hpp"

namespace pose_wall {
namespace {

using namespace test;

constexpr double kWall_m = 2.0;
constexpr double kBandTop_m = 2.4;  // above the floor; wall_z_max is a decimetre more

// Away from the machine, so that no end is cut off.
double hollow(double z_m) {
  return -0.1 * (z_m + 0.1) * (z_m + 0.1);
}
double steps_in_above(double z_m) {
  return z_m > 1.1 ? 0.1 : 0.0;
}

struct Look {
  double rough_m = 0.0;
  double from_m = 0.3, to_m = 3.2;  // heights that are seen
  double step_m = 0.1;
  std::uint32_t seed = 1;
};

void add_wall(WallProfile profile, const Look& look, BandFixture* band) {
  test::Noise noise(look.seed);
  const test::Rock rock(look.rough_m, 0.3, &noise);
  for (double x = -8.0; x <= 8.0; x += 0.1) {
    for (double height = look.from_m; height <= look.to_m; height += look.step_m) {
      const double y = kWall_m - profile(height + kFloorZ_m) - rock.at(x, height) + noise.normal(0.01);
      test::OwnedPoints& to = height <= kBandTop_m ? band->points() : band->beyond();
      to.add(x + noise.uniform(-0.04, 0.04), y, height + kFloorZ_m, 4.0F);
    }
  }
}

FittedWall measured(WallProfile profile, double sample_height_m, const Look& look = {}) {
  BandFixture band({{"range_noise", "0.01"}});
  add_wall(profile, look, &band);
  WallScene scene = band.scene();
  for (auto& of_side : scene.sample_level_m) {
    for (Eigen::Vector3d& sample : of_side) sample.z() = sample_height_m + kFloorZ_m;
  }
  test::Placed<WallGrid> grid;
  test::Placed<WallFitScratch> scratch(band.points().set().capacity());
  const WallSurface surface = fit_surface(scene, {-Eigen::Vector3d::UnitY(), kWall_m}, grid.get(), scratch.get());
  PatchErrors errors;
  const FittedWall wall = measure_wall(scene, surface, 0, *grid, &errors);
  EXPECT_TRUE(wall.fit.found);
  EXPECT_NEAR(wall.distance_m[0], kWall_m, 0.06);
  return wall;
}

double bend_m(const FittedWall& wall) {
  return std::fmax(wall.distance_bound_m[0][POSE_WALL_PART_BEND], wall.distance_bound_m[1][POSE_WALL_PART_BEND]);
}

TEST(MeasureWall, WithinABandThatIsOnePlaneNothingLeavesIt) {
  for (const double rough_m : {0.0, 0.03}) {
    for (const double height_m : {0.5, 1.3, 2.2}) {
      EXPECT_EQ(bend_m(measured(plain_wall, height_m, {rough_m})), 0.0) << rough_m << " at " << height_m;
    }
  }
}

TEST(MeasureWall, AboveTheBandTheLevelReachesToTheWallThatIsSeen) {
  EXPECT_NEAR(bend_m(measured(steps_in_above, 3.0)), 0.1, 0.01);
  EXPECT_LT(bend_m(measured(plain_wall, 3.0)), 0.01);
}

TEST(MeasureWall, AboveTheBandWhereNothingIsSeenItReachesAsFarAsAnArchComesIn) {
  EXPECT_NEAR(bend_m(measured(plain_wall, 3.6, {0.0, 0.3, 2.4})), 0.4, 0.01);
}

TEST(MeasureWall, BelowTheBandNothingIsAsked) {
  EXPECT_EQ(bend_m(measured(plain_wall, 0.05)), 0.0);
}

TEST(MeasureWall, WhereTheTopWasCutOffTheLevelReachesToIt) {
  EXPECT_GT(bend_m(measured(arched_wall, 2.3)), 0.6 * arched_wall(2.3 + kFloorZ_m));
  EXPECT_LT(bend_m(measured(arched_wall, 1.2)), 0.02);
}

// Two thirds of straight walls are within a standard deviation of their curvature.
TEST(MeasureWall, AStraightWallIsToldFromOneThatBendsOverItsHeight) {
  int straight = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    straight += measured(plain_wall, 1.3, {0.03, 0.3, 3.2, 0.1, seed}).straight ? 1 : 0;
    EXPECT_FALSE(measured(hollow, 1.3, {0.03, 0.3, 3.2, 0.1, seed}).straight) << seed;
  }
  EXPECT_GE(straight, 8);
}

}  // namespace
}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: where a ramp rises or falls before the machine and most of what is seen is the ramp, the levels reach to the
// flat floor that it stands on, whichever way it looks; where it stands on the ramp they need not; a floor below a
// table as long as the road is told of as well. What lies beside a floor that is seen to all sides, a ramp or heap
// further on, costs nothing. Does not prove what share of a floor must be seen: next to nothing of it is too little.

#include "stages/ground_beside.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/ground_fixture.hpp"

namespace pose_wall {
namespace {

using test::GroundFixture;

// Flat ground behind, and a ramp from a line ahead of the machine on, as seen by a sensor that looks far.
struct Ramp {
  double from_m, slope_rad;
  double flat_from_m, flat_to_m;  // where the flat ground is seen
  double ramp_to_m = 13.0;
  double heading_rad = 0.0;

  double height_at(double x_m) const { return x_m > from_m ? std::tan(slope_rad) * (x_m - from_m) : 0.0; }
  FloorResult floor() const {
    GroundFixture g;
    test::Noise noise(3);
    for (double x = flat_from_m; x <= ramp_to_m; x += 0.1) {
      if (x > flat_to_m && x < from_m) continue;
      for (double y = -2.0; y <= 2.0; y += 0.1) {
        const double c = std::cos(heading_rad), s = std::sin(heading_rad);
        g.add(c * x - s * y, s * x + c * y, height_at(x) + noise.normal(0.005));
      }
    }
    return g.floor();
  }
};

bool is_ambiguous(const FloorResult& f) {
  return (f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS) != 0;
}

TEST(GroundBeside, BeforeARampTheLevelsReachToTheFlatFloor) {
  for (const double slope_rad : {0.12, 0.2, -0.12, -0.2}) {
    for (const double heading_rad : {0.0, 0.8, 1.57, 3.0}) {
      SCOPED_TRACE(::testing::Message() << slope_rad << " seen from " << heading_rad);
      const FloorResult f = Ramp{2.5, slope_rad, -9.0, -5.5, 13.0, heading_rad}.floor();
      if (f.fit.refused) {
        EXPECT_LT(slope_rad, 0.0) << "a ramp that falls lies below the flat floor, which may be refused for it";
        continue;
      }
      ASSERT_GT(tilt_of_up(f.fit.plane.n), 0.1) << "the ramp shows more";
      const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
      EXPECT_TRUE(is_ambiguous(f));
      EXPECT_GE(f.roll_bound_rad, std::fabs(angles.roll_rad));
      EXPECT_GE(f.pitch_bound_rad, std::fabs(angles.pitch_rad));
    }
  }
}

TEST(GroundBeside, OnTheRampTheFlatFloorBehindIsNone) {
  for (const double slope_rad : {0.12, -0.12}) {
    const FloorResult f = Ramp{-5.0, slope_rad, -9.0, -5.5}.floor();
    ASSERT_TRUE(f.fit.found && !f.fit.refused);
    EXPECT_NEAR(std::fabs(roll_pitch_of_up(f.fit.plane.n).pitch_rad), std::fabs(slope_rad), 0.01);
    EXPECT_FALSE(is_ambiguous(f)) << slope_rad;
    EXPECT_LT(std::max(f.roll_bound_rad, f.pitch_bound_rad), 0.03) << slope_rad;
  }
}

TEST(GroundBeside, AFloorToAllSidesIsNotDoubtedForARampFurtherOn) {
  const FloorResult f = Ramp{5.0, 0.2, -13.0, 5.0, 9.0}.floor();
  ASSERT_TRUE(f.fit.found && !f.fit.refused);
  EXPECT_LT(tilt_of_up(f.fit.plane.n), 0.01);
  EXPECT_FALSE(is_ambiguous(f));
  EXPECT_LT(std::max(f.roll_bound_rad, f.pitch_bound_rad), 0.03);
}

// A belt beside the machine, as high as a table, that shows more than the floor beyond it.
TEST(GroundBeside, AFloorBelowABeltIsInTheLevels) {
  constexpr double kCrossFall = 0.03, kBelt_m = 0.8;
  GroundFixture g;
  test::Noise noise(5);
  for (double x = -9.0; x <= 9.0; x += 0.1) {
    for (double y = 1.0; y <= 2.5; y += 0.1) g.add(x, y, kBelt_m + noise.normal(0.005));
    for (double y = -2.4; y <= -1.6 && std::fabs(x) > 5.0; y += 0.1) g.add(x, y, kCrossFall * y + noise.normal(0.005));
  }
  const FloorResult f = g.floor();
  ASSERT_TRUE(f.fit.found);
  if (f.fit.refused) return;  // better still
  const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
  const double roll_rad = roll_pitch_of_up(Eigen::Vector3d(0.0, -kCrossFall, 1.0).normalized()).roll_rad;
  EXPECT_LE(std::fabs(angles.roll_rad - roll_rad), 5.0 * f.roll_sigma_rad + f.roll_bound_rad);
}

}  // namespace
}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a surface that steps out of its plane or back at a place is seen to, as far as it does, wherever the step
// begins within half a metre, also where only few points lie in a slice or none in some; posts, a pipe from end to end,
// noise and a step beside the place are none. What takes all elevations before the plane stands out though the plane is
// seen behind it; what is lower, narrower or has gaps does not. How long a hole around the place is, and that one
// without an end is the longest. Does not prove what a step is.

#include "engine/walls/sample/step_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/rock.hpp"

namespace pose_wall {
namespace {

constexpr double kStep_m = 0.05;

using Surface = std::function<double(double beside, double height)>;

// From a sensor 1 m high, 2 m away.
double elevation_of(double height) {
  return (height - 1.0) / 2.0;
}

StepProfile profile_of(const Surface& surface, double apart_m = 0.02, double noise_m = 0.012) {
  test::Noise noise(7);
  StepProfile profile(kStep_m);
  for (double beside = -1.5; beside < 1.5; beside += apart_m) {
    for (double height = 0.3; height < 2.2; height += 0.1) {
      profile.add(beside + noise.uniform(-0.5 * apart_m, 0.5 * apart_m),
                  surface(beside, height) + noise.normal(noise_m), elevation_of(height));
    }
  }
  return profile;
}

Surface step(double from_m, double to_m, double by_m) {
  return [=](double beside, double) { return beside >= from_m && beside < to_m ? by_m : 0.0; };
}

TEST(StepProfile, AStepAtThePlaceIsAsDeepAsItIs) {
  for (const double length_m : {0.4, 0.5, 0.75, 1.0}) {
    for (const double by_m : {0.1, 0.12, 0.4}) {
      for (double from_m = -length_m + 0.03; from_m < 0.0; from_m += 0.05) {
        const double to_m = from_m + length_m;
        const StepProfile out = profile_of(step(from_m, to_m, by_m)), back = profile_of(step(from_m, to_m, -by_m));
        EXPECT_NEAR(out.before_m(), by_m, 0.01) << length_m << " m from " << from_m;
        EXPECT_EQ(out.behind_m(), 0.0);
        EXPECT_NEAR(back.behind_m(), by_m, 0.01) << length_m << " m from " << from_m;
        EXPECT_EQ(back.before_m(), 0.0);
      }
    }
  }
}

TEST(StepProfile, ASparseSensorSeesItToo) {
  EXPECT_NEAR(profile_of(step(-0.3, 0.3, 0.12), 0.11).before_m(), 0.12, 0.01);
}

TEST(StepProfile, BesideThePlaceThereIsNone) {
  EXPECT_EQ(profile_of(step(0.2, 0.9, 0.3)).before_m(), 0.0);
  EXPECT_EQ(profile_of(step(-0.9, -0.2, -0.3)).behind_m(), 0.0);
}

TEST(StepProfile, AFlatOrNoisyWallHasNone) {
  for (const double noise_m : {0.0, 0.03, 0.06}) {
    const StepProfile profile = profile_of(step(0.0, 0.0, 0.0), 0.02, noise_m);
    EXPECT_EQ(profile.before_m(), 0.0) << noise_m;
    EXPECT_EQ(profile.behind_m(), 0.0) << noise_m;
  }
}

TEST(StepProfile, APostIsNone) {
  EXPECT_EQ(profile_of(step(-0.1, 0.1, 0.3)).before_m(), 0.0);
}

TEST(StepProfile, PipesBeforeAWallThatIsSeenAboveThemAreNone) {
  EXPECT_EQ(profile_of([](double, double height) { return height < 1.5 ? 0.3 : 0.0; }).before_m(), 0.0);
}

// A plane that is seen everywhere, and something by_m before it where `takes` says so.
StepProfile past(const std::function<bool(double beside, double height)>& takes, double by_m) {
  StepProfile profile = profile_of(step(0.0, 0.0, 0.0));
  for (double beside = -1.5; beside < 1.5; beside += 0.02) {
    for (double height = 0.3; height < 2.2; height += 0.05) {
      if (takes(beside, height)) profile.add(beside, by_m, elevation_of(height));
    }
  }
  return profile;
}

TEST(StepProfile, WhatTakesAllElevationsStandsOutThoughThePlaneIsSeenBehindIt) {
  for (const double by_m : {0.5, 1.5, 3.5}) {
    for (const double from_m : {-0.85, -0.45, -0.05}) {
      const auto piece = [from_m](double beside, double) { return beside > from_m && beside < from_m + 0.9; };
      EXPECT_GE(past(piece, by_m).before_m(), by_m) << from_m;
      EXPECT_LE(past(piece, by_m).before_m(), by_m + 0.3) << from_m;
      EXPECT_EQ(past(piece, by_m).behind_m(), 0.0);
    }
  }
  EXPECT_GE(past([](double, double) { return true; }, 1.0).before_m(), 1.0) << "from end to end";
  EXPECT_GE(past([](double, double height) { return height < 2.0; }, 1.0).before_m(), 1.0) << "all but a little";
}

TEST(StepProfile, WhatThePlaneIsSeenOverOrBesideHidesNothing) {
  const auto piece = [](double beside) { return std::fabs(beside) < 0.5; };
  EXPECT_EQ(past([&](double beside, double height) { return piece(beside) && height < 1.4; }, 1.0).before_m(), 0.0)
      << "low";
  EXPECT_EQ(past([&](double beside, double height) { return piece(beside) && height > 1.0; }, 1.0).before_m(), 0.0)
      << "hung";
  EXPECT_EQ(past([](double, double height) { return std::fmod(height, 0.5) < 0.25; }, 0.5).before_m(), 0.0) << "pipes";
  EXPECT_EQ(past([](double beside, double) { return std::fabs(beside) < 0.15; }, 1.0).before_m(), 0.0) << "a post";
  EXPECT_EQ(past([](double beside, double) { return beside > 0.2; }, 1.0).before_m(), 0.0) << "beside the place";
  EXPECT_EQ(past([&](double beside, double) { return piece(beside); }, 0.3).before_m(), 0.0) << "as near as pipes are";
  StepProfile dust = profile_of(step(0.0, 0.0, 0.0), 0.01);
  test::Noise noise(3);
  for (int k = 0; k < 2000; ++k) {
    dust.add(noise.uniform(-1.0, 1.0), noise.uniform(0.1, 4.0), elevation_of(noise.uniform(0.3, 2.2)));
  }
  EXPECT_EQ(dust.before_m(), 0.0) << "dust";
  StepProfile thin = profile_of(step(0.0, 0.0, 0.0), 0.002);
  for (double height = 0.3; height < 2.2; height += 0.02) {
    for (double beside = -1.0; beside < 1.0; beside += 0.1) thin.add(beside, 1.0, elevation_of(height));
  }
  EXPECT_EQ(thin.before_m(), 0.0) << "a curtain of drops";
}

// seen: where the plane is, along the road.
StepProfile seen_where(const std::function<bool(double)>& seen) {
  StepProfile profile(kStep_m);
  for (double beside = -1.2; beside < 1.2; beside += 0.02) {
    if (seen(beside)) profile.add(beside, 0.01, 0.0);
  }
  return profile;
}

TEST(StepProfile, AHoleIsAsLongAsThePlaneIsSeenNowhereAroundThePlace) {
  EXPECT_EQ(seen_where([](double) { return true; }).hole_m(), 0.0);
  for (const double length_m : {0.3, 0.6, 1.0}) {
    for (const double from_m : {-0.9 * length_m, -0.5 * length_m, -0.1 * length_m}) {
      const StepProfile hole = seen_where([&](double at) { return at < from_m || at > from_m + length_m; });
      EXPECT_NEAR(hole.hole_m(), length_m, 0.11) << from_m;
    }
  }
  EXPECT_EQ(seen_where([](double at) { return at < 0.2 || at > 0.8; }).hole_m(), 0.0) << "beside the place";
}

TEST(StepProfile, AStrayPointEndsNoHole) {
  StepProfile profile = seen_where([](double at) { return at < -0.2; });
  profile.add(0.3, 0.0, 0.0);
  EXPECT_EQ(profile.hole_m(), 2.0 * StepProfile::kHalf_m);
}

TEST(StepProfile, WhereThePlaneIsSeenToOneSideOnlyTheHoleHasNoEnd) {
  constexpr double kAll_m = 2.0 * StepProfile::kHalf_m;
  EXPECT_EQ(seen_where([](double at) { return at < -0.1; }).hole_m(), kAll_m);
  EXPECT_EQ(seen_where([](double at) { return at > 0.06; }).hole_m(), kAll_m);
  EXPECT_EQ(seen_where([](double) { return false; }).hole_m(), kAll_m);
  EXPECT_EQ(profile_of(step(-1.5, 1.5, 0.3)).hole_m(), kAll_m) << "something before it";
}

TEST(StepProfile, WithoutPointsThereIsNone) {
  const StepProfile nothing(kStep_m);
  EXPECT_EQ(nothing.before_m(), 0.0);
  StepProfile few(kStep_m);
  for (int k = 0; k < 9; ++k) few.add(-0.25 + 0.06 * k, 0.2, 0.0);
  EXPECT_EQ(few.before_m(), 0.0);
  few.add(0.3, 0.2, 0.0);
  EXPECT_NEAR(few.before_m(), 0.2, 1e-12);
}

}  // namespace
}  // namespace pose_wall

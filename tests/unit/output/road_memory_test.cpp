// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, on drawn looks whose errors are known: a level with memory is never wider than the look's own and holds the
// error. Where the machine stands noise averages and rock does not. Where it drives the rock averages as well. Drift,
// places and ways widen the level. A look that contradicts the memory stands alone, and three of them end it. Does not
// prove how quickly real rock is new: the scenarios do.

#include "engine/output/road_memory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/estimation/protection.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kOf = POSE_WALL_ROLL;
constexpr double kDof = 1e9;           // so many that no level is stretched
constexpr double kDofRounding = 1e-9;  // what is left of the stretch by 1e9 degrees of freedom
constexpr double kRock_m = 3.0;        // after which rock is new

Measurement look(double value, double sigma, double bias = 0.0, double dof = kDof) {
  Measurement m;
  m.measured = true;
  m.raw = value;
  m.sigma = sigma;
  m.dof = dof;
  const Settings s = test::settings_with();
  m.protection[POSE_WALL_PART_RANDOM] = protection_factor(s.protection_sigmas, dof) * sigma;
  m.protection[POSE_WALL_PART_RANGE_BIAS] = bias;
  return m;
}

Change step(double way_m) {
  Change c;
  c.by_odometry = true;
  for (bool& known : c.by_places) known = true;
  for (double& share : c.new_rock) share = 1.0 - std::exp(-way_m / kRock_m);
  return c;
}

class Remembering {
 public:
  explicit Remembering(std::uint32_t quantity = kOf) : of(quantity) {}
  Recalled first(const Measurement& m) { return next(Change{}, m); }
  Recalled next(const Change& change, const Measurement& m) {
    carry_on(change, of, settings, &memory);
    const Recalled now = look_again(m, last_raw + change.carry[of], change, of, settings, &memory);
    last_raw = m.raw;
    return now;
  }

  std::uint32_t of;
  double last_raw = 0.0;
  Settings settings = test::settings_with();
  RoadMemory memory;
};

// Of many roads after so many steps: the mean square of a value's error over the variance that its level tells, and the
// mean level over a look's. And the share of all frames whose error is beyond three deviations. Of each look's variance
// `noise` is its own and the rest is rock.
struct Judged {
  double z2 = 0.0, narrower = 0.0, beyond_three = 0.0;
};

Judged judged(int steps, double way_m, double noise, double rock_length_m) {
  constexpr int kRoads = 1500;  // z² of so many is known to within 4 %: a normal's has a variance of 2
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  const double stays = std::exp(-way_m / rock_length_m), sigma = 0.01;
  Judged out;
  for (int road = 0; road < kRoads; ++road) {
    Remembering r;
    double rock = normal(random), error = 0.0, level = 0.0;
    for (int k = 0; k <= steps; ++k) {
      if (k > 0) rock = stays * rock + std::sqrt(1.0 - stays * stays) * normal(random);
      const double off = sigma * (std::sqrt(1.0 - noise) * rock + std::sqrt(noise) * normal(random));
      const Measurement m = look(2.0 + off, sigma);
      const Recalled now = k == 0 ? r.first(m) : r.next(step(way_m), m);
      EXPECT_LE(now.protection.sum(), m.protection.sum());
      error = now.value - 2.0;
      level = now.protection.sum();
      const bool beyond = std::fabs(error) > 3.0 / r.settings.protection_sigmas * level;
      if (beyond) out.beyond_three += 1.0 / kRoads / (steps + 1.0);
    }
    const double told = level / r.settings.protection_sigmas;
    out.z2 += error * error / (told * told) / kRoads;
    out.narrower += told / sigma / kRoads;
  }
  return out;
}

TEST(RoadMemory, TheFirstLookStandsAsItIs) {
  Remembering r;
  const Measurement m = look(2.0, 0.01, 0.02);
  const Recalled now = r.first(m);
  EXPECT_EQ(now.value, m.raw);
  EXPECT_EQ(now.protection.sum(), m.protection.sum());
}

// z2 of 1,500 roads scatters by sqrt(2 / 1500) = 0.04; a value by the narrower of two levels is no normal number, so
// one more twentieth.
constexpr double kZ2Most = 1.17;
// Of normal errors 0.0027 are beyond three deviations. Roads differ by a third of that, as frames of one road err
// alike.
constexpr double kBeyondThreeMost = 0.0040;

TEST(RoadMemory, StandingAveragesNoise) {
  const Judged j = judged(50, 0.0, 0.5, 3.0);
  EXPECT_LT(j.narrower, 0.85) << "rock alone: 0.71";
  EXPECT_GT(j.narrower, 0.70) << "no average removes the rock";
  EXPECT_LT(j.z2, kZ2Most);
  EXPECT_LT(j.beyond_three, kBeyondThreeMost);
}

TEST(RoadMemory, StandingAveragesNoRock) {
  const Judged j = judged(50, 0.0, 0.0, 3.0);
  EXPECT_NEAR(j.narrower, 1.0, 0.02);
  EXPECT_LT(j.z2, kZ2Most);
}

TEST(RoadMemory, DrivingAveragesRock) {
  const Judged j = judged(100, 0.1, 0.0, 3.0);
  EXPECT_LT(j.narrower, 0.75) << "10 m are 2.7 looks at other rock: 0.61 with the best weights of all";
  EXPECT_LT(j.z2, kZ2Most);
  EXPECT_LT(j.beyond_three, kBeyondThreeMost);
}

TEST(RoadMemory, RockThatIsNewSoonerDoesNoHarm) {
  const Judged j = judged(100, 0.1, 0.0, 0.5);
  EXPECT_LT(j.narrower, 0.75);
  EXPECT_LT(j.z2, kZ2Most);
  EXPECT_LT(j.beyond_three, kBeyondThreeMost);
}

TEST(RoadMemory, WhatAllLooksShareStays) {
  Remembering r;
  r.first(look(2.0, 0.01, 0.03));
  Recalled now{};
  for (int k = 0; k < 100; ++k) now = r.next(step(0.1), look(2.0, 0.01, 0.03));
  EXPECT_NEAR(now.protection[POSE_WALL_PART_RANGE_BIAS], 0.03, 1e-12);
}

TEST(RoadMemory, FewPiecesAreMoreOnceTheRockIsNew) {
  constexpr double kFew = 8.0;  // degrees of freedom: so few that Student's t stretches a level
  Remembering r;
  const double alone = r.first(look(2.0, 0.01, 0.0, kFew)).protection.sum();
  double standing = alone, driving = alone;
  for (int k = 0; k < 20; ++k) standing = r.next(step(0.0), look(2.0, 0.01, 0.0, kFew)).protection.sum();
  EXPECT_NEAR(standing, alone, 1e-9) << "the same pieces again";
  for (int k = 0; k < 100; ++k) driving = r.next(step(0.1), look(2.0, 0.01, 0.0, kFew)).protection.sum();
  const double k = r.settings.protection_sigmas;
  EXPECT_LT(driving, alone * protection_factor(k, 3.0 * kFew) / protection_factor(k, kFew)) << "at least three looks";
}

TEST(RoadMemory, AReadingThatTheRoadBehindExcludesDoesNotCount) {
  Remembering r;
  const double alone = r.first(look(2.0, 0.01)).protection.sum();
  Measurement doubtful = look(2.005, 0.01);
  doubtful.protection[POSE_WALL_PART_RIVAL] = 0.5;
  Recalled now{};
  for (int k = 0; k < 10; ++k) now = r.next(step(0.1), doubtful);
  EXPECT_LT(now.protection.sum(), 1.3 * alone);
}

TEST(RoadMemory, WhatTheOdometryDoesNotKnowWidens) {
  const auto level_after = [](const Change& change) {
    Remembering r;
    r.first(look(2.0, 0.01));
    Measurement doubtful = look(2.0, 0.01);
    doubtful.protection[POSE_WALL_PART_RIVAL] = 0.5;
    return r.next(change, doubtful).protection.sum();
  };
  const double k = Remembering().settings.protection_sigmas, random = k * 0.01, still = level_after(step(0.0));
  EXPECT_NEAR(still, random, kDofRounding);
  Change drift = step(0.0), place = step(0.0), way = step(0.0), bound = step(0.0);
  drift.drift2[kOf] = 0.03 * 0.03;
  place.place_level_before[kOf] = place.place_level[kOf] = 0.03;
  way.growth[kOf] = way.by_way[kOf] = 0.03;
  bound.growth[kOf] = 0.03;
  const auto together = [random](double more2) { return std::sqrt(random * random + more2); };
  EXPECT_NEAR(level_after(drift), together(0.03 * 0.03), kDofRounding);
  EXPECT_NEAR(level_after(place), together(2.0 * 0.03 * 0.03), kDofRounding);
  EXPECT_NEAR(level_after(way), together(0.03 * 0.03), kDofRounding);
  EXPECT_NEAR(level_after(bound), random + 0.03, kDofRounding) << "a bound is no variance";
}

TEST(RoadMemory, ALookThatContradictsStandsAloneAndThreeOfThemAreTheRoad) {
  Remembering r;
  r.first(look(2.0, 0.01));
  for (int k = 0; k < 10; ++k) r.next(step(0.1), look(2.0, 0.01));
  const Measurement other = look(2.2, 0.01, 0.5);
  for (int k = 0; k < 3; ++k) {
    const Recalled now = r.next(step(0.1), other);
    EXPECT_EQ(now.value, other.raw);
    EXPECT_EQ(now.protection.sum(), other.protection.sum());
  }
  const Recalled after = r.next(step(0.1), look(2.2, 0.01));
  EXPECT_NEAR(after.value, 2.2, 1e-9);
}

TEST(RoadMemory, AFlickerDoesNotEndIt) {
  Remembering r;
  r.first(look(2.0, 0.01));
  r.next(step(0.1), look(2.2, 0.01, 0.5));
  r.next(step(0.1), look(2.2, 0.01, 0.5));
  Measurement doubtful = look(2.0, 0.01, 0.5);
  const Recalled now = r.next(step(0.1), doubtful);
  EXPECT_LT(now.protection.sum(), 0.2) << "thrice a look, for a while, and not the half metre of this one";
}

TEST(RoadMemory, NoMemoryMakesARoadStraightThatBends) {
  for (const std::uint32_t of : {POSE_WALL_ROLL, POSE_WALL_YAW, POSE_WALL_D_RB}) {
    Remembering r(of);
    r.first(look(2.0, 0.01));
    Measurement bends = look(2.0, 0.01);
    bends.protection[POSE_WALL_PART_BEND] = 0.5;
    const double whole = r.next(step(0.1), bends).protection[POSE_WALL_PART_BEND];
    EXPECT_EQ(whole, 0.5);
    bends.protection[POSE_WALL_PART_BEND] = 0.0;
    bends.protection[POSE_WALL_PART_RIVAL] = 0.5;
    const double rival = r.next(step(0.1), bends).protection[POSE_WALL_PART_RIVAL];
    EXPECT_EQ(rival == 0.5, of != POSE_WALL_ROLL) << "the machine stands on ground that it saw before itself";
  }
}

TEST(RoadMemory, ALookWithoutAnyErrorIsNotRemembered) {
  Remembering r;
  r.first(look(2.0, 0.0));
  const Recalled now = r.next(step(0.1), look(2.0, 0.01));
  EXPECT_EQ(now.value, 2.0);
  EXPECT_TRUE(std::isfinite(r.next(step(0.1), look(2.0, 0.01)).protection.sum()));
}

TEST(RoadMemory, WithoutAPlaceNothingIsRemembered) {
  Remembering r;
  r.first(look(2.0, 0.001));
  Change lost = step(0.1);
  lost.by_places[kOf] = false;
  const Measurement m = look(2.1, 0.01, 0.2);
  const Recalled now = r.next(lost, m);
  EXPECT_EQ(now.value, m.raw);
  EXPECT_EQ(now.protection.sum(), m.protection.sum());
}

}  // namespace
}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: pipes one above the other are grooved, touching or with a little of nothing between, as thick as an arm or as
// a man; rough rock, a wall that leans, bends or steps once, pipes before a wall that is seen between them and steel
// sets are not. Residuals come from the plane that fits. Does not prove that pipes which hide each other's grooves are
// found.

#include "engine/walls/fit/groove_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/rock.hpp"

namespace pose_wall {
namespace {

constexpr double kLow_m = 0.3, kHigh_m = 2.2, kHalfLength_m = 8.0;

using Surface = std::function<double(double u, double z)>;

void add(GrooveProfile* profile, double u_m, double z_m, double residual_m) {
  profile->add(all_four(static_cast<float>(u_m)), all_four(static_cast<float>(z_m)),
               all_four(static_cast<float>(residual_m)), first_of_four(1));
}

bool is_grooved(const Surface& surface, double noise_m = 0.012, double half_length_m = kHalfLength_m) {
  test::Noise noise(3);
  GrooveProfile profile(kLow_m, kHigh_m, 0.0);
  for (double u = -half_length_m; u < half_length_m; u += 0.06) {
    for (double z = kLow_m + 0.01; z < kHigh_m; z += 0.04) add(&profile, u, z, surface(u, z) + noise.normal(noise_m));
  }
  return profile.is_grooved();
}

// Fronts of round pipes, the plane in their middle depth.
Surface pipes(double radius_m, double pitch_m) {
  return [=](double, double z) {
    const double off = z - pitch_m * std::round(z / pitch_m);
    const double front = std::fabs(off) < radius_m ? std::sqrt(radius_m * radius_m - off * off) : 0.0;
    return front - 0.8 * radius_m;
  };
}

TEST(GrooveProfile, PipesOneAboveTheOtherAreGrooved) {
  for (const double radius_m : {0.15, 0.2, 0.25, 0.3}) {
    for (const double gap : {1.0, 1.1, 1.25}) {
      EXPECT_TRUE(is_grooved(pipes(radius_m, 2.0 * radius_m * gap))) << radius_m << " " << gap;
      EXPECT_TRUE(is_grooved(pipes(radius_m, 2.0 * radius_m * gap), 0.03)) << radius_m << " " << gap << " noisy";
    }
  }
}

TEST(GrooveProfile, TwoPipesHaveOneGrooveOnly) {
  EXPECT_FALSE(is_grooved([](double, double z) { return std::fabs(z - 1.2) < 0.15 ? -0.12 : 0.02; }));
}

TEST(GrooveProfile, RockIsNot) {
  for (const double sigma_m : {0.02, 0.05, 0.08}) {
    for (const double length_m : {0.1, 0.3, 0.6, 1.0}) {
      for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        test::Noise noise(seed);
        const test::Rock rock(sigma_m, length_m, &noise);
        for (const double half_length_m : {2.5, 8.0}) {
          EXPECT_FALSE(is_grooved([&](double u, double z) { return rock.at(u, z); }, 0.012, half_length_m))
              << sigma_m << " over " << length_m << ", seed " << seed << ", to " << half_length_m;
        }
      }
    }
  }
}

TEST(GrooveProfile, WallsThatLeanBendOrStepOnceAreNot) {
  EXPECT_FALSE(is_grooved([](double, double) { return 0.0; }));
  EXPECT_FALSE(is_grooved([](double, double z) { return 0.1 * (z - 1.25); }));
  EXPECT_FALSE(is_grooved([](double, double z) { return 0.2 * (z - 1.25) * (z - 1.25) - 0.05; }));
  EXPECT_FALSE(is_grooved([](double, double z) { return -0.2 * (z - 1.25) * (z - 1.25) + 0.05; }));
  EXPECT_FALSE(is_grooved([](double, double z) { return z < 1.0 ? 0.08 : -0.06; }));
}

TEST(GrooveProfile, WallsSeenBetweenWhatStandsBeforeThemAreNot) {
  EXPECT_FALSE(is_grooved([](double, double z) { return std::fmod(z, 0.5) < 0.15 ? 0.12 : -0.01; })) << "pipes";
  EXPECT_FALSE(is_grooved([](double u, double) { return std::fabs(u - std::round(u)) < 0.08 ? 0.12 : -0.01; }))
      << "steel sets";
}

// What does not count stands far out everywhere, and would hide the grooves.
TEST(GrooveProfile, FourPointsCountAsEachByItself) {
  const Surface surface = pipes(0.2, 0.4);
  for (const std::uint32_t lanes : {1U, 2U, 3U, 4U}) {
    test::Noise noise(7);
    GrooveProfile profile(kLow_m, kHigh_m, 0.0);
    for (int i = 0; i < 16000; ++i) {
      FourFloats u{}, z{}, residual{};
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        const double at_u = noise.uniform(-kHalfLength_m, kHalfLength_m), at_z = noise.uniform(kLow_m, kHigh_m);
        u[lane] = static_cast<float>(at_u);
        z[lane] = static_cast<float>(at_z);
        residual[lane] = lane < lanes ? static_cast<float>(surface(at_u, at_z)) : 1.0F;
      }
      profile.add(u, z, residual, first_of_four(lanes));
    }
    EXPECT_TRUE(profile.is_grooved()) << lanes;
  }
}

TEST(GrooveProfile, LittleSeenTellsNothing) {
  EXPECT_FALSE(is_grooved(pipes(0.2, 0.4), 0.012, 0.9)) << "two metres of length";
  GrooveProfile empty(kLow_m, kHigh_m, 0.0);
  EXPECT_FALSE(empty.is_grooved());
  for (const double wild : {-1e30, 1e30, std::nan("")}) {
    add(&empty, wild, 1.0, 0.0);
    add(&empty, 0.0, wild, 0.0);
  }
  EXPECT_FALSE(empty.is_grooved());
}

}  // namespace
}  // namespace pose_wall

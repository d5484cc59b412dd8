// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: on roads, sensors and truths of a second simulator, written from the specification alone, the engine has the
// same idea of axes, signs and lengths; no value that it gives is off by more than its level; enough values are valid.
// Each failure names the road's seed and the command that replays it.

#include <gtest/gtest.h>

#include <array>

#include "judge/court.hpp"

namespace pose_wall::judge {
namespace {

void expect_within_levels(const Verdict& verdict) {
  for (const Finding& finding : verdict.findings) {
    EXPECT_FALSE(finding.misleading()) << "misleading: " << verdict.text(finding);
    EXPECT_FALSE(finding.beyond()) << "beyond its level: " << verdict.text(finding);
    EXPECT_FALSE(finding.raw_beyond()) << "raw beyond its level: " << verdict.text(finding);
  }
}

using Shares = std::array<double, POSE_WALL_QUANTITIES>;

void expect_valid(const Tallies& tallies, const Shares& floors) {
  for (std::size_t q = 0; q < tallies.size(); ++q) {
    EXPECT_GE(tallies[q].share_valid(), floors.at(q)) << pose_wall_quantity_name(static_cast<std::uint32_t>(q));
  }
}

// Smooth rock that tilts and leans, ranges without a constant error: nothing but noise is left. 2 cm of it over the
// root of 150 points (the fewest that the configs take) are 1.6 mm, twice that at 2 m from the middle of 8 m of wall,
// or 0.05 degrees over 4 m of floor; three such are allowed. A convention that differs shows as degrees and decimetres.
TEST(Judge, AgreesWithTheEngineAboutAxesSignsAndLengths) {
  constexpr double kAngle_rad = 0.15 * kRadPerDeg, kDistance_m = 0.01;
  int measured = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    Case tried;
    tried.seed = seed;
    tried.sensor = static_cast<int>(seed % kSensors);
    tried.quiet = tried.no_bias = true;
    tried.frames = 1;
    const Verdict verdict = hear(tried);
    for (const Finding& finding : verdict.findings) {
      ++all;
      if (finding.raw_state == POSE_WALL_INVALID) continue;
      ++measured;
      EXPECT_LE(finding.raw_error_abs(), finding.quantity < POSE_WALL_D_LF ? kAngle_rad : kDistance_m)
          << verdict.text(finding);
    }
  }
  EXPECT_GE(measured, all * 8 / 10);
}

TEST(Judge, NoValueOfRandomRoadsIsBeyondItsLevelAndEnoughAreValid) {
  constexpr std::uint64_t kFirst = 20261126, kRoads = 96;
  Tallies tallies;
  for (std::uint64_t seed = kFirst; seed < kFirst + kRoads; ++seed) {
    Case tried;
    tried.seed = seed;
    const Verdict verdict = hear(tried);
    add(&tallies, verdict);
    expect_within_levels(verdict);
  }
  expect_valid(tallies, Shares{});
  if (HasFailure()) std::printf("%s\n%s", table(tallies).c_str(), reasons_table(tallies).c_str());
}

// Whole flat walls, and a sensor that sees them well: nothing is there to be seen through.
TEST(Judge, DirectionsAtRandomSeeWholeFlatWallsAsWhole) {
  constexpr std::uint64_t kRoads = 24;
  Tallies tallies;
  for (std::uint64_t seed = 1; seed <= kRoads; ++seed) {
    Case tried;
    tried.seed = seed;
    tried.sensor = kRandomDown;
    tried.quiet = true;
    const Verdict verdict = hear(tried);
    add(&tallies, verdict);
    expect_within_levels(verdict);
  }
  expect_valid(tallies, Shares{});
  if (HasFailure()) std::printf("%s\n%s", table(tallies).c_str(), reasons_table(tallies).c_str());
}

}  // namespace
}  // namespace pose_wall::judge

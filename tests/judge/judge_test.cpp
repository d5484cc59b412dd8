// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: on roads, sensors and truths of a second simulator, written from the specification alone, the engine has the
// same idea of axes, signs and lengths; no value that it gives is off by more than its level; enough values are valid.
// Each failure names the road's seed and the command that replays it.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "judge/court.hpp"

namespace pose_wall::judge {
namespace {

// No valid value may be wrong. Returns how many others are: degraded and held ones that are beyond their level.
int expect_within_levels(const Verdict& verdict) {
  int others = 0;
  for (const Finding& finding : verdict.findings) {
    const bool beyond = finding.beyond() || finding.raw_beyond();
    EXPECT_FALSE(finding.misleading()) << "misleading: " << verdict.text(finding);
    EXPECT_FALSE(beyond && finding.state == POSE_WALL_VALID) << "beyond its level: " << verdict.text(finding);
    if (!beyond || finding.state == POSE_WALL_VALID) continue;
    ++others;
    std::printf("beyond its level: %s\n", verdict.text(finding).c_str());
  }
  return others;
}

using Shares = std::array<double, POSE_WALL_QUANTITIES>;

void expect_valid(const Tallies& tallies, const Shares& floors) {
  for (std::size_t q = 0; q < tallies.size(); ++q) {
    EXPECT_GE(tallies[q].share_valid(), floors.at(q)) << pose_wall_quantity_name(static_cast<std::uint32_t>(q));
  }
}

// Smooth rock that tilts and leans, ranges without a constant error: nothing but noise is left. 2 cm of it over the
// root of 150 points (the fewest that the configs take) are 1.6 mm, and 3 mm at 2 m from the middle of 8 m of wall;
// three such are allowed. On a strip of floor 1.5 m wide they are 0.2 degrees. A convention that differs shows as
// degrees and decimetres.
TEST(Judge, AgreesWithTheEngineAboutAxesSignsAndLengths) {
  constexpr double kAngle_rad = 0.4 * kRadPerDeg, kDistance_m = 0.01;
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

// Shares of the same roads when these floors were set, in percent, in the order of the quantities:
//   65.4  65.1  77.3  80.5  83.9  81.2  83.3   the engine then
//   68.2  67.7  78.1  84.6  85.9  83.1  84.4   with levels by the waves that a wall's patches show
// A floor is two roads (2.1 points) below the smaller one.
constexpr Shares kRandomRoadsFloor = {0.633, 0.630, 0.752, 0.784, 0.818, 0.791, 0.812};
// Three are known: a sensor that sees no floor but that of a steep ramp ahead, on which the machine does not stand.
constexpr int kOthersBeyondMax = 3;

TEST(Judge, NoValidValueOfRandomRoadsIsBeyondItsLevelAndEnoughAreValid) {
  constexpr std::uint64_t kFirst = 20261126, kRoads = 96;
  Tallies tallies;
  int others_beyond = 0;
  for (std::uint64_t seed = kFirst; seed < kFirst + kRoads; ++seed) {
    Case tried;
    tried.seed = seed;
    const Verdict verdict = hear(tried);
    add(&tallies, verdict);
    others_beyond += expect_within_levels(verdict);
  }
  EXPECT_LE(others_beyond, kOthersBeyondMax);
  expect_valid(tallies, kRandomRoadsFloor);
  if (HasFailure()) std::printf("%s\n%s", table(tallies).c_str(), reasons_table(tallies).c_str());
}

// Whole flat walls, and a sensor that sees them well: nothing is there to be seen through. When these floors were set,
// yaw was valid in 83 %, distances in 73 to 86 %, with both engines above: silence that chance alone makes is taken for
// gaps. One road is 4.2 points. Raise the floors when that is mended.
constexpr Shares kCleanRoadsFloor = {0.95, 0.95, 0.79, 0.68, 0.68, 0.68, 0.68};

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
    EXPECT_EQ(expect_within_levels(verdict), 0);
  }
  expect_valid(tallies, kCleanRoadsFloor);
  if (HasFailure()) std::printf("%s\n%s", table(tallies).c_str(), reasons_table(tallies).c_str());
}

// Cases that are left: an upright sensor that sees no floor but that of a ramp ahead, and none of the ground on which
// the machine stands. Roll or pitch by the ramp is valid then, and wrong. The most values of a road that were; lower
// these numbers as the cases are mended, and never raise them.
struct Left {
  std::uint64_t seed;
  int wrong_most;
};
constexpr Left kRampsAhead[] = {{7000122, 2}, {7000963, 3}, {7001187, 7}, {7001456, 4}, {7001696, 1}};

TEST(Judge, RampsAheadOfUnseenGroundMisleadNoMoreThanTheyDid) {
  for (const Left& left : kRampsAhead) {
    Case tried;
    tried.seed = left.seed;
    int wrong = 0;
    std::string texts;
    const Verdict verdict = hear(tried);
    for (const Finding& finding : verdict.findings) {
      const bool is_wrong = finding.misleading() || finding.beyond() || finding.raw_beyond();
      if (finding.state != POSE_WALL_VALID || !is_wrong) continue;
      ++wrong;
      texts += "\n" + verdict.text(finding);
    }
    EXPECT_LE(wrong, left.wrong_most) << texts;
  }
}

}  // namespace
}  // namespace pose_wall::judge

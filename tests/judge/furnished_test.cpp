// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: on 60 furnished roads, driven and standing, with times and with the motion library beside the engine, no
// value is wrong, the budget ends no frame, and as much is valid as without motion and without a budget. Where the
// machine stands, motion makes no level worse from the second frame on.

#include "judge/furnished.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "judge/tally.hpp"

namespace pose_wall::judge {
namespace {

struct Share {
  double first, later;  // least, of frame 0 and of the others
};

// Later frames: the shares of the same clouds with motion off and work_max=2000000000, less one frame of 120 (0.8
// points), by `pose_wall_judge --furnished`: an engine with motion and its own budget has to be as good. Frame 0 knows
// no motion, and its level includes what motion_speed_max and motion_turn_max_deg allow: as with motion, less one road.
constexpr std::array<Share, POSE_WALL_QUANTITIES> kFurnishedFloor = {
    {{0.066, 0.475}, {0.066, 0.500}, {0.066, 0.592}, {0.066, 0.717}, {0.066, 0.675}, {0.066, 0.692}, {0.066, 0.700}}};
// Of frames that the budget may end: half a percent of the class, which is none of its 180.
constexpr double kLimitedMost = 0.005;
// Of a level with motion over the level without, standing.
constexpr double kRatioMost = 1.05;

void expect_nothing_wrong(const Verdict& verdict) {
  for (const Finding& finding : verdict.findings) {
    EXPECT_FALSE(finding.misleading()) << "misleading: " << verdict.text(finding);
    EXPECT_FALSE(finding.beyond() || finding.raw_beyond()) << "beyond its level: " << verdict.text(finding);
  }
}

void expect_as_much_valid(const Tallies& tallies) {
  for (std::size_t q = 0; q < tallies.size(); ++q) {
    const char* name = pose_wall_quantity_name(static_cast<std::uint32_t>(q));
    EXPECT_GE(tallies[q].share_valid_first(), kFurnishedFloor.at(q).first) << name << ", frame 0";
    EXPECT_GE(tallies[q].share_valid_later(), kFurnishedFloor.at(q).later) << name << ", later frames";
  }
}

// Levels with motion over those without, value by value, of roads on which the machine stands.
struct Standing {
  void add(const Verdict& with, const Verdict& without) {
    for (std::size_t k = 0; k < with.findings.size(); ++k) {
      const Finding &a = with.findings[k], &b = without.findings[k];
      if (a.frame == 0 || !b.measured_or_held()) continue;
      ++values;
      const double ratio = a.measured_or_held() ? a.level / b.level : HUGE_VAL;
      worst = std::max(worst, ratio);
      if (ratio <= kRatioMost) continue;
      ++worse;
      if (first_worse.empty()) first_worse = with.text(a);
    }
  }

  int values = 0, worse = 0;
  double worst = 0.0;
  std::string first_worse;
};

// One test, since the clouds take longest.
TEST(Furnished, NothingIsWrongTheBudgetEndsNoFrameEnoughIsValidAndMotionCostsNoLevelAtRest) {
  Tallies tallies;
  WorkTally work;
  Standing standing;
  for (int k = 0; k < kFurnishedRoads; ++k) {
    const Case tried = furnished_road(k);
    std::vector<Treatment> treatments = {{true, 0}};
    if (tried.going == Going::kStands) treatments.push_back({false, 0});
    const std::vector<Verdict> verdicts = hear(tried, treatments);
    expect_nothing_wrong(verdicts[0]);
    add(&tallies, verdicts[0]);
    work.add(verdicts[0]);
    if (verdicts.size() > 1) standing.add(verdicts[0], verdicts[1]);
  }
  EXPECT_LE(work.share_limited(), kLimitedMost) << work.text();
  expect_as_much_valid(tallies);
  EXPECT_GT(standing.values, 210);  // half of those of 30 roads in two later frames
  EXPECT_EQ(standing.worse, 0) << "of " << standing.values << " levels, the worst " << standing.worst
                               << " times as large as without motion; the first: " << standing.first_worse;
  if (HasFailure()) {
    std::printf("%s\n%s\n%s", table(tallies).c_str(), reasons_table(tallies).c_str(), work.text().c_str());
  }
}

}  // namespace
}  // namespace pose_wall::judge

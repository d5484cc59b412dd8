// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a frame costs, in steps that are the same on every machine, is within the bound that is computed from
// the caps, and for every cloud that is known to be dear within three and a half bare roads of as many points, which
// are two furnished ones (bench/README.md). What would cost more ends with a reason of its own. It does not prove that
// steps are instructions: `bench/instructions/count.py` counts them.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/dear_clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/work_bound.hpp"

namespace pose_wall {
namespace {

constexpr int kFrames = 3;
constexpr double kRoadsMost = 3.5;

struct Costs {
  std::uint64_t most = 0, last = 0;
  std::uint32_t reasons = 0;
};

// Frames of one cloud, one engine.
Costs costs_of(const std::string& kind, std::uint32_t points, const pose_wall_config& config = test::config_with()) {
  static test::DearCloud cloud;
  EXPECT_TRUE(test::fill_dear(kind, points, &cloud)) << kind;
  test::EngineUnderTest engine(config);
  Costs costs;
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame > 0) cloud.nudge();
    const pose_wall_result result = engine.process(cloud.at(1 + 50'000'000LL * frame));
    costs.last = result.work;
    costs.most = costs.most > result.work ? costs.most : result.work;
    costs.reasons |= result.frame_reasons;
    EXPECT_LE(result.work, test::most_of_a_frame(read_settings(config), cloud.size())) << kind << " " << points;
  }
  return costs;
}

pose_wall_result frame_of(const test::DearCloud& cloud, const char* work_max) {
  return test::EngineUnderTest(test::config_with({{"work_max", work_max}})).process(cloud.at(1));
}

// What was thought out, and the dearest that searches found.
const char* const kDear[] = {"equal",  "sphere", "sphere03", "ball03",   "spread",  "dense",
                             "sheets", "rough",  "apart",    "hash",     "par27",   "par304",
                             "par4",   "par15",  "par1028",  "climbed0", "climbed1"};

TEST(Work, DearCloudsCostNoMoreThanThreeAndAHalfBareRoads) {
  for (const std::uint32_t points : {28800U, 65536U, 131072U}) {
    const Costs road = costs_of("road", points);
    ASSERT_GT(road.most, points * 20ULL);
    EXPECT_EQ(road.reasons & POSE_WALL_R_WORK_LIMIT, 0U);
    for (const char* const kind : kDear) {
      const Costs costs = costs_of(kind, points);
      EXPECT_LE(static_cast<double>(costs.most), kRoadsMost * static_cast<double>(road.most)) << kind << " " << points;
    }
  }
}

TEST(Work, IsTheSameAgain) {
  for (const char* const kind : {"road", "par304", "sheets"}) {
    EXPECT_EQ(costs_of(kind, 20000).last, costs_of(kind, 20000).last) << kind;
  }
}

TEST(Work, GrowsWithThePoints) {
  EXPECT_GT(costs_of("road", 60000).most, costs_of("road", 30000).most);
}

// The budget ends a frame wherever it runs out: what is told then is refused, or the same as without.
TEST(Work, ASmallBudgetRefusesWhatIsNotFinished) {
  static test::DearCloud cloud;
  ASSERT_TRUE(test::fill_dear("road", 30000, &cloud));
  const pose_wall_result free = frame_of(cloud, "0");
  const std::uint64_t whole = free.work;
  std::uint32_t refused = 0, told = 0;
  for (std::uint64_t budget = 1; budget < whole; budget += whole / 40) {
    const pose_wall_result result = frame_of(cloud, std::to_string(budget).c_str());
    const bool limited = (result.frame_reasons & POSE_WALL_R_WORK_LIMIT) != 0;
    refused += limited ? 1U : 0U;
    EXPECT_LE(result.work, free.work);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const pose_wall_value& value = result.quantity[q];
      if (value.state < POSE_WALL_DEGRADED) continue;
      ++told;
      if (q <= POSE_WALL_PITCH) {
        EXPECT_EQ(value.value, free.quantity[q].value) << budget << " " << q;
      }
    }
    if (!limited) {
      EXPECT_EQ(result.work, free.work);
    }
  }
  EXPECT_GT(refused, 20U);
  EXPECT_GT(told, 0U) << "the floor is told where only the walls are not finished";
}

TEST(Work, AFrameThatIsEndedIsHeldAndSaysSo) {
  static test::DearCloud cloud;
  ASSERT_TRUE(test::fill_dear("road", 30000, &cloud));
  const pose_wall_result result = frame_of(cloud, "1");
  EXPECT_NE(result.frame_reasons & POSE_WALL_R_WORK_LIMIT, 0U);
  for (const pose_wall_value& value : result.quantity) {
    EXPECT_LT(value.state, POSE_WALL_DEGRADED);
    EXPECT_NE(value.reasons & (POSE_WALL_R_WORK_LIMIT | POSE_WALL_R_LEVEL_MISSING), 0U);
  }
}

// A frame that spends its budget with the last piece of work has left nothing undone.
TEST(Work, AFrameThatIsDoneIsNotRefused) {
  static test::DearCloud cloud;
  ASSERT_TRUE(test::fill_dear("road", 30000, &cloud));
  const pose_wall_result free = frame_of(cloud, "0");
  std::uint32_t above = 0;
  for (std::uint64_t budget = free.work - 400; budget < free.work; budget += 50) {
    const pose_wall_result result = frame_of(cloud, std::to_string(budget).c_str());
    above += result.work > budget ? 1U : 0U;
    EXPECT_EQ(result.work, free.work) << budget;
    EXPECT_EQ(result.frame_reasons & POSE_WALL_R_WORK_LIMIT, 0U) << budget;
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      EXPECT_EQ(result.quantity[q].value, free.quantity[q].value) << budget << " " << q;
    }
  }
  EXPECT_GT(above, 0U) << "or nothing was tried";
}

// What was judged before the budget ended the frame is given, as a wall alone: never narrower than beside the other
// one.
TEST(Work, AWallThatIsDoneIsGiven) {
  static test::DearCloud cloud;
  ASSERT_TRUE(test::fill_dear("road", 30000, &cloud));
  const pose_wall_result free = frame_of(cloud, "0");
  std::uint32_t alone = 0;
  for (std::uint64_t budget = free.work / 2; budget < free.work; budget += free.work / 60) {
    const pose_wall_result result = frame_of(cloud, std::to_string(budget).c_str());
    const pose_wall_value &left = result.quantity[POSE_WALL_D_LF], &right = result.quantity[POSE_WALL_D_RF];
    if ((left.state >= POSE_WALL_DEGRADED) == (right.state >= POSE_WALL_DEGRADED)) continue;
    ++alone;
    EXPECT_NE(result.frame_reasons & POSE_WALL_R_WORK_LIMIT, 0U) << budget;
    EXPECT_NE((left.state < right.state ? left : right).reasons & POSE_WALL_R_WORK_LIMIT, 0U) << budget;
    EXPECT_GE(result.quantity[POSE_WALL_YAW].protection_level, free.quantity[POSE_WALL_YAW].protection_level);
  }
  EXPECT_GT(alone, 0U);
}

}  // namespace
}  // namespace pose_wall

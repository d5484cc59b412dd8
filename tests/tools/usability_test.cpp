// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the verdict on a recording follows one rule, by the share of frames in which each value is valid, and its
// text names every value with its reason, in both languages.

#include "study/results/usability.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "io/language/language.hpp"
#include "pose_wall.hpp"
#include "study/results/run_summary.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Usability, OfOneValueIsByItsValidShare) {
  EXPECT_EQ(usability_of(1.0), Usability::kUsable);
  EXPECT_EQ(usability_of(kUsableShare), Usability::kUsable);
  EXPECT_EQ(usability_of(0.89), Usability::kInPart);
  EXPECT_EQ(usability_of(kInPartShare), Usability::kInPart);
  EXPECT_EQ(usability_of(0.49), Usability::kNotUsable);
  EXPECT_EQ(usability_of(kNaN), Usability::kNotUsable) << "no frame was read";
}

TEST(Usability, OfARecordingIsThatOfAllItsValues) {
  EXPECT_EQ(usability_of(ValidShares{1, 1, 1, 1, 1, 1, 0.9}), Usability::kUsable);
  EXPECT_EQ(usability_of(ValidShares{1, 1, 1, 1, 1, 1, 0.8}), Usability::kInPart);
  EXPECT_EQ(usability_of(ValidShares{0.6, 0, 0, 0, 0, 0, 0}), Usability::kInPart);
  // 15 frames, one valid value among all.
  EXPECT_EQ(usability_of(ValidShares{0, 0, 1.0 / 15.0, 0, 0, 0, 0}), Usability::kNotUsable);
  // 40 frames, roll and pitch valid in most of them.
  EXPECT_EQ(usability_of(ValidShares{0.9, 0.85, 0, 0, 0, 0, 0}), Usability::kInPart);
}

TEST(Usability, TextNamesEachValueWithItsReason) {
  EXPECT_EQ(usability_text({1, 1, 1, 1, 1, 1, 1}),
            "usable: roll, pitch, yaw, d_lf, d_lb, d_rf, d_rb valid in at least 90 % of the frames");
  EXPECT_EQ(
      usability_text({1, 0.95, 0.6, 0.1, 0, 0, 0}),
      "usable in part: roll, pitch valid in at least 90 % of the frames; yaw valid in 50 % to 90 %; d_lf valid in "
      "less than 50 %; never valid: d_lb, d_rf, d_rb");
  choose_language(Language::kChinese);
  const std::string chinese = usability_text({0, 0, 0.2, 0, 0, 0, 0});
  choose_language(Language::kEnglish);
  EXPECT_EQ(chinese, "不可用：yaw 有效率不足 50 %；从未有效：roll, pitch, d_lf, d_lb, d_rf, d_rb");
}

TEST(Usability, OfARunIsByTheFramesThatWereRead) {
  RunSummary summary;
  FrameOutcome outcome;
  summary.add(outcome);  // unreadable
  outcome.result = api::make_result();
  for (pose_wall_value& value : outcome.result->quantity) value.state = POSE_WALL_DEGRADED;
  outcome.result->quantity[POSE_WALL_YAW].state = POSE_WALL_VALID;
  summary.add(outcome);
  outcome.result->quantity[POSE_WALL_ROLL].state = POSE_WALL_VALID;
  summary.add(outcome);
  EXPECT_EQ(summary.valid_shares(), (ValidShares{0.5, 0, 1, 0, 0, 0, 0}));
  EXPECT_TRUE(test::contains(summary.text(1.0), "median value  median raw  median level")) << summary.text(1.0);
  EXPECT_TRUE(test::contains(summary.text(1.0), "verdict: usable in part: yaw valid in at least 90 %"))
      << summary.text(1.0);
}

}  // namespace
}  // namespace pose_wall::tools

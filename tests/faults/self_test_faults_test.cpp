// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the self test notices a digest that is off by a bit, and each step of the engine that fails while it runs,
// but for those that change nothing on its road. These are named, and all are counted for include/SAFETY.md.

#include <gtest/gtest.h>

#include <cstdint>

#include "engine/self_test.hpp"
#include "engine/self_test_digest.hpp"
#include "fault.hpp"
#include "support/aligned_block.hpp"

namespace pose_wall::test {
namespace {

class SelfTestFaults : public ::testing::Test {
 protected:
  void TearDown() override { fail_from_now_on(Fault::kNone); }

  std::int32_t run(std::uint64_t digest_expected = kSelfTestDigest) {
    return self_test(digest_expected, block_.data(), &report_);
  }

  AlignedBlock block_{self_test_bytes(), Dirt::kRandom};
  pose_wall_self_test_report report_{};
};

TEST_F(SelfTestFaults, ADigestThatIsOffByABit) {
  ASSERT_EQ(run(), POSE_WALL_OK);
  for (const int bit : {0, 31, 32, 63}) {
    EXPECT_EQ(run(kSelfTestDigest ^ (std::uint64_t{1} << bit)), POSE_WALL_E_SELF_TEST) << bit;
    EXPECT_EQ(report_.digest_found, kSelfTestDigest);
    EXPECT_EQ(report_.values_wrong, 0U);
  }
}

// These objects are linked one by one.
TEST_F(SelfTestFaults, CodeThatIsNotCoveredIsSaidToBeNone) {
  run();
  EXPECT_EQ(report_.code_bytes, 0U);
  EXPECT_EQ(report_.code_crc32, 0U);
}

// Its road shows no strips that layers do not tell, nothing that hides a wall, and a floor that is as well known in all
// its view as beside the machine.
bool changes_nothing(Fault fault) {
  return fault == Fault::kStripsNotFound || fault == Fault::kDirectionsNotLearnt ||
         fault == Fault::kRegionsUnseenAtEnds;
}

TEST_F(SelfTestFaults, EachStepThatFails) {
  int reached = 0, noticed = 0, wrong = 0;
  for (int number = static_cast<int>(Fault::kNone) + 1; number < static_cast<int>(Fault::kCount); ++number) {
    fail_from_now_on(static_cast<Fault>(number));
    const std::int32_t status = run();
    if (failures() == 0) {
      EXPECT_EQ(status, POSE_WALL_OK) << number;
      continue;
    }
    ++reached;
    noticed += status == POSE_WALL_E_SELF_TEST ? 1 : 0;
    wrong += report_.values_wrong > 0 ? 1 : 0;
    const bool without_effect = changes_nothing(static_cast<Fault>(number));
    EXPECT_EQ(status, without_effect ? POSE_WALL_OK : POSE_WALL_E_SELF_TEST) << "step " << number;
  }
  RecordProperty("reached", reached);
  RecordProperty("noticed", noticed);
  RecordProperty("told_by_a_value", wrong);
  EXPECT_GE(reached, 45);
  EXPECT_GE(noticed, 43);
  EXPECT_GE(wrong, 35) << "told by a value, whatever digest was noted";
}

}  // namespace
}  // namespace pose_wall::test

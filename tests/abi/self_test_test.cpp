// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the self test passes on this machine in whatever block, gives the same report each time, and takes
// no more memory than it says.

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "support/engine_under_test.hpp"

namespace pose_wall::test {
namespace {

pose_wall_self_test_report fresh_report() {
  pose_wall_self_test_report report;
  std::memset(&report, 0x5A, sizeof report);
  report.struct_size = sizeof report;
  return report;
}

pose_wall_self_test_report passed_in(AlignedBlock* block) {
  pose_wall_self_test_report report = fresh_report();
  EXPECT_EQ(pose_wall_self_test(block->data(), block->size(), &report), POSE_WALL_OK)
      << "digest " << std::hex << report.digest_found << ", noted " << report.digest_expected << ", " << std::dec
      << report.values_wrong << " values wrong";
  return report;
}

TEST(SelfTest, PassesAndSaysWhatItLookedAt) {
  AlignedBlock block(pose_wall_self_test_bytes(), Dirt::kRandom);
  const pose_wall_self_test_report report = passed_in(&block);
  EXPECT_EQ(report.frames, static_cast<std::uint32_t>(POSE_WALL_SELF_TEST_FRAMES));
  EXPECT_EQ(report.values_wrong, 0U);
  EXPECT_EQ(report.refused, POSE_WALL_OK);
  EXPECT_EQ(report.digest_found, report.digest_expected);
  EXPECT_EQ(report.reserved, 0U);
  EXPECT_EQ(report.struct_size, sizeof report);
  EXPECT_GT(report.code_bytes, 100U * 1024U) << "the archive is linked: its code is covered";
  EXPECT_LT(pose_wall_self_test_bytes(), 5U << 19U) << "2.5 MiB, as the header says";
}

TEST(SelfTest, SaysTheSameEachTimeWhateverTheBlockHeld) {
  AlignedBlock first(pose_wall_self_test_bytes(), Dirt::kOnes), second(pose_wall_self_test_bytes(), Dirt::kRandom);
  const pose_wall_self_test_report a = passed_in(&first), b = passed_in(&second), c = passed_in(&second);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  EXPECT_EQ(std::memcmp(&b, &c, sizeof b), 0);
}

TEST(SelfTest, LeavesTheBlockForAnEngine) {
  const pose_wall_config config = config_with();
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
  ASSERT_GE(bytes, pose_wall_self_test_bytes()) << "the block of an engine with default settings is enough";
  AlignedBlock block(bytes, Dirt::kRandom);
  passed_in(&block);
  pose_wall_engine* engine = nullptr;
  EXPECT_EQ(pose_wall_open(&config, block.data(), bytes, &engine), POSE_WALL_OK);
}

}  // namespace
}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every status, reason, state, quantity and stage has a name of its own, and numbers beyond have one too.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "pose_wall.h"

namespace pose_wall {
namespace {

bool is_short_name(const std::string& text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

template <typename NameOf>
void expect_distinct_names(std::uint32_t count, const NameOf& name_of) {
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    EXPECT_TRUE(is_short_name(name_of(i))) << i << ": '" << name_of(i) << "'";
    EXPECT_TRUE(names.insert(name_of(i)).second) << name_of(i) << " twice";
  }
  // Out of range: something to print, and nothing that could be taken for a real one.
  for (const std::uint32_t i : {count, count + 1, 32U, 1000U, 0xFFFFFFFFU}) {
    ASSERT_NE(name_of(i), nullptr);
    EXPECT_EQ(names.count(name_of(i)), 0U) << i;
  }
}

TEST(Names, AreShortAndDistinct) {
  expect_distinct_names(POSE_WALL_REASON_COUNT, pose_wall_reason_name);
  expect_distinct_names(4, pose_wall_state_name);
  expect_distinct_names(POSE_WALL_QUANTITIES, pose_wall_quantity_name);
  expect_distinct_names(POSE_WALL_STAGES, pose_wall_stage_name);
}

TEST(Names, QuantitiesAndStatesAreThoseOfTheCsv) {
  const char* const quantities[] = {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) EXPECT_STREQ(pose_wall_quantity_name(q), quantities[q]);
  EXPECT_STREQ(pose_wall_state_name(POSE_WALL_INVALID), "invalid");
  EXPECT_STREQ(pose_wall_state_name(POSE_WALL_HELD), "held");
  EXPECT_STREQ(pose_wall_state_name(POSE_WALL_DEGRADED), "degraded");
  EXPECT_STREQ(pose_wall_state_name(POSE_WALL_VALID), "valid");
}

TEST(Names, EveryReasonHasASentence) {
  std::set<std::string> texts;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    EXPECT_GT(std::string(pose_wall_reason_text(bit)).size(), 10U) << bit;
    EXPECT_TRUE(texts.insert(pose_wall_reason_text(bit)).second) << pose_wall_reason_text(bit);
  }
  EXPECT_NE(pose_wall_reason_text(99), nullptr);
}

TEST(Names, EveryStatusHasASentence) {
  const std::string unknown = pose_wall_status_text(-12345);
  EXPECT_EQ(unknown, "unknown status");
  std::set<std::string> texts;
  for (const std::int32_t status :
       {0,   -1,  -2,  -3,  -4,  -5,  -6,  -7,  -8,  -9,  -10, -11,  -12,  -20,  -21, -22,
        -23, -24, -40, -41, -42, -60, -61, -62, -80, -90, -95, -100, -109, -120, -124}) {  // of every library
    EXPECT_NE(pose_wall_status_text(status), unknown) << status;
    EXPECT_TRUE(texts.insert(pose_wall_status_text(status)).second) << status;
  }
  for (const std::int32_t status : {1, -13, -19, -25, -39, -43, -59, -63, 2147483647})
    EXPECT_EQ(pose_wall_status_text(status), unknown);
}

}  // namespace
}  // namespace pose_wall

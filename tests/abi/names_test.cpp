// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every reason, state, quantity and stage has a short name of its own, every reason a sentence, and what is
// beyond the last one has a text, too; quantities and states are called as in the CSV. Texts of statuses are compared
// by checks.statuses.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "pose_wall.h"

namespace pose_wall::test {
namespace {

using Naming = const char* (*)(std::uint32_t);

void expect_distinct(Naming name_of, std::uint32_t count, const char* what) {
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    const char* const name = name_of(i);
    ASSERT_NE(name, nullptr) << what << " " << i;
    EXPECT_NE(std::string(name), "") << what << " " << i;
    EXPECT_TRUE(names.insert(name).second) << what << ": " << name << " twice";
  }
  for (const std::uint32_t beyond : {count, count + 1, 32U, 1000U, ~0U}) {
    const char* const name = name_of(beyond);
    ASSERT_NE(name, nullptr) << what << " " << beyond;
    EXPECT_EQ(names.count(name), 0U) << what << ": what is none is called " << name;
  }
}

void expect_short_names(Naming name_of, std::uint32_t count, const char* what) {
  expect_distinct(name_of, count, what);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string name = name_of(i);
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << name;
  }
}

TEST(AbiNames, AreShortDistinctAndNeverNull) {
  expect_short_names(pose_wall_reason_name, POSE_WALL_REASON_COUNT, "reason");
  expect_short_names(pose_wall_state_name, POSE_WALL_VALID + 1, "state");
  expect_short_names(pose_wall_quantity_name, POSE_WALL_QUANTITIES, "quantity");
  expect_short_names(pose_wall_stage_name, POSE_WALL_STAGES, "stage");
}

TEST(AbiNames, EveryReasonHasASentence) {
  expect_distinct(pose_wall_reason_text, POSE_WALL_REASON_COUNT, "reason's sentence");
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    EXPECT_GT(std::string(pose_wall_reason_text(bit)).size(), 10U) << bit;
  }
}

TEST(AbiNames, QuantitiesAndStatesAreThoseOfTheCsv) {
  const char* const quantities[] = {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) EXPECT_STREQ(pose_wall_quantity_name(q), quantities[q]);
  const char* const states[] = {"invalid", "held", "degraded", "valid"};
  for (std::uint32_t s = 0; s <= POSE_WALL_VALID; ++s) EXPECT_STREQ(pose_wall_state_name(s), states[s]);
}

}  // namespace
}  // namespace pose_wall::test

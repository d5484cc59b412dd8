// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: through the C ABI every reason, state, quantity and stage has a name of its own, every reason a sentence, and
// what is beyond the last one has a text, too. What the names are, tests/unit/entry/names_test.cpp says.

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
  for (const std::uint32_t beyond : {count, ~0U}) {
    const char* const name = name_of(beyond);
    ASSERT_NE(name, nullptr) << what << " " << beyond;
    EXPECT_EQ(names.count(name), 0U) << what << ": what is none is called " << name;
  }
}

TEST(AbiNames, AreDistinctAndNeverNull) {
  expect_distinct(pose_wall_reason_name, POSE_WALL_REASON_COUNT, "reason");
  expect_distinct(pose_wall_reason_text, POSE_WALL_REASON_COUNT, "reason's sentence");
  expect_distinct(pose_wall_state_name, POSE_WALL_VALID + 1, "state");
  expect_distinct(pose_wall_quantity_name, POSE_WALL_QUANTITIES, "quantity");
  expect_distinct(pose_wall_stage_name, POSE_WALL_STAGES, "stage");
}

}  // namespace
}  // namespace pose_wall::test

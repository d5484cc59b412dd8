// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: behind a held value stands the thinning of the frame that it may come from, until a whole cloud gave a good
// one.

#include "runtime/thinning.hpp"

#include <gtest/gtest.h>

namespace pose_wall::runtime {
namespace {

pose_wall_result all_in(std::uint32_t state) {
  pose_wall_result r{};
  for (pose_wall_value& v : r.quantity) v.state = state;
  return r;
}

TEST(HeldThinning, IsThatOfTheFrameBehind) {
  HeldThinning held;
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 1U);
  EXPECT_EQ(held.note(all_in(POSE_WALL_VALID), 4), 1U) << "nothing is held in it";
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 4U);
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 4U) << "as long as it is held";
  EXPECT_EQ(held.note(all_in(POSE_WALL_VALID), 1), 1U);
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 1U);
}

TEST(HeldThinning, AWeakFrameReplacesNoGoodOne) {
  HeldThinning held;
  held.note(all_in(POSE_WALL_VALID), 2);
  held.note(all_in(POSE_WALL_DEGRADED), 1);
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 2U);
  held.note(all_in(POSE_WALL_DEGRADED), 8);
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 8U);
}

// The engine keeps a good value beside a jump that nothing confirmed, and may hold it after it said invalid.
TEST(HeldThinning, LastsBeyondInvalid) {
  HeldThinning held;
  held.note(all_in(POSE_WALL_VALID), 2);
  held.note(all_in(POSE_WALL_INVALID), 1);
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 2U);
}

TEST(HeldThinning, EndsWhereAllIsForgotten) {
  HeldThinning held;
  held.note(all_in(POSE_WALL_VALID), 2);
  held.forget();
  EXPECT_EQ(held.note(all_in(POSE_WALL_HELD), 1), 1U);
}

TEST(HeldThinning, EachQuantityByItself) {
  HeldThinning held;
  pose_wall_result r = all_in(POSE_WALL_VALID);
  held.note(r, 2);
  r.quantity[POSE_WALL_YAW].state = POSE_WALL_HELD;
  EXPECT_EQ(held.note(r, 1), 2U) << "yaw alone is of the thinned one";
  EXPECT_EQ(held.note(all_in(POSE_WALL_VALID), 1), 1U);
}

}  // namespace
}  // namespace pose_wall::runtime

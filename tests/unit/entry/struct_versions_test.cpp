// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a struct of an earlier header is read with zeros where it ends and written no further; every other size has
// a status of its own.

#include "part/struct_versions.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace pose_wall {
namespace {

struct Grown {
  std::uint32_t struct_size;
  std::uint32_t first;
  double added;
};
constexpr StructSizes kSizes = {4, 8, sizeof(Grown)};

TEST(StructVersions, EachSizeHasItsStatus) {
  EXPECT_EQ(check_struct_size(4, kSizes), POSE_WALL_E_ABI);
  EXPECT_EQ(check_struct_size(8, kSizes), POSE_WALL_OK);
  EXPECT_EQ(check_struct_size(16, kSizes), POSE_WALL_OK);
  EXPECT_EQ(check_struct_size(17, kSizes), POSE_WALL_E_STRUCT_NEWER);
  EXPECT_EQ(check_struct_size(0, kSizes), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(check_struct_size(7, kSizes), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(check_struct_size(0xCCCCCCCCU, kSizes), POSE_WALL_E_STRUCT_SIZE) << "never initialised";
}

TEST(StructVersions, WhatAnEarlierOneLacksIsZero) {
  const Grown longer = {8, 7, 3.5};
  const auto read = read_struct<Grown>(&longer, 8);
  EXPECT_EQ(read.first, 7U);
  EXPECT_EQ(read.added, 0.0);
}

TEST(StructVersions, AnEarlierOneIsWrittenNoFurtherThanItsEnd) {
  Grown caller = {8, 0, 1.25};
  write_struct(Grown{sizeof(Grown), 9, 2.5}, 8, &caller);
  EXPECT_EQ(caller.struct_size, 8U);
  EXPECT_EQ(caller.first, 9U);
  EXPECT_EQ(caller.added, 1.25);
}

}  // namespace
}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the arena places what it measured, aligned and without overlap.

#include "base/containers/arena.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "support/aligned_block.hpp"

namespace pose_wall {
namespace {

struct Parts {
  Span<std::uint8_t> bytes;
  Span<double> doubles;
  Span<std::uint32_t> none;
  double* one = nullptr;
  Span<std::uint16_t> last;
};

Parts walk(Arena* arena) {
  Parts p;
  p.bytes = arena->take<std::uint8_t>(3);
  p.doubles = arena->take<double>(17);
  p.none = arena->take<std::uint32_t>(0);
  p.one = arena->take_one<double>();
  p.last = arena->take<std::uint16_t>(1000);
  return p;
}

bool is_aligned(const void* p) {
  return reinterpret_cast<std::uintptr_t>(p) % POSE_WALL_BLOCK_ALIGNMENT == 0;
}

TEST(Arena, MeasuresWhatItPlaces) {
  Arena measuring(nullptr);
  walk(&measuring);
  test::AlignedBlock block(measuring.bytes(), test::Dirt::kOnes);
  Arena placing(block.data());
  const Parts p = walk(&placing);
  EXPECT_EQ(placing.bytes(), measuring.bytes());
  for (const void* place : {static_cast<void*>(p.bytes.data()), static_cast<void*>(p.doubles.data()),
                            static_cast<void*>(p.one), static_cast<void*>(p.last.data())}) {
    EXPECT_TRUE(is_aligned(place));
  }
  // Written from end to end, no part touches another; AddressSanitizer guards the block's own end.
  p.bytes.fill(1);
  p.doubles.fill(2.0);
  *p.one = 3.0;
  p.last.fill(4);
  for (const std::uint8_t b : p.bytes) EXPECT_EQ(b, 1);
  for (const double d : p.doubles) EXPECT_EQ(d, 2.0);
  EXPECT_EQ(*p.one, 3.0);
  EXPECT_EQ(p.none.size(), 0U);
}

TEST(Arena, MeasuringGivesNoPlaces) {
  Arena arena(nullptr);
  EXPECT_EQ(arena.take<int>(5).data(), nullptr);
  EXPECT_EQ(arena.take_one<int>(), nullptr);
  EXPECT_EQ(arena.bytes(), 2U * POSE_WALL_BLOCK_ALIGNMENT);
}

TEST(Arena, SizesDoNotWrapAt32Bits) {
  Arena arena(nullptr);
  arena.take<double>(0xFFFFFFFFU);
  EXPECT_GE(arena.bytes(), 8ULL * 0xFFFFFFFFULL);
}

TEST(Arena, PartsThatLieOnTopOfEachOtherNeedTheRoomOfTheLargest) {
  for (const std::uint32_t first : {10U, 5000U}) {
    Arena arena(nullptr);
    arena.take<double>(100);
    const std::uint64_t place = arena.place();
    arena.take<std::uint8_t>(first);
    arena.go_back(place);
    arena.take<std::uint8_t>(1000);
    EXPECT_EQ(arena.bytes(), place + (first > 1000 ? 5056 : 1024)) << "whole lines of 64 bytes";
    arena.go_behind_all();
    EXPECT_EQ(arena.place(), arena.bytes());
  }
  test::AlignedBlock block(1024, test::Dirt::kOnes);
  Arena placing(block.data());
  const std::uint64_t place = placing.place();
  const Span<float> one = placing.take<float>(4);
  placing.go_back(place);
  const Span<float> other = placing.take<float>(8);
  EXPECT_EQ(one.data(), other.data());
}

}  // namespace
}  // namespace pose_wall

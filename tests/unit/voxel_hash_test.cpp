// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: keys keep their indices through crowding, collisions and clears, and a full table says so.

#include "containers/voxel_hash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <unordered_map>
#include <vector>

#include "support/stage_fixtures.hpp"
#include "support/voxels.hpp"

namespace pose_wall {
namespace {

std::uint32_t insert(VoxelHash* hash, std::uint64_t key) {
  return VoxelHash::Filling(hash).insert(key);
}

TEST(VoxelHash, BehavesAsAMapOverManyFrames) {
  test::Placed<VoxelHash> hash(1000U);
  std::mt19937 random(1);
  for (int frame = 0; frame < 50; ++frame) {
    hash->clear();
    std::unordered_map<std::uint64_t, std::uint32_t> expected;
    // Filled in two goes: the second finds what the first has left.
    for (int go = 0; go < 2; ++go) {
      VoxelHash::Filling filling(hash.get());
      for (int i = 0; i < 1500; ++i) {
        const auto draw = [&] { return static_cast<std::int32_t>(random() % 12); };
        const std::uint64_t key = test::key_of(draw(), draw(), draw());
        const auto known = expected.find(key);
        const std::uint32_t index = filling.insert(key);
        if (known != expected.end()) {
          ASSERT_EQ(index, known->second);
        } else if (expected.size() == 1000) {
          ASSERT_EQ(index, VoxelHash::kFull);
        } else {
          ASSERT_EQ(index, expected.size());  // in the order of first insertion
          expected[key] = index;
        }
        ASSERT_EQ(filling.count(), expected.size());
      }
    }
    ASSERT_EQ(hash->count(), expected.size());
    for (const auto& [key, index] : expected) {
      ASSERT_EQ(insert(hash.get(), key), index);
      ASSERT_EQ(hash->key(index), key);
    }
  }
}

TEST(VoxelHash, AClearedTableHoldsNothing) {
  test::Placed<VoxelHash> hash(64U);
  hash->clear();
  EXPECT_EQ(insert(hash.get(), test::key_of(1, 2, 3)), 0U);
  hash->clear();
  EXPECT_EQ(hash->count(), 0U);
  EXPECT_EQ(insert(hash.get(), test::key_of(4, 5, 6)), 0U);
  EXPECT_EQ(insert(hash.get(), test::key_of(1, 2, 3)), 1U);
}

TEST(VoxelHash, RoomForOneKey) {
  test::Placed<VoxelHash> hash(1U);
  hash->clear();
  EXPECT_EQ(insert(hash.get(), 7), 0U);
  EXPECT_EQ(insert(hash.get(), 8), VoxelHash::kFull);
  EXPECT_EQ(insert(hash.get(), 7), 0U);
}

// Keys of a wall differ in few low bits: a weak hash puts them in long runs. Not a timing: runs are counted.
TEST(VoxelHash, KeysOfAPlaneDoNotPileUp) {
  constexpr std::uint32_t kBits = 12;
  std::vector<int> home(1U << kBits);
  for (std::int32_t x = 0; x < 40; ++x) {
    for (std::int32_t z = 0; z < 40; ++z) {
      const std::uint64_t key = test::key_of(x, 50, z);
      ++home[static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> (64 - kBits))];
    }
  }
  EXPECT_LE(*std::max_element(home.begin(), home.end()), 8);
}

}  // namespace
}  // namespace pose_wall

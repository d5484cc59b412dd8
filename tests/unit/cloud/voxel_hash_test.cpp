// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: keys keep their indices through crowding, collisions and clears, and a full table says so. What a key costs
// has a bound that no choice of keys can stretch.

#include "engine/cloud/voxel_hash.hpp"

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

constexpr std::uint64_t kMultiplier = 0x9E3779B97F4A7C15ULL;

// A number times this is the multiplier's share undone: products choose keys. By Newton, each step doubles the bits.
std::uint64_t inverse_of_multiplier() {
  std::uint64_t inverse = kMultiplier;
  for (int step = 0; step < 6; ++step) inverse *= 2 - kMultiplier * inverse;
  return inverse;
}

// Keys that all begin at the same slot, in whatever table, as their products begin with the same bits.
std::vector<std::uint64_t> keys_of_one_slot(std::size_t count, std::uint32_t seed) {
  const std::uint64_t inverse = inverse_of_multiplier();
  std::mt19937_64 random(seed);
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < count; ++i) keys.push_back((0x1234567ULL << 36 | random() >> 28) * inverse);
  return keys;
}

TEST(VoxelHash, KeysOfOneSlotKeepTheirIndices) {
  constexpr std::uint32_t kRoom = 2000;
  test::Placed<VoxelHash> hash(kRoom);
  std::mt19937 random(2);
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    hash->clear();
    const std::vector<std::uint64_t> keys = keys_of_one_slot(kRoom + 50, frame);
    std::unordered_map<std::uint64_t, std::uint32_t> expected;
    VoxelHash::Filling filling(hash.get());
    for (int i = 0; i < 20000; ++i) {
      const std::uint64_t key = keys[random() % keys.size()];
      const auto known = expected.find(key);
      const std::uint32_t index = filling.insert(key);
      if (known != expected.end()) {
        ASSERT_EQ(index, known->second);
      } else if (expected.size() == kRoom) {
        ASSERT_EQ(index, VoxelHash::kFull);
      } else {
        ASSERT_EQ(index, expected.size());
        expected[key] = index;
      }
    }
    ASSERT_EQ(expected.size(), kRoom);
    for (const auto& [key, index] : expected) ASSERT_EQ(hash->key(index), key);
  }
}

// A table that probes until it finds room looks at half of all keys for each of these.
TEST(VoxelHash, AKeyCostsNoMoreThanItsBits) {
  constexpr std::uint32_t kRoom = 60000;
  test::Placed<VoxelHash> hash(kRoom);
  hash->clear();
  const std::vector<std::uint64_t> keys = keys_of_one_slot(kRoom, 7);
  {
    VoxelHash::Filling filling(hash.get());
    for (std::uint32_t i = 0; i < kRoom; ++i) ASSERT_EQ(filling.insert(keys[i]), i);
  }
  EXPECT_GT(hash->links(), kRoom) << "or they do not crowd";
  EXPECT_LT(hash->links(), (2ULL * 64 + VoxelHash::kProbesMost) * kRoom);
  const std::uint64_t before = hash->links();
  VoxelHash::Filling filling(hash.get());
  for (std::uint32_t i = 0; i < kRoom; ++i) ASSERT_EQ(filling.insert(keys[i]), i);
  EXPECT_LT(hash->links() - before, (64ULL + VoxelHash::kProbesMost) * kRoom);
}

// As deep as a tree can be made: each key parts from the last at the next bit.
TEST(VoxelHash, TheDeepestTreeIsAsDeepAsAKeyHasBits) {
  test::Placed<VoxelHash> hash(64U);
  hash->clear();
  const std::vector<std::uint64_t> crowd = keys_of_one_slot(VoxelHash::kProbesMost, 3);
  for (const std::uint64_t key : crowd) insert(hash.get(), key);
  ASSERT_EQ(hash->links(), 0U) << "they have their slots";
  const std::uint64_t inverse = inverse_of_multiplier();
  std::vector<std::uint64_t> keys;  // as alike as keys of one slot can be: chosen by their products' low bits
  for (std::uint64_t k = 0; keys.size() < 50; ++k) keys.push_back((0x1234567ULL << 36 | k) * inverse);
  std::sort(keys.begin(), keys.end());
  for (std::uint32_t i = 0; i < keys.size(); ++i) ASSERT_EQ(insert(hash.get(), keys[i]), crowd.size() + i);
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const std::uint64_t before = hash->links();
    ASSERT_EQ(insert(hash.get(), keys[i]), crowd.size() + i);
    ASSERT_LE(hash->links() - before, 63U + VoxelHash::kProbesMost);
  }
}

// Few slots are crowded, most are not.
TEST(VoxelHash, CrowdedAndOthersSideBySide) {
  test::Placed<VoxelHash> hash(4000U);
  hash->clear();
  std::vector<std::uint64_t> keys = keys_of_one_slot(1000, 4);
  for (std::int32_t k = 0; k < 3000; ++k) keys.push_back(test::key_of(1000 + k % 50, 900 + k / 50, 1000));
  std::shuffle(keys.begin(), keys.end(), std::mt19937(5));
  VoxelHash::Filling filling(hash.get());
  for (std::uint32_t i = 0; i < keys.size(); ++i) ASSERT_EQ(filling.insert(keys[i]), i);
  EXPECT_EQ(filling.insert(test::key_of(1, 1, 1)), VoxelHash::kFull);
  for (std::uint32_t i = 0; i < keys.size(); ++i) ASSERT_EQ(filling.insert(keys[i]), i);
}

}  // namespace
}  // namespace pose_wall

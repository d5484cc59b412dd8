// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a bit that falls over in the engine's block between two calls is either noticed (every bit of what lives on:
// settings, memory, the sum itself; the engine is refused until it is opened again) or without any effect
// (the scratch and its pointers: the next result has the same bits). Does not prove: anything of bits that fall over
// during a call.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/engine.hpp"
#include "fault_room.hpp"
#include "support/moments.hpp"

namespace pose_wall::test {
namespace {

// An engine whose block the test may write to, with one frame behind it.
class OpenBlock {
 public:
  OpenBlock() : config_(small_config()), block_(needed(config_), Dirt::kRandom) { open(); }

  void open() { ASSERT_EQ(pose_wall_open(&config_, block_.data(), block_.size(), &engine_), POSE_WALL_OK); }
  unsigned char* bytes() { return static_cast<unsigned char*>(block_.data()); }
  std::uint64_t size() const { return block_.size(); }
  pose_wall_engine* engine() { return engine_; }
  void flip(std::uint64_t bit) { bytes()[bit / 8] ^= static_cast<unsigned char>(1U << (bit % 8)); }

  std::int32_t process(std::uint32_t frame, pose_wall_result* result) {
    const pose_wall_cloud cloud = cloud_of(room_frame(frame), frame * kPeriod_ns);
    return pose_wall_process(engine_, &cloud, result);
  }
  pose_wall_result processed(std::uint32_t frame) {
    pose_wall_result result{};
    result.struct_size = sizeof result;
    EXPECT_EQ(process(frame, &result), POSE_WALL_OK);
    return result;
  }

 private:
  static std::uint64_t needed(const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    (void)pose_wall_memory_needed(&config, &bytes);
    return bytes;
  }

  pose_wall_config config_;
  AlignedBlock block_;
  pose_wall_engine* engine_ = nullptr;
};

TEST(BitFlips, EveryBitOfWhatLivesOnIsNoticed) {
  OpenBlock disturbed, undisturbed;
  disturbed.processed(0);
  undisturbed.processed(0);
  const pose_wall_cloud cloud = cloud_of(room_frame(1), kPeriod_ns);
  pose_wall_result result, before;
  std::memset(&result, 0x5A, sizeof result);
  result.struct_size = sizeof result;
  before = result;
  std::uint64_t unnoticed = 0;
  for (std::uint64_t bit = 0; bit < 8 * Engine::guarded_bytes(); ++bit) {
    disturbed.flip(bit);
    const std::int32_t status = pose_wall_process(disturbed.engine(), &cloud, &result);
    if (status != POSE_WALL_E_ENGINE || !same(result, before)) {
      ++unnoticed;
      ADD_FAILURE() << "byte " << bit / 8 << " bit " << bit % 8 << ": " << pose_wall_status_text(status);
      if (unnoticed > 9) return;
    }
    disturbed.flip(bit);
  }
  // Put right again, nothing has happened.
  EXPECT_TRUE(same(disturbed.processed(1), undisturbed.processed(1)));
}

TEST(BitFlips, ManyBitsOfWhatLivesOnAreNoticed) {
  OpenBlock block;
  block.processed(0);
  std::mt19937 random(1);
  pose_wall_result result{};
  result.struct_size = sizeof result;
  for (std::uint32_t round = 0; round < 20000; ++round) {
    std::uint64_t bits[8];
    const std::uint32_t count = 2 + round % 7;
    for (std::uint32_t i = 0; i < count; ++i) bits[i] = (random() % Engine::guarded_bytes()) * 8 + i;  // all different
    for (std::uint32_t i = 0; i < count; ++i) block.flip(bits[i]);
    ASSERT_EQ(pose_wall_age(block.engine(), 0, &result), POSE_WALL_E_ENGINE) << round;
    for (std::uint32_t i = 0; i < count; ++i) block.flip(bits[i]);
  }
}

// That every other call refuses it as well is in tests/abi/refusals.
TEST(BitFlips, ADamagedEngineServesAgainOnceItIsOpened) {
  OpenBlock block;
  block.processed(0);
  block.flip(8 * 8 * (Engine::guarded_bytes() / 16) + 40);  // some double
  pose_wall_result result{};
  result.struct_size = sizeof result;
  EXPECT_EQ(block.process(1, &result), POSE_WALL_E_ENGINE);
  EXPECT_EQ(block.process(1, &result), POSE_WALL_E_ENGINE);
  block.open();
  const pose_wall_result fresh = block.processed(1);
  EXPECT_EQ(fresh.frame_index, 0U);
  EXPECT_EQ(states_of(fresh), "VVVVVVV");
}

// What lives on is all that does: whatever is written to the rest between two frames, the next has the same bits.
TEST(BitFlips, TheScratchMayHoldAnything) {
  OpenBlock disturbed, undisturbed;
  disturbed.processed(0);
  undisturbed.processed(0);
  std::mt19937 random(2);
  for (std::uint32_t round = 1; round <= 12; ++round) {
    unsigned char* const scratch = disturbed.bytes() + Engine::guarded_bytes();
    const std::uint64_t count = disturbed.size() - Engine::guarded_bytes();
    for (std::uint64_t i = 0; i < count; ++i) {
      const unsigned char all[] = {static_cast<unsigned char>(~scratch[i]), 0, 0xFF,
                                   static_cast<unsigned char>(round > 3 ? random() : 0)};
      scratch[i] = all[std::min(round - 1, 3U)];
    }
    ASSERT_TRUE(same(disturbed.processed(round), undisturbed.processed(round))) << "round " << round;
  }
}

TEST(BitFlips, SingleBitsOfTheScratchHaveNoEffect) {
  OpenBlock disturbed, undisturbed;
  disturbed.processed(0);
  undisturbed.processed(0);
  std::mt19937_64 random(3);
  for (std::uint32_t round = 1; round <= 60; ++round) {
    const std::uint64_t scratch_bits = 8 * (disturbed.size() - Engine::guarded_bytes());
    disturbed.flip(8 * Engine::guarded_bytes() + random() % scratch_bits);
    ASSERT_TRUE(same(disturbed.processed(round), undisturbed.processed(round))) << "round " << round;
  }
}

}  // namespace
}  // namespace pose_wall::test

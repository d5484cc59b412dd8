// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: words, defaults and ranges of pose_wall_motion.h; a block may hold anything and two motions do not meet; a
// reset motion is a fresh one; a second call meanwhile is refused; no call takes memory. What else is refused is in
// abi/refusals.

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "apps/soak/heap_count.hpp"
#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/garbage.hpp"
#include "support/motion_contract.hpp"
#include "support/motion_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kMotionPeriod_ns = 100000000;

// A ribbed road, seen from a place that moves.
std::vector<Points> ribbed_frames(std::uint32_t count) {
  std::vector<Points> frames;
  for (std::uint32_t i = 0; i < count; ++i) frames.push_back(ribbed_room_points(i + 1));
  return frames;
}

std::vector<pose_wall_motion_result> results_of(MotionUnderTest& motion, const std::vector<Points>& frames) {
  std::vector<pose_wall_motion_result> results;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    results.push_back(motion.process(cloud_of(frames[i], static_cast<std::int64_t>(i) * kMotionPeriod_ns)));
  }
  return results;
}

bool same_bits(const std::vector<pose_wall_motion_result>& a, const std::vector<pose_wall_motion_result>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

// ------------------------------------------------------------------------------------------ words

TEST(MotionWords, AreThoseOfTheHeader) {
  EXPECT_EQ(pose_wall_motion_abi_version(), static_cast<std::uint32_t>(POSE_WALL_MOTION_ABI_VERSION));
  const char* const states[] = {"lost", "unobservable", "ambiguous", "measured"};
  for (std::uint32_t s = 0; s < 4; ++s) EXPECT_STREQ(pose_wall_motion_along_state_name(s), states[s]);
  const char* const directions[] = {"along", "across", "up", "roll", "pitch", "yaw"};
  for (std::uint32_t d = 0; d < 6; ++d) EXPECT_STREQ(pose_wall_motion_direction_name(d), directions[d]);
  const char* const reasons[] = {"first",         "few_points",  "few_matches", "smooth",    "few_patches",
                                 "halves_differ", "second_peak", "at_edge",     "no_ground", "stamp",
                                 "gap",           "prior",       "map_full",    "repeated"};
  static_assert(std::size(reasons) == POSE_WALL_MOTION_REASON_COUNT);
  std::set<std::string> texts;
  for (std::uint32_t r = 0; r < POSE_WALL_MOTION_REASON_COUNT; ++r) {
    EXPECT_STREQ(pose_wall_motion_reason_name(r), reasons[r]);
    const std::string text = pose_wall_motion_reason_text(r);
    EXPECT_EQ(text.back(), '.') << text;
    EXPECT_TRUE(texts.insert(text).second) << text;
  }
  for (const std::uint32_t none : {4U, 6U, 14U, 31U, 32U, 0xFFFFFFFFU}) {
    if (none >= 4) {
      EXPECT_STREQ(pose_wall_motion_along_state_name(none), "unknown");
    }
    if (none >= 6) {
      EXPECT_STREQ(pose_wall_motion_direction_name(none), "unknown");
    }
    if (none >= 14) {
      EXPECT_STREQ(pose_wall_motion_reason_name(none), "unknown");
      EXPECT_STREQ(pose_wall_motion_reason_text(none), "unknown reason");
    }
  }
}

// ------------------------------------------------------------------------------------------ settings

TEST(MotionSettings, DefaultsAreThoseOfTheHeader) {
  pose_wall_motion_settings settings;
  std::memset(&settings, 0x5A, sizeof settings);
  ASSERT_EQ(pose_wall_motion_settings_init(&settings), POSE_WALL_OK);
  EXPECT_EQ(settings.struct_size, sizeof settings);
  EXPECT_EQ(settings.reserved, 0U);
  EXPECT_EQ(settings.speed_max_m_s, 2.0);
  EXPECT_NEAR(settings.turn_max_rad_s, M_PI / 2, 1e-12);
  EXPECT_EQ(settings.range_max_m, 30.0);
  EXPECT_EQ(settings.keyframe_m, 0.2);
  EXPECT_EQ(pose_wall_motion_settings_check(&settings, nullptr), POSE_WALL_OK);
}

// That both ends are taken and nothing beyond is in tests/planar/settings_test.cpp.
TEST(MotionSettings, BothEndsOfEachRangeOpen) {
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) \
  for (const double end : {double{least}, double{most}}) {               \
    pose_wall_motion_settings settings = motion_settings();              \
    settings.name = end;                                                 \
    MotionUnderTest opens(config_with(), Dirt::kRandom, settings);       \
  }
#include "pose_wall_motion_settings.def"
}

// ------------------------------------------------------------------------------------------ memory

TEST(MotionMemory, StaysWithinItsBound) {
  EXPECT_LE(pose_wall_motion_memory_needed(), 6U << 20U);
  EXPECT_GT(pose_wall_motion_memory_needed(), 1U << 20U);
  EXPECT_EQ(pose_wall_motion_memory_needed() % POSE_WALL_BLOCK_ALIGNMENT, 0U);
}

TEST(MotionMemory, NullSettingsAreTheDefaults) {
  const std::vector<Points> frames = ribbed_frames(4);
  const pose_wall_config config = config_with();
  MotionUnderTest with(config);
  AlignedBlock block(pose_wall_motion_memory_needed(), Dirt::kRandom);
  pose_wall_motion* motion = nullptr;
  ASSERT_EQ(pose_wall_motion_open(&config, nullptr, block.data(), block.size(), &motion), POSE_WALL_OK);
  const auto expected = results_of(with, frames);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    pose_wall_motion_result result = blank_motion_result();
    const pose_wall_cloud cloud = cloud_of(frames[i], static_cast<std::int64_t>(i) * kMotionPeriod_ns);
    ASSERT_EQ(pose_wall_motion_process(motion, &cloud, &result), POSE_WALL_OK);
    EXPECT_EQ(std::memcmp(&result, &expected[i], sizeof result), 0) << i;
  }
}

TEST(MotionMemory, WhatTheBlockHeldChangesNoBit) {
  const std::vector<Points> frames = ribbed_frames(8);
  MotionUnderTest zeros(config_with(), Dirt::kZeros);
  const auto expected = results_of(zeros, frames);
  for (const Dirt dirt : {Dirt::kOnes, Dirt::kRandom}) {
    MotionUnderTest other(config_with(), dirt);
    EXPECT_TRUE(same_bits(results_of(other, frames), expected));
  }
  AlignedBlock block(pose_wall_motion_memory_needed(), Dirt::kZeros);
  std::memset(block.data(), 0x5A, block.size());
  const pose_wall_config config = config_with();
  pose_wall_motion* motion = nullptr;
  for (int again = 0; again < 2; ++again) {  // the second time over the first one's own memory
    ASSERT_EQ(pose_wall_motion_open(&config, nullptr, block.data(), block.size(), &motion), POSE_WALL_OK);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      pose_wall_motion_result result = blank_motion_result();
      const pose_wall_cloud cloud = cloud_of(frames[i], static_cast<std::int64_t>(i) * kMotionPeriod_ns);
      ASSERT_EQ(pose_wall_motion_process(motion, &cloud, &result), POSE_WALL_OK);
      ASSERT_EQ(std::memcmp(&result, &expected[i], sizeof result), 0) << again << " " << i;
    }
  }
}

TEST(MotionMemory, TwoInterleavedAreTwoAlone) {
  const std::vector<Points> some = ribbed_frames(6);
  std::vector<Points> others;
  for (std::uint32_t i = 0; i < 6; ++i) others.push_back(room_points(40 + i, 0.5));
  MotionUnderTest a(config_with()), b(config_with());
  const auto expected_a = results_of(a, some), expected_b = results_of(b, others);
  MotionUnderTest c(config_with()), d(config_with());
  std::vector<pose_wall_motion_result> found_c, found_d;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const auto stamp = static_cast<std::int64_t>(i) * kMotionPeriod_ns;
    found_c.push_back(c.process(cloud_of(some[i], stamp)));
    found_d.push_back(d.process(cloud_of(others[i], stamp)));
  }
  EXPECT_TRUE(same_bits(found_c, expected_a));
  EXPECT_TRUE(same_bits(found_d, expected_b));
}

// All bits but the name of the run: that of each start is its own.
bool same_but_for_the_run(std::vector<pose_wall_motion_result> a, const std::vector<pose_wall_motion_result>& b) {
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    if ((a[i].run == 0) != (b[i].run == 0)) return false;
    a[i].run = b[i].run;
  }
  return same_bits(a, b);
}

TEST(MotionMemory, AResetMotionIsAFreshOne) {
  const std::vector<Points> frames = ribbed_frames(6);
  MotionUnderTest fresh(config_with()), used(config_with());
  const auto expected = results_of(fresh, frames);
  results_of(used, {room_points(70, 0.8), Points(), room_points(71, -0.8), frames[3], frames[4]});
  used.reset();
  EXPECT_TRUE(same_but_for_the_run(results_of(used, frames), expected));
  used.reset();
  used.reset();
  EXPECT_TRUE(same_but_for_the_run(results_of(used, frames), expected));
}

// ------------------------------------------------------------------------------------------ process

class MotionProcess : public ::testing::Test {
 protected:
  MotionUnderTest motion_{config_with()};
  const Points points_ = room_points(1);
};

// A cloud of before there was a ring ends where the memory ends.
TEST_F(MotionProcess, TakesAShorterCloudAndReadsNothingBehindIt) {
  constexpr std::size_t kShort = offsetof(pose_wall_cloud, ring);
  std::vector<unsigned char> memory(kShort);
  pose_wall_cloud whole = cloud_of(points_, 0);
  whole.struct_size = kShort;
  std::memcpy(memory.data(), &whole, kShort);
  pose_wall_motion_result result = blank_motion_result();
  const auto* const cloud = reinterpret_cast<const pose_wall_cloud*>(memory.data());
  EXPECT_EQ(pose_wall_motion_process(motion_.get(), cloud, &result), POSE_WALL_OK);
  whole.ring = {0xFFFFFFFFU, 77};  // what happens to lie behind it
  EXPECT_EQ(pose_wall_motion_process(motion_.get(), &whole, &result), POSE_WALL_OK);
}

TEST_F(MotionProcess, ResultsAreMarkedAndCounted) {
  for (std::uint64_t i = 0; i < 3; ++i) {
    const auto stamp = static_cast<std::int64_t>(i) * kMotionPeriod_ns;
    const pose_wall_motion_result r = motion_.process(cloud_of(points_, stamp));
    EXPECT_EQ(r.frame_index, i);
    EXPECT_EQ(r.stamp_ns, stamp);
    EXPECT_NE(r.mark, 0U);
    EXPECT_EQ(r.points_in, points_.size());
    EXPECT_EQ(broken_motion(r), nullptr) << broken_motion(r);
  }
}

TEST_F(MotionProcess, ASecondCallMeanwhileIsRefused) {
  std::vector<Points> frames;
  for (std::uint32_t i = 0; i < 4; ++i) frames.push_back(room_points(i));
  MotionUnderTest alone(config_with());
  const auto expected = results_of(alone, frames);
  std::atomic<bool> done{false};
  std::atomic<std::uint32_t> busy{0}, other{0};
  std::thread asks([&] {
    while (!done) {
      std::uint32_t total = 0;
      const std::int32_t status = pose_wall_motion_map(motion_.get(), 0, nullptr, 0, &total);
      if (status == POSE_WALL_E_BUSY) ++busy;
      if (status != POSE_WALL_E_BUSY && status != POSE_WALL_OK) ++other;
    }
  });
  // Whichever of the two was inside first, the other is refused; who is refused asks again.
  std::vector<pose_wall_motion_result> found;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    pose_wall_motion_result result = blank_motion_result();
    const pose_wall_cloud cloud = cloud_of(frames[i], static_cast<std::int64_t>(i) * kMotionPeriod_ns);
    std::int32_t status = POSE_WALL_E_BUSY;
    while (status == POSE_WALL_E_BUSY) status = pose_wall_motion_process(motion_.get(), &cloud, &result);
    EXPECT_EQ(status, POSE_WALL_OK);
    found.push_back(result);
  }
  done = true;
  asks.join();
  EXPECT_TRUE(same_bits(found, expected));
  EXPECT_GT(busy.load(), 0U);
  EXPECT_EQ(other.load(), 0U);
}

// ------------------------------------------------------------------------------------------ map

TEST_F(MotionProcess, TheMapComesInParts) {
  results_of(motion_, ribbed_frames(3));
  std::uint32_t total = 0;
  ASSERT_EQ(pose_wall_motion_map(motion_.get(), 0, nullptr, 0, &total), POSE_WALL_OK);
  ASSERT_GT(total, 100U);
  std::vector<float> all(3 * total), part(30, 1e9F);
  ASSERT_EQ(pose_wall_motion_map(motion_.get(), 0, all.data(), total, &total), POSE_WALL_OK);
  std::uint32_t on_walls = 0;
  for (std::uint32_t i = 0; i < total; ++i) {
    ASSERT_TRUE(std::isfinite(all[3 * i]) && std::isfinite(all[3 * i + 1]) && std::isfinite(all[3 * i + 2]));
    on_walls += std::fabs(std::fabs(all[3 * i + 1]) - 2.45F) < 0.2F ? 1U : 0U;
  }
  EXPECT_GT(on_walls, total / 5);
  ASSERT_EQ(pose_wall_motion_map(motion_.get(), 11, part.data(), 5, &total), POSE_WALL_OK);
  EXPECT_TRUE(std::equal(part.begin(), part.begin() + 15, all.begin() + 33));
  EXPECT_EQ(part[15], 1e9F);
  for (const std::uint32_t first : {total, 0xFFFFFFFFU}) {
    part[0] = 1e9F;
    EXPECT_EQ(pose_wall_motion_map(motion_.get(), first, part.data(), 10, &total), POSE_WALL_OK);
    EXPECT_EQ(part[0], 1e9F);
  }
  motion_.reset();
  EXPECT_EQ(pose_wall_motion_map(motion_.get(), 0, nullptr, 0, &total), POSE_WALL_OK);
  EXPECT_EQ(total, 0U);
}

// ------------------------------------------------------------------------------------------ heap

TEST(MotionHeap, NoCallAllocates) {
  std::vector<Points> frames = ribbed_frames(5);
  frames.insert(frames.begin() + 3, Points());
  Points garbage(20000);
  std::mt19937 random(3);
  for (auto& p : garbage) {
    for (float& c : p) c = any_bits(&random);
  }
  frames.push_back(garbage);
  const pose_wall_config config = config_with();
  AlignedBlock block(pose_wall_motion_memory_needed(), Dirt::kRandom);
  std::vector<float> map(3000);
  std::int32_t worst = POSE_WALL_OK;
  const auto note = [&](std::int32_t status) { worst = status < worst ? status : worst; };
  tools::start_counting_heap_calls();
  pose_wall_motion_settings settings;
  pose_wall_motion* motion = nullptr;
  pose_wall_motion_result result = blank_motion_result();
  std::uint32_t total = 0;
  note(pose_wall_motion_settings_init(&settings));
  note(pose_wall_motion_settings_check(&settings, nullptr));
  note(pose_wall_motion_open(&config, &settings, block.data(), block.size(), &motion));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const pose_wall_cloud cloud = cloud_of(frames[i], static_cast<std::int64_t>(i) * kMotionPeriod_ns);
    note(pose_wall_motion_process(motion, &cloud, &result));
  }
  note(pose_wall_motion_map(motion, 0, map.data(), 1000, &total));
  note(pose_wall_motion_reset(motion));
  EXPECT_EQ(tools::stop_counting_heap_calls(), 0U);
  EXPECT_EQ(worst, POSE_WALL_OK);
}

}  // namespace
}  // namespace pose_wall::test

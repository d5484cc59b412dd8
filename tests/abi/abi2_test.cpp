// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a cloud of before there was a ring is read as far as it goes. Two calls at once do not meet inside an engine.
// A result tells which engine made it. The frame's inputs do what pose_wall.h says. What was saved is held only as far
// as it can be dated. Does not prove that every race is caught: only that the second call is refused while the first is
// known to be inside. What is refused is in abi/refusals.

#include <gtest/gtest.h>

#include <condition_variable>
#include <cstddef>
#include <cstring>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/moments.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kPeriod_ns = 100000000;
constexpr std::uint32_t kCloudBytesBeforeRing = offsetof(pose_wall_cloud, ring);

pose_wall_result blank_result() {
  pose_wall_result result{};
  result.struct_size = sizeof result;
  return result;
}

// A program that was compiled before ring was there has room for no more than this.
TEST(ShorterCloud, IsFilledUpToItsEndAndNoFurther) {
  struct {
    unsigned char cloud[kCloudBytesBeforeRing], behind[64];
  } memory, before;
  std::memset(&memory, 0x5A, sizeof memory);
  before = memory;
  const float point[3] = {1.0F, 2.0F, 3.0F};
  auto* const cloud = reinterpret_cast<pose_wall_cloud*>(memory.cloud);
  ASSERT_EQ(pose_wall_cloud_xyz32_2(cloud, point, 1, sizeof point, 7), POSE_WALL_OK);
  EXPECT_EQ(std::memcmp(memory.behind, before.behind, sizeof memory.behind), 0);
  std::uint32_t size = 0;
  std::memcpy(&size, memory.cloud, sizeof size);
  EXPECT_EQ(size, kCloudBytesBeforeRing);
  pose_wall_cloud now;
  ASSERT_EQ(pose_wall_cloud_xyz32(&now, point, 1, sizeof point, 7), POSE_WALL_OK);
  EXPECT_EQ(now.struct_size, sizeof now);
  EXPECT_EQ(now.ring.type, static_cast<std::uint32_t>(POSE_WALL_FIELD_NONE));
  now.struct_size = size;
  EXPECT_EQ(std::memcmp(&now, memory.cloud, sizeof memory.cloud), 0) << "what it knows is the same";
}

TEST(ShorterCloud, GivesTheSameBitsAndNothingBehindItIsRead) {
  const Points points = room_points(1);
  EngineUnderTest whole(small_config()), shorter(small_config());
  pose_wall_cloud cloud = cloud_of(points, 0);
  const pose_wall_result expected = whole.process(cloud);
  cloud.struct_size = kCloudBytesBeforeRing;
  cloud.ring = {0xFFFFFFFFU, 77};  // what happens to lie there
  EXPECT_EQ(pose_wall_cloud_check(&cloud), POSE_WALL_OK);
  const pose_wall_result found = shorter.process(cloud);
  EXPECT_EQ(std::memcmp(&found, &expected, sizeof found), 0);
  cloud.struct_size = sizeof cloud;
  EXPECT_NE(pose_wall_cloud_check(&cloud), POSE_WALL_OK) << "in the whole struct it is no field";
}

// The engine's clock is the one place where the caller's code runs inside a call.
struct Door {
  std::mutex mutex;
  std::condition_variable changed;
  bool inside = false, may_leave = false;

  static std::int64_t wait(void* user) {
    Door& door = *static_cast<Door*>(user);
    std::unique_lock<std::mutex> lock(door.mutex);
    door.inside = true;
    door.changed.notify_all();
    door.changed.wait(lock, [&] { return door.may_leave; });
    return 0;
  }
};

TEST(Busy, ASecondCallIsRefusedAndTheFirstIsNotDisturbed) {
  const pose_wall_config config = small_config();
  EngineUnderTest engine(config), alone(config);
  const Points points = room_points(1);
  const pose_wall_cloud cloud = cloud_of(points, 0);
  const pose_wall_result expected = alone.process(cloud);
  Door door;
  ASSERT_EQ(pose_wall_set_clock(engine.get(), Door::wait, &door), POSE_WALL_OK);
  pose_wall_result first = blank_result();
  std::int32_t first_status = 1;
  std::thread other([&] { first_status = pose_wall_process(engine.get(), &cloud, &first); });
  {
    std::unique_lock<std::mutex> lock(door.mutex);
    door.changed.wait(lock, [&] { return door.inside; });
  }
  pose_wall_result second = blank_result();
  EXPECT_EQ(pose_wall_process(engine.get(), &cloud, &second), POSE_WALL_E_BUSY);
  std::uint64_t bytes = 0;
  pose_wall_engine* again = nullptr;
  ASSERT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_open(&config, engine.get(), bytes, &again), POSE_WALL_E_BUSY) << "its block is in use";
  EXPECT_EQ(again, nullptr);
  {
    const std::lock_guard<std::mutex> lock(door.mutex);
    door.may_leave = true;
  }
  door.changed.notify_all();
  other.join();
  EXPECT_EQ(first_status, POSE_WALL_OK);
  EXPECT_EQ(std::memcmp(&first, &expected, sizeof first), 0);
  EXPECT_EQ(pose_wall_reset(engine.get()), POSE_WALL_OK) << "nobody is inside any more";
}

TEST(Result, TellsWhoMadeItAndCountsPublications) {
  const pose_wall_config config = config_with({{"source_id", "7"}});
  EngineUnderTest engine(config);
  std::uint32_t crc = 0;
  ASSERT_EQ(pose_wall_config_crc(&config, &crc), POSE_WALL_OK);
  const Points points = room_points(1);
  for (std::uint64_t i = 0; i < 3; ++i) {
    const pose_wall_result frame = engine.process(cloud_of(points, static_cast<std::int64_t>(i) * kPeriod_ns));
    EXPECT_EQ(frame.config_crc32, crc);
    EXPECT_EQ(frame.source_id, 7U);
    EXPECT_EQ(frame.frame_index, i);
    EXPECT_EQ(frame.publication, 2 * i + 1);
    pose_wall_result aged = blank_result();
    ASSERT_EQ(pose_wall_age(engine.get(), static_cast<std::int64_t>(i) * kPeriod_ns + 1, &aged), POSE_WALL_OK);
    EXPECT_EQ(aged.frame_index, i);
    EXPECT_EQ(aged.publication, 2 * i + 2) << "news, though no frame has come";
    EXPECT_NE(aged.mark, frame.mark);
  }
}

// Roll is positive where the side at -Y is down, pitch where the one at +X is: in words for each forward axis.
TEST(Result, SaysWhatPositiveAnglesMean) {
  const struct {
    const char* axis;
    std::uint32_t roll, pitch;
  } expected[] = {{"+X", POSE_WALL_SENSE_RIGHT_DOWN, POSE_WALL_SENSE_NOSE_DOWN},
                  {"-X", POSE_WALL_SENSE_LEFT_DOWN, POSE_WALL_SENSE_NOSE_UP},
                  {"+Y", POSE_WALL_SENSE_NOSE_UP, POSE_WALL_SENSE_RIGHT_DOWN},
                  {"-Y", POSE_WALL_SENSE_NOSE_DOWN, POSE_WALL_SENSE_LEFT_DOWN}};
  for (const auto& row : expected) {
    EngineUnderTest engine(config_with({{"forward_axis", row.axis}}));
    const pose_wall_result r = engine.process(cloud_of(room_points(1), 0));
    EXPECT_EQ(r.positive_means[0], row.roll) << row.axis;
    EXPECT_EQ(r.positive_means[1], row.pitch) << row.axis;
    EXPECT_EQ(r.positive_means[2], static_cast<std::uint32_t>(POSE_WALL_SENSE_TURNED_RIGHT)) << row.axis;
  }
}

class Inputs : public ::testing::Test {
 protected:
  pose_wall_inputs inputs_{};
  EngineUnderTest engine_{small_config()};
  const Points points_ = room_points(1);

  void SetUp() override { inputs_.struct_size = sizeof inputs_; }
  pose_wall_cloud cloud(std::int64_t stamp_ns) {
    pose_wall_cloud cloud = cloud_of(points_, stamp_ns);
    cloud.inputs = &inputs_;
    return cloud;
  }
};

// The same as the config's body box, frame by frame.
TEST_F(Inputs, ABoxTakesItsPointsOutInThisFrameOnly) {
  const double box[6] = {0.5, 6.0, -0.8, 0.8, -2.0, 2.0};
  std::memcpy(inputs_.body_box[2], box, sizeof box);
  const pose_wall_result with = engine_.process(cloud(0));
  EXPECT_GT(with.dropped_body, 0U);
  EXPECT_EQ(with.frame_reasons & POSE_WALL_R_PRIOR, 0U);
  pose_wall_config config = small_config();
  set(&config, "body_box_1", "0.5 6.0 -0.8 0.8 -2.0 2.0");
  EngineUnderTest by_config(config);
  EXPECT_EQ(by_config.process(cloud_of(points_, 0)).dropped_body, with.dropped_body);
  inputs_ = pose_wall_inputs{};
  inputs_.struct_size = sizeof inputs_;
  EXPECT_EQ(engine_.process(cloud(kPeriod_ns)).dropped_body, 0U);
}

TEST_F(Inputs, WhatIsNoNumberIsLeftOutAndSaid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const pose_wall_result without = engine_.process(cloud(0));
  inputs_.body_box[0][3] = nan;
  const pose_wall_result by_box = engine_.process(cloud(kPeriod_ns));
  EXPECT_NE(by_box.frame_reasons & POSE_WALL_R_PRIOR, 0U);
  EXPECT_EQ(by_box.dropped_body, 0U);
  inputs_.body_box[0][3] = 0.0;
  inputs_.given = POSE_WALL_INPUT_SPEED;
  inputs_.speed_m_s = nan;
  inputs_.speed_sigma_m_s = 0.1;
  EXPECT_NE(engine_.process(cloud(2 * kPeriod_ns)).frame_reasons & POSE_WALL_R_PRIOR, 0U);
  inputs_.speed_m_s = 0.2;
  EXPECT_EQ(engine_.process(cloud(3 * kPeriod_ns)).frame_reasons & POSE_WALL_R_PRIOR, 0U);
  EXPECT_EQ(without.frame_reasons & POSE_WALL_R_PRIOR, 0U);
}

// What an engine held before the power went.
class AfterPowerLoss : public ::testing::Test {
 protected:
  static constexpr std::int64_t kBefore_ns = 3600LL * 1000000000, kWall_ns = 1700000000LL * 1000000000;

  AfterPowerLoss() {
    EngineUnderTest engine(config_);
    const pose_wall_result r = engine.process(cloud_of(room_points(1), kBefore_ns));
    value_ = r.quantity[POSE_WALL_ROLL].value;
    level_ = r.quantity[POSE_WALL_ROLL].protection_level;
    then_ = {sizeof then_, POSE_WALL_MOMENT_BOOT | POSE_WALL_MOMENT_WALL, {1, 2, 3}, kWall_ns, kBefore_ns};
    EXPECT_EQ(pose_wall_save(engine.get(), &then_, memento_.data(), memento_.size()), POSE_WALL_OK);
  }

  // Roll in the first frame, an empty one, after the load.
  pose_wall_value held(const pose_wall_moment* now, std::int64_t stamp_ns) {
    EngineUnderTest engine(config_);
    EXPECT_EQ(pose_wall_load(engine.get(), now, memento_.data(), memento_.size()), POSE_WALL_OK);
    return engine.process(cloud_of(Points(), stamp_ns)).quantity[POSE_WALL_ROLL];
  }

  const pose_wall_config config_ = [] {
    pose_wall_config config = small_config();
    set(&config, "alert_limit_angle_deg", "20");
    set(&config, "hold_max", "10");
    return config;
  }();
  double value_ = 0.0, level_ = 0.0;
  pose_wall_moment then_{};
  std::vector<unsigned char> memento_ = std::vector<unsigned char>(pose_wall_memento_bytes());
};

TEST_F(AfterPowerLoss, WhatNobodyCanDateIsNotHeld) {
  pose_wall_moment other_boot = {sizeof other_boot, POSE_WALL_MOMENT_BOOT, {9}, 0, kPeriod_ns};
  const pose_wall_moment* const none = nullptr;
  for (const pose_wall_moment* now : {none, static_cast<const pose_wall_moment*>(&other_boot)}) {
    // The uptime clock has begun anew, and happens to stand where it stood.
    const pose_wall_value v = held(now, kBefore_ns + kPeriod_ns);
    EXPECT_EQ(v.state, POSE_WALL_INVALID);
    EXPECT_NE(v.reasons & POSE_WALL_R_HOLD_EXPIRED, 0U);
    EXPECT_EQ(v.confidence, 0.0);
  }
}

TEST_F(AfterPowerLoss, InTheSameBootItIsHeldByTheStamps) {
  pose_wall_moment now = then_;
  const pose_wall_value v = held(&now, kBefore_ns + kPeriod_ns);
  EXPECT_EQ(v.state, POSE_WALL_HELD);
  EXPECT_EQ(v.value, value_);
  EXPECT_NEAR(v.age_s, 0.1, 1e-9);
}

TEST_F(AfterPowerLoss, TheWallClockDatesIt) {
  pose_wall_moment now = {sizeof now, POSE_WALL_MOMENT_BOOT | POSE_WALL_MOMENT_WALL, {9}, kWall_ns + 3000000000, 50};
  const pose_wall_value v = held(&now, 50 + kPeriod_ns);
  EXPECT_EQ(v.state, POSE_WALL_HELD);
  EXPECT_NEAR(v.age_s, 3.1, 1e-6);
  EXPECT_NEAR(v.protection_level, level_ + 0.05 * 3.1, 1e-6) << "hold_rate_angle";
  now.wall_ns = kWall_ns + 60000000000;
  EXPECT_EQ(held(&now, 50 + kPeriod_ns).state, POSE_WALL_INVALID) << "a minute is beyond hold_max";
  now.wall_ns = kWall_ns - 1;
  EXPECT_EQ(held(&now, 50 + kPeriod_ns).state, POSE_WALL_INVALID) << "it went back";
}

}  // namespace
}  // namespace pose_wall::test

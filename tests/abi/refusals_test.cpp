// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every call that is refused says why by the status in the header, and changes nothing: no config, no result,
// no engine, no pointer. Clouds whose descriptions lie are in tests/faults.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <vector>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

template <typename T, typename Call>
std::int32_t unchanged_by(T* object, const Call& call) {
  std::vector<unsigned char> before(sizeof(T));
  std::memcpy(before.data(), object, sizeof(T));
  const std::int32_t status = call();
  EXPECT_EQ(std::memcmp(before.data(), object, sizeof(T)), 0) << "status " << status;
  return status;
}

TEST(AbiRefusals, NullPointersEverywhere) {
  pose_wall_config config = config_with();
  pose_wall_key_info info;
  std::uint64_t bytes = 7;
  double number = 7.0;
  char text[8] = "seven";
  EXPECT_EQ(pose_wall_config_init(nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_set(nullptr, "a", "b"), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_set(&config, nullptr, "b"), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_set(&config, "a", nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_set_number(nullptr, "a", 1), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_set_number(&config, nullptr, 1), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_number(nullptr, "a", &number), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_number(&config, nullptr, &number), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_number(&config, "range_min", nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_box(&config, "body_box_1", nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_text(&config, "lidar_frame", nullptr, 8), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_text(nullptr, "lidar_frame", text, 8), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_key(0, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_key(9999, &info), POSE_WALL_E_INDEX);
  EXPECT_EQ(pose_wall_config_check(nullptr, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_memory_needed(nullptr, &bytes), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_memory_needed(&config, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_cloud_xyz32(nullptr, text, 1, 12, 0), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_reset(nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_set_clock(nullptr, nullptr, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_last_points(nullptr, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(bytes, 7U);
  EXPECT_EQ(number, 7.0);
  EXPECT_STREQ(text, "seven");
}

TEST(AbiRefusals, NullPointersForEveryParameterOfAnEngine) {
  const pose_wall_config config = config_with();
  EngineUnderTest engine(config);
  pose_wall_engine* const e = engine.get();
  pose_wall_engine* other = nullptr;
  pose_wall_cloud cloud;
  pose_wall_points points;
  double box[6];
  char text[8] = "", block[8];
  pose_wall_result result{};
  result.struct_size = sizeof result;
  ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, 0), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_process(nullptr, &cloud, &result), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_process(e, nullptr, &result), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_process(e, &cloud, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_last_points(e, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_last_points(nullptr, &points), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_open(nullptr, block, sizeof block, &other), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_open(&config, nullptr, sizeof block, &other), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_open(&config, block, sizeof block, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_box(nullptr, "body_box_1", box), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_box(&config, nullptr, box), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_config_get_text(&config, nullptr, text, sizeof text), POSE_WALL_E_NULL);
  EXPECT_EQ(other, nullptr);
}

TEST(AbiRefusals, ReadingWhatIsNoConfigAndKeysThatAreNone) {
  const pose_wall_config config = config_with();
  pose_wall_config none = config;
  none.layout += 1;
  double number = 7.0, box[6] = {7.0};
  char text[8] = "seven";
  EXPECT_EQ(pose_wall_config_get_number(&config, "no_such_key", &number), POSE_WALL_E_KEY_UNKNOWN);
  EXPECT_EQ(pose_wall_config_get_box(&config, "no_such_key", box), POSE_WALL_E_KEY_UNKNOWN);
  EXPECT_EQ(pose_wall_config_get_text(&config, "no_such_key", text, sizeof text), POSE_WALL_E_KEY_UNKNOWN);
  EXPECT_EQ(pose_wall_config_get_box(&none, "body_box_1", box), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(number, 7.0);
  EXPECT_EQ(box[0], 7.0);
  EXPECT_STREQ(text, "seven");
}

// What is no number in which way, as the header tells the three statuses apart.
TEST(AbiRefusals, WhatIsNoNumberOrOutOfRange) {
  pose_wall_config config = config_with();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const char* text : {"nan", "NaN", "inf", "-inf", "infinity", ""}) {
    EXPECT_EQ(unchanged_by(&config, [&] { return pose_wall_config_set(&config, "range_max", text); }),
              POSE_WALL_E_VALUE_TYPE)
        << text;
  }
  for (const char* text : {"1e999", "-1e999", "201", "0"}) {
    EXPECT_EQ(unchanged_by(&config, [&] { return pose_wall_config_set(&config, "range_max", text); }),
              POSE_WALL_E_VALUE_RANGE)
        << text;
  }
  for (const double number : {nan, infinity, -infinity, 201.0}) {
    EXPECT_EQ(unchanged_by(&config, [&] { return pose_wall_config_set_number(&config, "range_max", number); }),
              POSE_WALL_E_VALUE_RANGE)
        << number;
  }
  EXPECT_EQ(pose_wall_config_set(&config, "points_max", "6000.5"), POSE_WALL_E_VALUE_TYPE);
  EXPECT_EQ(pose_wall_config_set_number(&config, "points_max", 6000.5), POSE_WALL_E_VALUE_TYPE);
  EXPECT_EQ(pose_wall_config_set_number(&config, "forward_axis", 1), POSE_WALL_E_VALUE_TYPE);
  EXPECT_EQ(pose_wall_config_set_number(&config, "body_box_1", 1), POSE_WALL_E_VALUE_TYPE);
  EXPECT_EQ(pose_wall_config_set(&config, "body_box_1", "1 0 0 1 0 1"), POSE_WALL_E_VALUE_RANGE);
  for (double& member : config.number) {
    pose_wall_rule_fault fault{};
    const double before = member;
    member = nan;
    const std::int32_t status = pose_wall_config_check(&config, &fault);
    EXPECT_TRUE(status == POSE_WALL_OK || (status == POSE_WALL_E_CONFIG_RULE && fault.key != nullptr));
    EXPECT_TRUE(&member != config.number || status == POSE_WALL_E_CONFIG_RULE);
    member = before;
  }
}

TEST(AbiRefusals, CloudsOfNoDataAreLeftAlone) {
  pose_wall_cloud cloud;
  std::memset(&cloud, 0x5A, sizeof cloud);
  EXPECT_EQ(unchanged_by(&cloud, [&] { return pose_wall_cloud_xyz32(&cloud, nullptr, 1, 12, 0); }), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, 0), POSE_WALL_OK);
}

TEST(AbiRefusals, BlocksTooSmallOrMisaligned) {
  const pose_wall_config config = config_with();
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
  AlignedBlock block(bytes + 64, Dirt::kZeros);
  pose_wall_engine* engine = nullptr;
  const auto open = [&](void* place, std::uint64_t size) {
    return unchanged_by(&engine, [&] { return pose_wall_open(&config, place, size, &engine); });
  };
  EXPECT_EQ(open(block.data(), bytes - 1), POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(open(block.data(), 0), POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(open(nullptr, bytes), POSE_WALL_E_NULL);
  for (const std::size_t off : {1U, 8U, 32U, 63U}) {
    EXPECT_EQ(open(static_cast<unsigned char*>(block.data()) + off, bytes), POSE_WALL_E_BLOCK_ALIGN) << off;
  }
  for (std::uint64_t i = 0; i < block.size(); ++i) {
    ASSERT_EQ(static_cast<unsigned char*>(block.data())[i], 0) << "a refused open wrote into the block";
  }
  EXPECT_EQ(pose_wall_open(&config, block.data(), bytes, &engine), POSE_WALL_OK);
}

TEST(AbiRefusals, BrokenConfigsOpenNothing) {
  const pose_wall_config broken = config_with({{"s_front", "-3"}});
  pose_wall_config uninitialised;
  std::memset(&uninitialised, 0, sizeof uninitialised);
  AlignedBlock block(64, Dirt::kZeros);
  pose_wall_engine* engine = nullptr;
  std::uint64_t bytes = 7;
  EXPECT_EQ(pose_wall_memory_needed(&broken, &bytes), POSE_WALL_E_CONFIG_RULE);
  EXPECT_EQ(pose_wall_open(&broken, block.data(), 1U << 30, &engine), POSE_WALL_E_CONFIG_RULE);
  pose_wall_rule_fault fault{"untouched", "", ""};
  EXPECT_EQ(pose_wall_config_check(&uninitialised, &fault), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_STREQ(fault.key, "untouched");
  EXPECT_EQ(pose_wall_config_check(&broken, &fault), POSE_WALL_E_CONFIG_RULE);
  EXPECT_STREQ(fault.key, "s_front");
  EXPECT_EQ(pose_wall_config_set(&uninitialised, "range_max", "9"), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_config_set_number(&uninitialised, "range_max", 9), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_memory_needed(&uninitialised, &bytes), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_open(&uninitialised, block.data(), 1U << 30, &engine), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(bytes, 7U);
  EXPECT_EQ(engine, nullptr);
}

TEST(AbiRefusals, WhatIsNoEngine) {
  AlignedBlock block(1 << 20, Dirt::kRandom);
  auto* const engine = static_cast<pose_wall_engine*>(block.data());
  const Points points = road_grid();
  const pose_wall_cloud cloud = cloud_of(points, 0);
  pose_wall_result result{};
  result.struct_size = sizeof result;
  pose_wall_points last;
  EXPECT_EQ(unchanged_by(&result, [&] { return pose_wall_process(engine, &cloud, &result); }), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_reset(engine), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_set_clock(engine, nullptr, nullptr), POSE_WALL_E_ENGINE);
  EXPECT_EQ(pose_wall_last_points(engine, &last), POSE_WALL_E_ENGINE);
}

// An engine that was moved by memcpy would point into its old block.
TEST(AbiRefusals, ACopiedBlockIsNoEngine) {
  const pose_wall_config config = config_with({{"points_max", "5000"}});
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
  AlignedBlock block(bytes, Dirt::kRandom), copy(bytes, Dirt::kZeros);
  pose_wall_engine* engine = nullptr;
  ASSERT_EQ(pose_wall_open(&config, block.data(), bytes, &engine), POSE_WALL_OK);
  std::memcpy(copy.data(), block.data(), bytes);
  EXPECT_EQ(pose_wall_reset(static_cast<pose_wall_engine*>(copy.data())), POSE_WALL_E_ENGINE);
}

TEST(AbiRefusals, AResultThatWasNotInitialisedIsLeftAlone) {
  EngineUnderTest engine(config_with());
  const Points points = road_grid();
  const pose_wall_cloud cloud = cloud_of(points, 0);
  pose_wall_result result;
  constexpr std::uint32_t kNow = sizeof result;
  for (const auto& [size, status] :
       {std::pair(0U, POSE_WALL_E_STRUCT_SIZE), std::pair(0x5A5A5A5AU, POSE_WALL_E_STRUCT_SIZE),
        std::pair(kNow - 1, POSE_WALL_E_STRUCT_SIZE), std::pair(kNow + 8, POSE_WALL_E_STRUCT_NEWER)}) {
    std::memset(&result, 0x5A, sizeof result);
    result.struct_size = size;
    EXPECT_EQ(unchanged_by(&result, [&] { return pose_wall_process(engine.get(), &cloud, &result); }), status);
  }
}

// Whatever the result held before, every byte of it is written.
TEST(AbiCalls, AResultIsBuiltAfresh) {
  const Points points = road_grid();
  EngineUnderTest a(config_with()), b(config_with());
  const pose_wall_cloud cloud = cloud_of(points, 0);
  pose_wall_result clean{}, dirty;
  clean.struct_size = sizeof clean;
  std::memset(&dirty, 0xFF, sizeof dirty);
  dirty.struct_size = sizeof dirty;
  ASSERT_EQ(pose_wall_process(a.get(), &cloud, &clean), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_process(b.get(), &cloud, &dirty), POSE_WALL_OK);
  EXPECT_EQ(std::memcmp(&clean, &dirty, sizeof clean), 0);
}

TEST(AbiCalls, HypothesesStayWithinTheirCaps) {
  EngineUnderTest engine(config_with({{"ground_iterations", "60"}, {"wall_iterations", "50"}}));
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    const pose_wall_result r = engine.process(cloud_of(room_points(frame), 100000000LL * frame));
    EXPECT_EQ(r.floor.iterations, 60U);
    EXPECT_LE(r.left.iterations, 54U);
    EXPECT_LE(r.right.iterations, 54U);
    EXPECT_GT(r.left.iterations, 50U) << "along the other wall";
  }
}

// Repeats under an old stamp are no frozen sensor, but they count when the next one has a new stamp.
TEST(AbiCalls, RepeatsUnderOldStampsCountForFrozenFrames) {
  const Points last = room_points(1);
  for (const int still : {0, 1, 2}) {
    EngineUnderTest engine(config_with({{"frozen_frames", "2"}}));
    engine.process(cloud_of(room_points(0), 0));
    engine.process(cloud_of(last, 100000000));
    for (int i = 0; i < still; ++i) {
      EXPECT_EQ(engine.process(cloud_of(last, 100000000)).frame_reasons & POSE_WALL_R_FROZEN, 0U);
    }
    const pose_wall_result r = engine.process(cloud_of(last, 200000000));
    EXPECT_NE(r.frame_reasons & POSE_WALL_R_FROZEN, 0U);
    EXPECT_EQ(r.quantity[POSE_WALL_ROLL].state,
              static_cast<std::uint32_t>(still < 2 ? POSE_WALL_DEGRADED : POSE_WALL_HELD))
        << still;
  }
}

TEST(AbiCalls, MemoryHangsOnPointsMaxOnly) {
  const auto needed = [](const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
    return bytes;
  };
  const std::uint64_t usual = needed(config_with());
  EXPECT_EQ(needed(config_with({{"voxel_leaf", "0.02"}, {"wall_iterations", "2000"}, {"forward_axis", "-Y"}})), usual);
  EXPECT_GT(needed(config_with({{"points_max", "120000"}})), usual);
  EXPECT_LT(needed(config_with({{"points_max", "5000"}})), usual);
  // Both ends of the range open.
  for (const char* points_max : {"5000", "400000"}) EngineUnderTest engine(config_with({{"points_max", points_max}}));
}

TEST(AbiCalls, AnEmptyCloudIsNoError) {
  EngineUnderTest engine(config_with());
  const pose_wall_result r = engine.process(cloud_of(Points(), 123));
  EXPECT_EQ(r.points_in, 0U);
  EXPECT_EQ(r.stamp_ns, 123);
  EXPECT_NE(r.frame_reasons & POSE_WALL_R_NO_POINTS, 0U);
  EXPECT_EQ(r.confidence, 0.0);
  for (const pose_wall_value& v : r.quantity) EXPECT_EQ(v.state, static_cast<std::uint32_t>(POSE_WALL_INVALID));
}

// The table in README.md. Less is good news, but the table is to say so.
TEST(Memory, IsWhatTheReadmeSays) {
  struct Row {
    double points_max, mebibytes;
  };
  for (const Row& row : {Row{16000, 1.8}, Row{60000, 4.5}, Row{131000, 9.5}}) {
    pose_wall_config config;
    ASSERT_EQ(pose_wall_config_init(&config), POSE_WALL_OK);
    ASSERT_EQ(pose_wall_config_set_number(&config, "points_max", row.points_max), POSE_WALL_OK);
    std::uint64_t bytes = 0;
    ASSERT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
    EXPECT_NEAR(static_cast<double>(bytes) / (1 << 20), row.mebibytes, 0.03 * row.mebibytes) << row.points_max;
  }
}

// 2^26 points of 128 bytes are 2^33 bytes: 0 with pointers of 32 bits, where reading would begin again at the start.
TEST(AbiRefusals, CloudsBeyondWhatPointersReach) {
  static const float one[3] = {};
  pose_wall_cloud cloud;
  ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, one, 1U << 26, 128, 0), POSE_WALL_OK);
  const std::int32_t status = sizeof(void*) == 4 ? POSE_WALL_E_CLOUD_SIZE : POSE_WALL_OK;
  EXPECT_EQ(pose_wall_cloud_check(&cloud), status);
}

}  // namespace
}  // namespace pose_wall::test

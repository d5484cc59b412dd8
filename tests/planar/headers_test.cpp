// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a caller of one part has learnt holds for the next. Every part gives its bytes in one shape, takes NULL
// for its default settings, refuses a struct of a newer header with one status, and its BLOCK_MOST is enough.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "pose_wall_motion.h"
#include "pose_wall_planar.h"
#include "support/aligned_block.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::test {
namespace {

// A struct as a newer header has it: eight bytes longer.
template <typename Struct>
struct Newer {
  Struct known{};
  std::uint64_t more = 0;
  Newer() { known.struct_size = sizeof(*this); }
};

template <typename Settings, typename Part>
struct Calls {
  std::int32_t (*settings_init)(Settings*);
  std::int32_t (*settings_check)(const Settings*, pose_wall_planar_fault*);
  std::int32_t (*memory_needed)(const Settings*, std::uint64_t*);
  std::int32_t (*open)(const Settings*, void*, std::uint64_t, Part**);
  std::uint64_t most;
};

template <typename Settings, typename Part>
void expect_common(const Calls<Settings, Part>& calls) {
  Settings settings;
  ASSERT_EQ(calls.settings_init(&settings), POSE_WALL_OK);
  EXPECT_EQ(calls.settings_init(nullptr), POSE_WALL_E_NULL);
  std::uint64_t bytes = 0, of_defaults = 0;
  EXPECT_EQ(calls.memory_needed(&settings, nullptr), POSE_WALL_E_NULL);
  ASSERT_EQ(calls.memory_needed(&settings, &bytes), POSE_WALL_OK);
  ASSERT_EQ(calls.memory_needed(nullptr, &of_defaults), POSE_WALL_OK);
  EXPECT_EQ(bytes, of_defaults);
  EXPECT_GT(bytes, 0U);
  EXPECT_LE(bytes, calls.most);
  EXPECT_LE(calls.most, 2 * bytes);  // no waste
  AlignedBlock block(bytes, Dirt::kRandom);
  Part* part = nullptr;
  EXPECT_EQ(calls.open(nullptr, block.data(), block.size(), &part), POSE_WALL_OK);
  EXPECT_NE(part, nullptr);
  Newer<Settings> newer;
  EXPECT_EQ(calls.settings_check(&newer.known, nullptr), POSE_WALL_E_STRUCT_NEWER);
  EXPECT_EQ(calls.memory_needed(&newer.known, &bytes), POSE_WALL_E_STRUCT_NEWER);
  EXPECT_EQ(bytes, of_defaults) << "what is refused tells no bytes";
  EXPECT_EQ(calls.open(&newer.known, block.data(), block.size(), &part), POSE_WALL_E_STRUCT_NEWER);
  newer.known.struct_size = 3;
  EXPECT_EQ(calls.settings_check(&newer.known, nullptr), POSE_WALL_E_STRUCT_SIZE);
}

std::int32_t open_scanner(const pose_wall_planar_scanner_settings* settings, void* block, std::uint64_t bytes,
                          pose_wall_planar_scanner** scanner) {
  const pose_wall_config config = config_with();
  return pose_wall_planar_scanner_open(&config, settings, block, bytes, scanner);
}

TEST(Headers, EveryPartWithSettingsIsOpenedAlike) {
  expect_common<pose_wall_planar_scanner_settings, pose_wall_planar_scanner>(
      {pose_wall_planar_scanner_settings_init, pose_wall_planar_scanner_settings_check,
       pose_wall_planar_scanner_memory_needed, open_scanner, POSE_WALL_PLANAR_SCANNER_BLOCK_MOST});
  expect_common<pose_wall_planar_slam_settings, pose_wall_planar_slam>(
      {pose_wall_planar_slam_settings_init, pose_wall_planar_slam_settings_check, pose_wall_planar_slam_memory_needed,
       pose_wall_planar_slam_open, POSE_WALL_PLANAR_SLAM_BLOCK_MOST});
  expect_common<pose_wall_planar_map_settings, pose_wall_planar_map>(
      {pose_wall_planar_map_settings_init, pose_wall_planar_map_settings_check, pose_wall_planar_map_memory_needed,
       pose_wall_planar_map_open, POSE_WALL_PLANAR_MAP_BLOCK_MOST});
  expect_common<pose_wall_planar_localise_settings, pose_wall_planar_localise>(
      {pose_wall_planar_localise_settings_init, pose_wall_planar_localise_settings_check,
       pose_wall_planar_localise_memory_needed, pose_wall_planar_localise_open, POSE_WALL_PLANAR_LOCALISE_BLOCK_MOST});
  expect_common<pose_wall_planar_plan_settings, pose_wall_planar_planner>(
      {pose_wall_planar_plan_settings_init, pose_wall_planar_plan_settings_check, pose_wall_planar_plan_memory_needed,
       pose_wall_planar_plan_open, POSE_WALL_PLANAR_PLAN_BLOCK_MOST});
  expect_common<pose_wall_planar_track_settings, pose_wall_planar_tracker>(
      {pose_wall_planar_track_settings_init, pose_wall_planar_track_settings_check,
       pose_wall_planar_track_memory_needed, pose_wall_planar_track_open, POSE_WALL_PLANAR_TRACK_BLOCK_MOST});
}

TEST(Headers, BlocksOfOneSizeAreAtMostTheirConstant) {
  std::uint64_t bytes = 0;
  EXPECT_EQ(pose_wall_planar_stop_memory_needed(nullptr), POSE_WALL_E_NULL);
  ASSERT_EQ(pose_wall_planar_stop_memory_needed(&bytes), POSE_WALL_OK);
  EXPECT_LE(bytes, std::uint64_t{POSE_WALL_PLANAR_STOP_BLOCK_MOST});
  ASSERT_EQ(pose_wall_planar_match_memory_needed(&bytes), POSE_WALL_OK);
  EXPECT_LE(bytes, std::uint64_t{POSE_WALL_PLANAR_MATCH_BLOCK_MOST});
  EXPECT_LE(pose_wall_motion_memory_needed(), std::uint64_t{POSE_WALL_MOTION_BLOCK_MOST});
}

// Hash tables double, so the worst sizes lie just behind powers of two.
TEST(Headers, AnEngineNeedsNoMoreThanItsConstantForEveryPointsMax) {
  std::vector<std::uint32_t> sizes = {5000, 400000};
  for (std::uint32_t power = 8192; power < 400000; power *= 2) {
    for (const std::uint32_t at : {power - 1, power, power + 1, power / 4 * 5, power / 2 * 3}) sizes.push_back(at);
  }
  for (std::uint32_t at = 5000; at <= 400000; at += 7919) sizes.push_back(at);
  pose_wall_config config = config_with();
  for (const std::uint32_t points : sizes) {
    if (points > 400000) continue;
    set(&config, "points_max", static_cast<double>(points));
    std::uint64_t bytes = 0;
    ASSERT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
    EXPECT_LE(bytes, std::uint64_t{POSE_WALL_BLOCK_MOST(points)}) << points;
    EXPECT_LE(std::uint64_t{POSE_WALL_BLOCK_MOST(points)}, 2 * bytes) << points;
  }
}

// What a program built against a newer header gives to calls of an opened part.
TEST(Headers, NewerStructsOfCallsAreRefusedAlike) {
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_planar_stop_memory_needed(&bytes), POSE_WALL_OK);
  AlignedBlock block(bytes, Dirt::kRandom);
  const pose_wall_config config = config_with();
  pose_wall_planar_stop* stop = nullptr;
  ASSERT_EQ(pose_wall_planar_stop_open(&config, nullptr, block.data(), block.size(), &stop), POSE_WALL_OK);
  const float point[3] = {1.0F, 2.0F, 3.0F};
  pose_wall_cloud cloud;
  ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, point, 1, sizeof point, 1), POSE_WALL_OK);
  Newer<pose_wall_planar_stop_motion> motion;
  Newer<pose_wall_planar_stop_result> result;
  EXPECT_EQ(pose_wall_planar_stop_process(stop, &cloud, &motion.known, 1, &result.known), POSE_WALL_E_STRUCT_NEWER);
  EXPECT_EQ(pose_wall_planar_stop_tick(stop, 1, &result.known), POSE_WALL_E_STRUCT_NEWER);

  AlignedBlock of_track(POSE_WALL_PLANAR_TRACK_BLOCK_MOST, Dirt::kRandom);
  pose_wall_planar_tracker* tracker = nullptr;
  ASSERT_EQ(pose_wall_planar_track_open(nullptr, of_track.data(), of_track.size(), &tracker), POSE_WALL_OK);
  Newer<pose_wall_planar_track_input> input;
  Newer<pose_wall_planar_track_command> command;
  EXPECT_EQ(pose_wall_planar_track_step(tracker, &input.known, &command.known), POSE_WALL_E_STRUCT_NEWER);

  Newer<pose_wall_inputs> inputs;
  AlignedBlock of_motion(POSE_WALL_MOTION_BLOCK_MOST, Dirt::kRandom);
  pose_wall_motion* odometry = nullptr;
  ASSERT_EQ(pose_wall_motion_open(&config, nullptr, of_motion.data(), of_motion.size(), &odometry), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_motion_give(odometry, &inputs.known), POSE_WALL_E_STRUCT_NEWER);
}

}  // namespace
}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <cmath>

#include "driven_road.hpp"

namespace {

using namespace pose_wall::planar_test;

TEST(SlamRefusals, ABadCallChangesNothing) {
  const sim::NetworkRun run = driven(small_plan(), 10.0, 3);
  const OpenedSlam slam(64);
  slam.process(run, 0);
  const std::vector<unsigned char> before = slam.saved();
  pose_wall_planar_slam_result result{};
  result.struct_size = sizeof(result);
  pose_wall_planar_scan scan = scan_of(run, 1);
  const pose_wall_planar_pose nowhere{std::nan(""), 0.0, 0.0}, far_off{2e6, 0.0, 0.0};
  EXPECT_EQ(pose_wall_planar_slam_process(slam.get(), &scan, &nowhere, &result), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(pose_wall_planar_slam_process(slam.get(), &scan, &far_off, &result), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(pose_wall_planar_slam_process(slam.get(), nullptr, nullptr, &result), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_slam_process(slam.get(), &scan, nullptr, nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_slam_process(nullptr, &scan, nullptr, &result), POSE_WALL_E_NULL);
  scan.beams = 0;
  EXPECT_EQ(pose_wall_planar_slam_process(slam.get(), &scan, nullptr, &result), POSE_WALL_PLANAR_E_SCAN);
  result.struct_size = 8;
  EXPECT_EQ(pose_wall_planar_slam_process(slam.get(), &scan, nullptr, &result), POSE_WALL_E_STRUCT_SIZE);
  pose_wall_planar_keyframe keyframe{};
  keyframe.struct_size = sizeof(keyframe);
  EXPECT_EQ(pose_wall_planar_slam_keyframe(slam.get(), 1, &keyframe), POSE_WALL_E_INDEX);
  float xy[2];
  EXPECT_EQ(pose_wall_planar_slam_points(slam.get(), 0, xy, 1), POSE_WALL_E_BUFFER_SMALL);
  alignas(64) unsigned char other[64] = {};
  EXPECT_EQ(pose_wall_planar_slam_clear(reinterpret_cast<pose_wall_planar_slam*>(other)), POSE_WALL_E_ENGINE);
  EXPECT_EQ(slam.saved(), before);
}

TEST(SlamRefusals, ABlockThatIsSmallOrCrookedIsRefused) {
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_planar_slam_memory_needed(nullptr, &bytes), POSE_WALL_OK);
  EXPECT_LT(bytes, 64U << 20U);
  alignas(64) static unsigned char block[128];
  pose_wall_planar_slam* slam = nullptr;
  EXPECT_EQ(pose_wall_planar_slam_open(nullptr, block, sizeof(block), &slam), POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(pose_wall_planar_slam_open(nullptr, block + 8, bytes, &slam), POSE_WALL_E_BLOCK_ALIGN);
  EXPECT_EQ(pose_wall_planar_slam_open(nullptr, nullptr, bytes, &slam), POSE_WALL_E_NULL);
  EXPECT_EQ(slam, nullptr);
}

TEST(SavedTrail, NoDamageIsTakenIn) {
  const sim::NetworkRun run = driven(small_plan(), 16.0, 4);
  const OpenedSlam from(64), to(64);
  for (std::size_t i = 0; i < run.scans(); ++i) from.process(run, i);
  const std::vector<unsigned char> saved = from.saved(), empty = to.saved();
  std::vector<unsigned char> damaged = saved;
  for (std::size_t k = 0; k < saved.size(); k += 1 + saved.size() / 200) {
    damaged[k] ^= static_cast<unsigned char>(1U << (k % 8));
    EXPECT_EQ(pose_wall_planar_slam_load(to.get(), damaged.data(), damaged.size(), nullptr),
              POSE_WALL_PLANAR_E_MAP_FILE)
        << k;
    damaged[k] = saved[k];
  }
  for (const std::size_t cut : {std::size_t{0}, std::size_t{3}, std::size_t{20}, saved.size() / 2, saved.size() - 1}) {
    EXPECT_EQ(pose_wall_planar_slam_load(to.get(), saved.data(), cut, nullptr), POSE_WALL_PLANAR_E_MAP_FILE) << cut;
  }
  EXPECT_EQ(to.saved(), empty);
  const OpenedSlam small(16);
  EXPECT_EQ(pose_wall_planar_slam_load(small.get(), saved.data(), saved.size(), nullptr), POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(pose_wall_planar_slam_load(to.get(), saved.data(), saved.size(), nullptr), POSE_WALL_OK);
  EXPECT_EQ(to.saved(), saved);
}

}  // namespace

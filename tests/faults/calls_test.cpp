// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: calls out of order, twice or in between mean what the header says. What is refused is in tests/abi/refusals.

#include "fault_room.hpp"

namespace pose_wall::test {
namespace {

pose_wall_result empty_result() {
  pose_wall_result r{};
  r.struct_size = sizeof r;
  return r;
}

// A block that an engine may be opened in.
struct Site {
  explicit Site(Dirt dirt = Dirt::kRandom) : config(small_config()), block(bytes_of(config), dirt) {}

  std::int32_t open() { return pose_wall_open(&config, block.data(), block.size(), &engine); }
  std::int32_t process(std::int64_t stamp_ns) {
    const pose_wall_cloud cloud = cloud_of(room_frame(frame++), stamp_ns);
    return pose_wall_process(engine, &cloud, &result);
  }
  std::string states_after(std::int64_t stamp_ns) {
    return process(stamp_ns) == POSE_WALL_OK ? states_of(result) : "refused";
  }

  static std::uint64_t bytes_of(const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
    return bytes;
  }

  pose_wall_config config;
  AlignedBlock block;
  pose_wall_engine* engine = nullptr;
  pose_wall_result result = empty_result();
  std::uint32_t frame = 0;
};

TEST(CallFaults, LastPointsBeforeTheFirstFrame) {
  FaultRoom room;
  pose_wall_points points;
  ASSERT_EQ(pose_wall_last_points(room.engine(), &points), POSE_WALL_OK);
  EXPECT_EQ(points.count, 0U);
}

TEST(CallFaults, LastPointsAfterAnEmptyFrame) {
  FaultRoom room;
  room.good(0);
  room.process(cloud_of(Points(), kPeriod_ns));
  pose_wall_points points;
  ASSERT_EQ(pose_wall_last_points(room.engine(), &points), POSE_WALL_OK);
  EXPECT_EQ(points.count, 0U);
}

TEST(CallFaults, LastPointsAfterAReset) {
  FaultRoom room;
  room.good(0);
  ASSERT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  pose_wall_points points;
  ASSERT_EQ(pose_wall_last_points(room.engine(), &points), POSE_WALL_OK);
  EXPECT_EQ(points.count, 0U);
}

TEST(CallFaults, ResetForgetsAll) {
  FaultRoom room;
  room.good(0);
  ASSERT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  room.watch().forget();
  const pose_wall_result r = room.process(cloud_of(Points(), kPeriod_ns));
  EXPECT_EQ(states_of(r), "IIIIIII");
  EXPECT_EQ(r.frame_index, 0U);
}

TEST(CallFaults, ResetTwiceIsResetOnce) {
  FaultRoom room;
  room.good(0);
  EXPECT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_reset(room.engine()), POSE_WALL_OK);
  room.watch().forget();
  EXPECT_EQ(states_of(room.good(-5 * kPeriod_ns)), "VVVVVVV") << "no stamp is remembered";
}

TEST(CallFaults, AgeAfterAReset) {
  FaultRoom room;
  room.good(0);
  (void)pose_wall_reset(room.engine());
  pose_wall_result r = empty_result();
  ASSERT_EQ(pose_wall_age(room.engine(), 0, &r), POSE_WALL_OK);
  EXPECT_EQ(states_of(r), "IIIIIII");
}

TEST(CallFaults, OpenedTwiceIsOpenedAfresh) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  EXPECT_EQ(site.states_after(0), "VVVVVVV");
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  EXPECT_EQ(site.states_after(-kPeriod_ns), "VVVVVVV");
  EXPECT_EQ(site.result.frame_index, 0U);
}

TEST(CallFaults, ARefusedOpenLeavesTheEngineThatIsThere) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  site.process(0);
  set(&site.config, "s_front", -3.0);
  EXPECT_EQ(site.open(), POSE_WALL_E_CONFIG_RULE);
  EXPECT_EQ(site.states_after(kPeriod_ns), "VVVVVVV");
  EXPECT_EQ(site.result.frame_index, 1U);
}

TEST(CallFaults, OpenedWithOtherSettingsOnTheSameBlock) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  site.process(0);
  set(&site.config, "points_max", 5000.0);
  set(&site.config, "voxel_leaf", 0.10);
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  EXPECT_TRUE(matches(site.states_after(0), "..LLLLL")) << states_of(site.result);
  EXPECT_EQ(misleading(site.result, kRoomTruth), "");
}

TEST(CallFaults, TheBlockWasClearedBehindTheEngine) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  site.process(0);
  // The far half of a block is scratch: who clears it between frames does no harm.
  unsigned char* const half = static_cast<unsigned char*>(site.block.data()) + site.block.size() / 2;
  std::memset(half, 0, static_cast<std::size_t>(site.block.size() / 2));
  EXPECT_EQ(site.states_after(kPeriod_ns), "VVVVVVV");
}

TEST(CallFaults, ConfigChangedAfterOpen) {
  Site site;
  ASSERT_EQ(site.open(), POSE_WALL_OK);
  std::memset(&site.config, 0xFF, sizeof site.config);
  EXPECT_EQ(site.states_after(0), "VVVVVVV") << "the config was copied";
}

TEST(CallFaults, CloudBytesChangedAfterTheCall) {
  FaultRoom room;
  Points points = room_frame(0);
  const pose_wall_result before = room.process(cloud_of(points, 0));
  std::fill(points.begin(), points.end(), std::array<float, 3>{9, 9, 9});
  pose_wall_result r = empty_result();
  ASSERT_EQ(pose_wall_age(room.engine(), 0, &r), POSE_WALL_OK);
  EXPECT_EQ(r.quantity[POSE_WALL_D_LF].value, before.quantity[POSE_WALL_D_LF].value) << "nothing is kept of a cloud";
}

TEST(CallFaults, AClockThatStandsStillOrGoesBack) {
  FaultRoom room;
  std::int64_t now_ns = 0;
  const auto back = [](void* now) { return *static_cast<std::int64_t*>(now) -= 5; };
  const auto still = [](void* now) { return *static_cast<std::int64_t*>(now); };
  ASSERT_EQ(pose_wall_set_clock(room.engine(), back, &now_ns), POSE_WALL_OK);
  EXPECT_EQ(states_of(room.good(0)), "VVVVVVV");
  ASSERT_EQ(pose_wall_set_clock(room.engine(), still, &now_ns), POSE_WALL_OK);
  const pose_wall_result r = room.good(kPeriod_ns);
  EXPECT_EQ(states_of(r), "VVVVVVV");
  for (const std::int64_t stage_ns : r.stage_ns) EXPECT_EQ(stage_ns, 0);
}

TEST(CallFaults, ResultUsedForTheNextCallAsItIs) {
  FaultRoom room;
  pose_wall_result r = empty_result();
  for (std::uint32_t i = 0; i < 3; ++i) {
    const pose_wall_cloud cloud = cloud_of(room_frame(i), i * kPeriod_ns);
    ASSERT_EQ(pose_wall_process(room.engine(), &cloud, &r), POSE_WALL_OK);
    EXPECT_EQ(room.watch().processed(r), "");
  }
}

}  // namespace
}  // namespace pose_wall::test

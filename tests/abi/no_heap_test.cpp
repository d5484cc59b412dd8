// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: no call of the C ABI allocates or frees memory, on good frames and on bad ones. The symbols check says that
// the archive has no way to; this one counts, and counts itself first.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "apps/soak/heap_count.hpp"
#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/garbage.hpp"
#include "support/moments.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

class NoHeap : public ::testing::Test {
 protected:
  template <typename Call>
  static std::uint64_t heap_calls(const Call& call) {
    tools::start_counting_heap_calls();
    call();
    return tools::stop_counting_heap_calls();
  }
};

TEST_F(NoHeap, TheCounterCounts) {
  EXPECT_GE(heap_calls([] {
              void* volatile block = std::malloc(100);
              std::free(block);
            }),
            2U);
  EXPECT_GE(heap_calls([] {
              int* volatile number = new int(7);
              delete number;
            }),
            2U);
  EXPECT_EQ(heap_calls([] {}), 0U);
}

TEST_F(NoHeap, NoCallAllocates) {
  const Points points = road_grid();
  const pose_wall_config config = config_with({{"points_max", "20000"}});
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
  AlignedBlock block(bytes, Dirt::kRandom);
  std::vector<unsigned char> memento(pose_wall_memento_bytes());
  pose_wall_result result{};
  result.struct_size = sizeof result;
  std::int32_t worst = POSE_WALL_OK;
  const auto note = [&](std::int32_t status) { worst = status < worst ? status : worst; };
  EXPECT_EQ(heap_calls([&] {
              pose_wall_config copy;
              pose_wall_engine* engine = nullptr;
              pose_wall_points last;
              note(pose_wall_config_init(&copy));
              note(pose_wall_config_set(&copy, "body_box_1", "-1 1 -1 1 -1 1"));
              note(pose_wall_open(&config, block.data(), bytes, &engine));
              for (std::int64_t frame = 0; frame < 3; ++frame) {
                const pose_wall_cloud cloud = cloud_of(points, frame * 100000000);
                note(pose_wall_process(engine, &cloud, &result));
              }
              note(pose_wall_last_points(engine, &last));
              note(pose_wall_age(engine, 300000000, &result));
              note(pose_wall_save(engine, nullptr, memento.data(), memento.size()));
              note(pose_wall_load(engine, &pose_wall::test::kSameClock, memento.data(), memento.size()));
              note(pose_wall_reset(engine));
              const pose_wall_cloud nothing = cloud_of(Points(), 0);
              note(pose_wall_process(engine, &nothing, &result));
            }),
            0U);
  EXPECT_EQ(worst, POSE_WALL_OK);
}

TEST_F(NoHeap, NorDoesTheSelfTest) {
  AlignedBlock block(pose_wall_self_test_bytes(), Dirt::kRandom);
  pose_wall_self_test_report report{};
  report.struct_size = sizeof report;
  std::int32_t status = POSE_WALL_E_NULL;
  EXPECT_EQ(heap_calls([&] { status = pose_wall_self_test(block.data(), pose_wall_self_test_bytes(), &report); }), 0U);
  EXPECT_EQ(status, POSE_WALL_OK);
}

TEST_F(NoHeap, NotOnGarbageEither) {
  Points points(30000);
  std::mt19937 random(1);
  for (auto& p : points) {
    for (float& c : p) c = any_bits(&random);
  }
  EngineUnderTest engine(config_with({{"points_max", "5000"}}));
  pose_wall_result result{};
  result.struct_size = sizeof result;
  const pose_wall_cloud cloud = cloud_of(points, 0);
  EXPECT_EQ(heap_calls([&] { (void)pose_wall_process(engine.get(), &cloud, &result); }), 0U);
}

}  // namespace
}  // namespace pose_wall::test

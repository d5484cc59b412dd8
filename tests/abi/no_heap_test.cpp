// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: no call of the C ABI allocates or frees memory, on good frames and on bad ones. The symbols check says that
// the archive has no way to; this one counts, and counts itself first.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"

#if defined(__SANITIZE_ADDRESS__)
// Of the sanitizer's runtime; GCC does not ship the header that declares it.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));
#endif

namespace {
// volatile: compilers know malloc and may think that it does not look at these.
thread_local volatile bool counting = false;
thread_local volatile int calls = 0;

void count_call() {
  if (counting) calls = calls + 1;
}
}  // namespace

#if !defined(__SANITIZE_ADDRESS__)
// The C library's own entry points beneath malloc and friends; operator new comes by malloc.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  count_call();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  count_call();
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  count_call();
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_call();
  return __libc_memalign(alignment, size);
}
void free(void* block) {
  count_call();
  __libc_free(block);
}
}
#endif

namespace pose_wall::test {
namespace {

class NoHeap : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t) { count_call(); },
                                              [](const volatile void*) { count_call(); });
#endif
  }

  template <typename Call>
  static int heap_calls(const Call& call) {
    calls = 0;
    counting = true;
    call();
    counting = false;
    return calls;
  }
};

Points road() {
  Points points;
  for (int i = -80; i <= 80; ++i) {
    for (int j = 0; j < 25; ++j) {
      const float along = 0.1F * static_cast<float>(i), up = 0.1F * static_cast<float>(j) - 1.4F;
      points.push_back({along, 2.5F, up});
      points.push_back({along, -2.5F, up});
      points.push_back({along, 0.2F * static_cast<float>(j - 12), -1.4F});
    }
  }
  return points;
}

TEST_F(NoHeap, TheCounterCounts) {
  EXPECT_GE(heap_calls([] {
              void* volatile block = std::malloc(100);
              std::free(block);
            }),
            2);
  EXPECT_GE(heap_calls([] {
              int* volatile number = new int(7);
              delete number;
            }),
            2);
  EXPECT_EQ(heap_calls([] {}), 0);
}

TEST_F(NoHeap, NoCallAllocates) {
  const Points points = road();
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
              note(pose_wall_save(engine, memento.data(), memento.size()));
              note(pose_wall_load(engine, memento.data(), memento.size()));
              note(pose_wall_reset(engine));
              const pose_wall_cloud nothing = cloud_of(Points(), 0);
              note(pose_wall_process(engine, &nothing, &result));
            }),
            0);
  EXPECT_EQ(worst, POSE_WALL_OK);
}

TEST_F(NoHeap, NotOnGarbageEither) {
  Points points(30000);
  std::mt19937 random(1);
  for (auto& p : points) {
    for (float& c : p) {
      const auto bits = static_cast<std::uint32_t>(random());
      std::memcpy(&c, &bits, sizeof c);
    }
  }
  EngineUnderTest engine(config_with({{"points_max", "5000"}}));
  pose_wall_result result{};
  result.struct_size = sizeof result;
  const pose_wall_cloud cloud = cloud_of(points, 0);
  EXPECT_EQ(heap_calls([&] { pose_wall_process(engine.get(), &cloud, &result); }), 0);
}

}  // namespace
}  // namespace pose_wall::test

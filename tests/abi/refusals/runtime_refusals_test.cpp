// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every call of pose_wall_runtime.h refuses NULL, what is no runtime, structs of other versions, and blocks
// that do not serve, by the status in the header, and writes nothing. Options out of their ranges, and what a runtime
// allows in which state, are in tests/runtime; clouds in cloud_refusals_test.cpp.

#if POSE_WALL_TEST_HAS_RUNTIME

#include <cstddef>

#include "abi/refusals/refusal.hpp"
#include "pose_wall_motion.h"
#include "support/moments.hpp"
#include "support/runtime_under_test.hpp"

extern "C" std::int32_t options_init_of_abi_2(pose_wall_runtime_options* options) __asm__(
    "pose_wall_runtime_options_init");

namespace pose_wall::test {
namespace {

// A runtime that has published a frame and stands still, and one that was never started.
class RuntimeWorld {
 public:
  // What calls write. Compared byte by byte, so it is filled once as a whole.
  struct Written {
    pose_wall_runtime_options options;
    const char* option;
    std::uint64_t needed;
    pose_wall_runtime* opened;
    pose_wall_publication publication;
    pose_wall_runtime_statistics statistics;
    pose_wall_image image;
    pose_wall_image2 image2;
    pose_wall_motion_image motion_image;
    pose_wall_points points;
    unsigned char memento[16384];
  };

  RuntimeWorld() {
    EXPECT_LE(pose_wall_memento_bytes(), sizeof written_.memento);
    running_.start();
    EXPECT_EQ(running_.push(points_, 0), POSE_WALL_OK);
    running_.wait_idle();
    EXPECT_EQ(pose_wall_runtime_save(stopped_.get(), &now, memento_, pose_wall_memento_bytes()), POSE_WALL_OK);
    restore();
  }

  void restore() {
    std::memset(&written_, 0x5A, sizeof written_);
    std::memset(free_block_.data(), 0x5A, static_cast<std::size_t>(free_block_.size()));
    std::memcpy(written_.memento, memento_, sizeof memento_);
    written_.options = options_of_few_points();
    written_.publication.struct_size = sizeof written_.publication;
    written_.statistics.struct_size = sizeof written_.statistics;
    written_.image.struct_size = sizeof written_.image;
    written_.image2.struct_size = sizeof written_.image2;
    written_.motion_image.struct_size = sizeof written_.motion_image;
    given_config = small_config();
    described = cloud_of(points_, 100000000);
    now = kSameClock;
    config = &given_config, options = &written_.options, needed = &written_.needed, opened = &written_.opened;
    running = running_.get(), stopped = stopped_.get(), cloud = &described;
    publication = &written_.publication, statistics = &written_.statistics;
    image = &written_.image, image2 = &written_.image2, motion_image = &written_.motion_image;
    points = &written_.points, memento = written_.memento, memento_bytes = pose_wall_memento_bytes();
    free_block = free_block_.data();
    free_bytes = bytes_of(given_config, written_.options);
  }
  void copy(WorldBytes* to) {
    to->clear();
    append(&written_, sizeof written_, to);
    append(free_block_.data(), free_block_.size(), to);
    append(none_.data(), none_.size(), to);
  }
  void hand_over(pose_wall_runtime* handle) { running = stopped = handle; }
  void hand_over_garbage() { hand_over(static_cast<pose_wall_runtime*>(none_.data())); }
  void misalign() { free_block = static_cast<char*>(free_block_.data()) + 8; }

  // Arguments. Those that are written to point into written_.
  pose_wall_config given_config{}, *config = nullptr;
  pose_wall_runtime_options* options = nullptr;
  std::uint64_t *needed = nullptr, free_bytes = 0, memento_bytes = 0;
  void *free_block = nullptr, *memento = nullptr;
  pose_wall_runtime *running = nullptr, *stopped = nullptr, **opened = nullptr;
  pose_wall_cloud described{}, *cloud = nullptr;
  pose_wall_moment now = kSameClock;
  pose_wall_publication* publication = nullptr;
  pose_wall_runtime_statistics* statistics = nullptr;
  pose_wall_image* image = nullptr;
  pose_wall_image2* image2 = nullptr;
  pose_wall_motion_image* motion_image = nullptr;
  pose_wall_points* points = nullptr;

 private:
  static pose_wall_runtime_options options_of_few_points() {
    pose_wall_runtime_options o;
    (void)pose_wall_runtime_options_init(&o);
    o.cloud_points_max = 100;
    return o;
  }
  static std::uint64_t bytes_of(const pose_wall_config& config, const pose_wall_runtime_options& options) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
    return bytes;
  }

  const Points points_ = room_points(1);
  RuntimeUnderTest running_{[](pose_wall_runtime_options*o) { o->motion = pose_wall_motion_functions_get(); }},
      stopped_;
  AlignedBlock free_block_{bytes_of(small_config(), options_of_few_points()) + POSE_WALL_BLOCK_ALIGNMENT, Dirt::kZeros};
  AlignedBlock none_{1 << 16, Dirt::kRandom};
  unsigned char memento_[16384] = {};
  Written written_{};
};

using R = RuntimeWorld;
constexpr std::int32_t kState = POSE_WALL_RUNTIME_E_STATE;

// Without a fault a call gives what that runtime's state allows (RuntimeLife tells these apart).
const Call<R> kRuntimeCalls[] = {
    {"pose_wall_runtime_options_init", [](R* r) { return options_init_of_abi_2(r->options); }, false, POSE_WALL_E_ABI},
    {"pose_wall_runtime_options_init_3", [](R* r) { return pose_wall_runtime_options_init(r->options); }},
    {"pose_wall_runtime_options_check", [](R* r) { return pose_wall_runtime_options_check(r->options, nullptr); }},
    {"pose_wall_runtime_memory_needed",
     [](R* r) { return pose_wall_runtime_memory_needed(r->config, r->options, r->needed); }},
    {"pose_wall_runtime_open",
     [](R* r) { return pose_wall_runtime_open(r->config, r->options, r->free_block, r->free_bytes, r->opened); }},
    {"pose_wall_runtime_start", [](R* r) { return pose_wall_runtime_start(r->running); }, true, kState},
    {"pose_wall_runtime_wait_idle", [](R* r) { return pose_wall_runtime_wait_idle(r->running); }, true},
    {"pose_wall_runtime_request_stop", [](R* r) { return pose_wall_runtime_request_stop(r->stopped); }, true, kState},
    {"pose_wall_runtime_stop", [](R* r) { return pose_wall_runtime_stop(r->stopped); }, true},
    {"pose_wall_runtime_close", [](R* r) { return pose_wall_runtime_close(r->running); }, true, kState},
    {"pose_wall_runtime_save",
     [](R* r) { return pose_wall_runtime_save(r->stopped, &r->now, r->memento, r->memento_bytes); }, true},
    {"pose_wall_runtime_load",
     [](R* r) { return pose_wall_runtime_load(r->stopped, &r->now, r->memento, r->memento_bytes); }, true},
    {"pose_wall_runtime_push", [](R* r) { return pose_wall_runtime_push(r->running, r->cloud); }, true},
    {"pose_wall_runtime_latest", [](R* r) { return pose_wall_runtime_latest(r->running, r->publication); }, true},
    {"pose_wall_runtime_image", [](R* r) { return pose_wall_runtime_image(r->running, r->image); }, true},
    {"pose_wall_runtime_image2", [](R* r) { return pose_wall_runtime_image2(r->running, r->image2); }, true},
    {"pose_wall_runtime_motion_image", [](R* r) { return pose_wall_runtime_motion_image(r->running, r->motion_image); },
     true},
    {"pose_wall_runtime_last_points", [](R* r) { return pose_wall_runtime_last_points(r->running, r->points); }, true,
     kState},
    {"pose_wall_runtime_tick", [](R* r) { return pose_wall_runtime_tick(r->running); }, true},
    {"pose_wall_runtime_statistics_now",
     [](R* r) { return pose_wall_runtime_statistics_now(r->running, r->statistics); }, true},
};

const Refusal<R> kRuntimeHandles[] = {
    {"", "runtime NULL", kNull, [](R* r) { r->hand_over(nullptr); }},
    {"", "a block of garbage", POSE_WALL_RUNTIME_E_HANDLE, [](R* r) { r->hand_over_garbage(); }},
};

template <std::uint32_t size>
void options_of_size(R* r) {
  r->options->struct_size = size;
}
template <std::uint32_t size>
void publication_of_size(R* r) {
  r->publication->struct_size = size;
}
template <std::uint32_t size>
void statistics_of_size(R* r) {
  r->statistics->struct_size = size;
}
// As they were before there was motion, which is the shortest that is taken, and in ABI 2.
constexpr std::uint32_t kOptions = offsetof(pose_wall_runtime_options, motion), kOptionsOfAbi2 = 128;
constexpr std::uint32_t kPublication = offsetof(pose_wall_publication, has_motion), kPublicationOfAbi2 = 912;
constexpr std::uint32_t kStatistics = offsetof(pose_wall_runtime_statistics, motion_refused), kStatisticsOfAbi2 = 664;
constexpr std::uint32_t kTooLarge = (1U << 16U) + 1;

const Refusal<R> kRuntimeTable[] = {
    {"pose_wall_runtime_options_init", "of ABI 2", POSE_WALL_E_ABI, [](R*) {}},
    {"pose_wall_runtime_options_init", "of ABI 2, NULL", POSE_WALL_E_ABI, [](R* r) { r->options = nullptr; }},
    {"pose_wall_runtime_options_init_3", "NULL", kNull, [](R* r) { r->options = nullptr; }},
    {"pose_wall_runtime_options_check", "NULL", kNull, [](R* r) { r->options = nullptr; }},
    {"pose_wall_runtime_options_check", "no size", kSize, options_of_size<0>},
    {"pose_wall_runtime_options_check", "a byte short", kSize, options_of_size<kOptions - 1>},
    // ABI 2 ran on machines of 64 bits, whose pointers its options hold; elsewhere it looks newer.
    {"pose_wall_runtime_options_check", "of ABI 2", sizeof(void*) == 8 ? POSE_WALL_E_ABI : kNewer,
     options_of_size<kOptionsOfAbi2>},
    {"pose_wall_runtime_options_check", "newer", kNewer, options_of_size<sizeof(pose_wall_runtime_options) + 8>},
    {"pose_wall_runtime_options_check", "the longest newer", kNewer, options_of_size<kTooLarge - 1>},
    {"pose_wall_runtime_options_check", "too large", kSize, options_of_size<kTooLarge>},
    {"pose_wall_runtime_memory_needed", "config NULL", kNull, [](R* r) { r->config = nullptr; }},
    {"pose_wall_runtime_memory_needed", "bytes NULL", kNull, [](R* r) { r->needed = nullptr; }},
    {"pose_wall_runtime_memory_needed", "options of 8 bytes", kSize, options_of_size<8>},
    {"pose_wall_runtime_memory_needed", "config of another layout", kSize, [](R* r) { r->config->layout = 0; }},
    {"pose_wall_runtime_open", "config NULL", kNull, [](R* r) { r->config = nullptr; }},
    {"pose_wall_runtime_open", "block NULL", kNull, [](R* r) { r->free_block = nullptr; }},
    {"pose_wall_runtime_open", "runtime NULL", kNull, [](R* r) { r->opened = nullptr; }},
    {"pose_wall_runtime_open", "options of 8 bytes", kSize, options_of_size<8>},
    {"pose_wall_runtime_open", "a contradiction", POSE_WALL_E_CONFIG_RULE,
     [](R* r) { set(r->config, "s_front", "-3"); }},
    {"pose_wall_runtime_open", "a byte too few", POSE_WALL_E_BLOCK_SMALL, [](R* r) { r->free_bytes -= 1; }},
    {"pose_wall_runtime_open", "off by 8", POSE_WALL_E_BLOCK_ALIGN, [](R* r) { r->misalign(); }},
    {"pose_wall_runtime_save", "memento NULL", kNull, [](R* r) { r->memento = nullptr; }},
    {"pose_wall_runtime_save", "a byte too few", POSE_WALL_E_BUFFER_SMALL, [](R* r) { r->memento_bytes -= 1; }},
    {"pose_wall_runtime_load", "memento NULL", kNull, [](R* r) { r->memento = nullptr; }},
    {"pose_wall_runtime_load", "a byte too few", POSE_WALL_E_MEMENTO, [](R* r) { r->memento_bytes -= 1; }},
    {"pose_wall_runtime_load", "a bit turned", POSE_WALL_E_MEMENTO,
     [](R* r) { static_cast<unsigned char*>(r->memento)[r->memento_bytes / 2] ^= 1U; }},
    {"pose_wall_runtime_push", "cloud NULL", kNull, [](R* r) { r->cloud = nullptr; }},
    {"pose_wall_runtime_latest", "NULL", kNull, [](R* r) { r->publication = nullptr; }},
    {"pose_wall_runtime_latest", "no size", kSize, publication_of_size<0>},
    {"pose_wall_runtime_latest", "a byte short", kSize, publication_of_size<kPublication - 1>},
    {"pose_wall_runtime_latest", "of ABI 2", POSE_WALL_E_ABI, publication_of_size<kPublicationOfAbi2>},
    {"pose_wall_runtime_latest", "newer", kNewer, publication_of_size<sizeof(pose_wall_publication) + 8>},
    {"pose_wall_runtime_latest", "the longest newer", kNewer, publication_of_size<kTooLarge - 1>},
    {"pose_wall_runtime_latest", "too large", kSize, publication_of_size<kTooLarge>},
    {"pose_wall_runtime_image", "NULL", kNull, [](R* r) { r->image = nullptr; }},
    {"pose_wall_runtime_image", "no size", kSize, [](R* r) { r->image->struct_size = 0; }},
    {"pose_wall_runtime_image2", "NULL", kNull, [](R* r) { r->image2 = nullptr; }},
    {"pose_wall_runtime_image2", "no size", kSize, [](R* r) { r->image2->struct_size = 0; }},
    {"pose_wall_runtime_motion_image", "NULL", kNull, [](R* r) { r->motion_image = nullptr; }},
    {"pose_wall_runtime_motion_image", "no size", kSize, [](R* r) { r->motion_image->struct_size = 0; }},
    {"pose_wall_runtime_motion_image", "no motion", POSE_WALL_RUNTIME_E_MOTION, [](R* r) { r->running = r->stopped; }},
    {"pose_wall_runtime_last_points", "NULL", kNull, [](R* r) { r->points = nullptr; }},
    {"pose_wall_runtime_statistics_now", "NULL", kNull, [](R* r) { r->statistics = nullptr; }},
    {"pose_wall_runtime_statistics_now", "no size", kSize, statistics_of_size<0>},
    {"pose_wall_runtime_statistics_now", "a byte short", kSize, statistics_of_size<kStatistics - 1>},
    {"pose_wall_runtime_statistics_now", "of ABI 2", POSE_WALL_E_ABI, statistics_of_size<kStatisticsOfAbi2>},
    {"pose_wall_runtime_statistics_now", "newer", kNewer, statistics_of_size<sizeof(pose_wall_runtime_statistics) + 8>},
    {"pose_wall_runtime_statistics_now", "the longest newer", kNewer, statistics_of_size<kTooLarge - 1>},
    {"pose_wall_runtime_statistics_now", "too large", kSize, statistics_of_size<kTooLarge>},
};

TEST(RuntimeRefusals, EveryCallThatCanFailIsTold) {
  expect_every_call_of("include/pose_wall_runtime.h", kRuntimeCalls);
}

TEST(RuntimeRefusals, WrongCallsChangeNothing) {
  RuntimeWorld world;
  expect_table(&world, kRuntimeCalls, kRuntimeTable);
}

TEST(RuntimeRefusals, WhatIsNoRuntime) {
  RuntimeWorld world;
  expect_handles(&world, kRuntimeCalls, kRuntimeHandles);
}

// The shortest structs that are taken: those of before there was motion.
TEST(RuntimeRefusals, StructsOfBeforeMotionAreNotRefused) {
  RuntimeWorld world;
  world.options->struct_size = kOptions;
  world.publication->struct_size = kPublication;
  world.statistics->struct_size = kStatistics;
  for (const char* name :
       {"pose_wall_runtime_options_check", "pose_wall_runtime_latest", "pose_wall_runtime_statistics_now"}) {
    EXPECT_EQ(call_of(kRuntimeCalls, name).make(&world), POSE_WALL_OK) << name;
  }
}

}  // namespace
}  // namespace pose_wall::test

#endif  // POSE_WALL_TEST_HAS_RUNTIME

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: where what the runtime stands on fails (threads, the clock, the disk, the callback, a step of its engine, the
// engine's memory), it says so, publishes nothing wrong, loses no count, and goes on when the fault is over. More of
// the disk and the queue is in tests/runtime.

#include <pthread.h>
#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <vector>

#include "fault_room.hpp"
#include "faults/fault.hpp"
#include "pose_wall_box.h"
#include "support/record.hpp"
#include "support/runtime_under_test.hpp"
#include "wrapped_symbols.h"

namespace {

// The how-manieth thread from now on is not made; 0: all are.
std::atomic<int> refused_thread{0};

// What the system answers instead of doing it: 0 or an errno; kForReal: it is asked.
constexpr int kForReal = -1;
std::atomic<int> lock_error{kForReal}, priority_error{kForReal};

}  // namespace

extern "C" int pthread_create_for_real(pthread_t*, const pthread_attr_t*, void* (*)(void*),
                                       void*) __asm__("__real_" POSE_WALL_WRAPPED_pthread_create);
extern "C" int pthread_create_wrapped(pthread_t*, const pthread_attr_t*, void* (*)(void*),
                                      void*) __asm__("__wrap_" POSE_WALL_WRAPPED_pthread_create);

extern "C" int pthread_create_wrapped(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                                      void* user) {
  if (refused_thread > 0 && --refused_thread == 0) return EAGAIN;
  return pthread_create_for_real(thread, attributes, run, user);
}

extern "C" int mlock_for_real(const void*, std::size_t) __asm__("__real_" POSE_WALL_WRAPPED_mlock);
extern "C" int mlock_wrapped(const void*, std::size_t) __asm__("__wrap_" POSE_WALL_WRAPPED_mlock);

extern "C" int mlock_wrapped(const void* block, std::size_t bytes) {
  if (lock_error == kForReal) return mlock_for_real(block, bytes);
  errno = lock_error;
  return lock_error == 0 ? 0 : -1;
}

extern "C" int set_scheduling_for_real(pthread_t, int,
                                       const sched_param*) __asm__("__real_" POSE_WALL_WRAPPED_pthread_setschedparam);
extern "C" int set_scheduling_wrapped(pthread_t, int,
                                      const sched_param*) __asm__("__wrap_" POSE_WALL_WRAPPED_pthread_setschedparam);

extern "C" int set_scheduling_wrapped(pthread_t thread, int policy, const sched_param* parameters) {
  if (priority_error == kForReal) return set_scheduling_for_real(thread, policy, parameters);
  return priority_error;
}

namespace pose_wall::test {
namespace {

// A disk in memory that fails at its n-th write (0: the header's), or at every one from there on.
struct FaultyDisk {
  std::uint64_t writes = 0, fails_at = 0;
  bool for_good = false;
  Record bytes;

  static std::int32_t write(void* self, std::uint64_t offset, const void* from, std::uint64_t count) {
    FaultyDisk& disk = *static_cast<FaultyDisk*>(self);
    const std::uint64_t now = disk.writes++;
    if (now == disk.fails_at || (disk.for_good && now > disk.fails_at)) return 28;
    return write_record(&disk.bytes, offset, from, count);
  }
};

// Whole records in it; none without a header.
std::uint64_t records_in(const FaultyDisk& disk) {
  pose_wall_box_info info;
  if (pose_wall_box_open(disk.bytes.data(), disk.bytes.size(), &info) != POSE_WALL_OK) return 0;
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES, whole = 0;
  pose_wall_box_record record;
  while (pose_wall_box_next(disk.bytes.data(), disk.bytes.size(), &offset, &record) == POSE_WALL_OK) {
    whole += record.damaged == 0 ? 1 : 0;
  }
  return whole;
}

RuntimeUnderTest::Change onto(FaultyDisk* disk) {
  return [=](pose_wall_runtime_options* o) {
    o->sink = FaultyDisk::write;
    o->sink_user = disk;
    o->box_bytes = 1 << 22;
    o->box_clouds = 0;
  };
}

std::string frame(RuntimeUnderTest* runtime, std::uint32_t i) {
  EXPECT_EQ(runtime->push(room_frame(i), (i + 1) * kPeriod_ns), POSE_WALL_OK);
  runtime->wait_idle();
  const pose_wall_publication p = runtime->latest();
  EXPECT_EQ(broken_contract(p.result, limits_of(small_config())), "");
  EXPECT_EQ(misleading(p.result, kRoomTruth), "");
  EXPECT_TRUE(accounts_balance(runtime->statistics()));
  return states_of(p.result);
}

// The recorder is the first thread, the worker the second.
class RefusedThreads : public ::testing::TestWithParam<int> {};

TEST_P(RefusedThreads, StartSaysSoAndMayBeTriedAgain) {
  FaultyDisk disk;
  disk.fails_at = UINT64_MAX;
  RuntimeUnderTest runtime(onto(&disk));
  refused_thread = GetParam();
  EXPECT_EQ(pose_wall_runtime_start(runtime.get()), POSE_WALL_RUNTIME_E_SYSTEM);
  EXPECT_EQ(runtime.statistics().thread_error, EAGAIN);
  const pose_wall_cloud cloud = cloud_of(room_frame(0), 0);
  EXPECT_NE(pose_wall_runtime_push(runtime.get(), &cloud), POSE_WALL_OK);
  runtime.start();
  EXPECT_EQ(runtime.statistics().thread_error, 0);
  EXPECT_EQ(frame(&runtime, 0), "VVVVVVV");
}

INSTANTIATE_TEST_SUITE_P(Faults, RefusedThreads, ::testing::Values(1, 2),
                         [](const auto& test) { return test.param == 1 ? "recorder" : "worker"; });

// A disk that fails in its header, a record's body, its head, once or for good: frames do not notice, and what is on
// the disk can be read, as many records as were counted. Without clouds a record is two writes.
class FaultyDisks : public ::testing::TestWithParam<std::tuple<std::uint64_t, bool>> {};

TEST_P(FaultyDisks, FailTheRecordAlone) {
  constexpr std::uint64_t kRecords = 4, kWritesOfARecord = 2;
  FaultyDisk disk;
  std::tie(disk.fails_at, disk.for_good) = GetParam();
  RuntimeUnderTest runtime(onto(&disk));
  runtime.start();
  for (std::uint32_t i = 0; i < kRecords; ++i) EXPECT_EQ(frame(&runtime, i), "VVVVVVV") << i;
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.processed, kRecords);
  // A header that fails counts by itself; it is tried again before each record until it is written.
  const bool in_header = disk.fails_at == 0;
  const std::uint64_t before = in_header ? 0 : (disk.fails_at - 1) / kWritesOfARecord;
  const std::uint64_t written = disk.for_good ? before : kRecords - (in_header ? 0 : 1);
  EXPECT_EQ(s.box_written, written);
  EXPECT_EQ(s.box_failed, kRecords - written + (in_header ? 1 : 0));
  ASSERT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
  EXPECT_EQ(records_in(disk), written);
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyDisks,
                         ::testing::Combine(::testing::Values(0U, 1U, 2U, 3U, 4U), ::testing::Bool()),
                         [](const auto& test) {
                           const std::uint64_t write = std::get<0>(test.param);
                           return (write == 0 ? "header" : "write_" + std::to_string(write)) +
                                  (std::get<1>(test.param) ? "_for_good" : "_once");
                         });

// Memory that may not be locked, a priority that is not granted: told, and fatal only where it is required.
struct Wish {
  const char* name;
  std::uint32_t bit;
  std::atomic<int>* error;  // that the system gives; 0: granted
  void (*ask)(pose_wall_runtime_options*);
  std::int32_t (*told)(const pose_wall_runtime_statistics&);
};

void PrintTo(const Wish& w, std::ostream* out) {
  *out << w.name;
}

class RefusedWishes : public ::testing::TestWithParam<Wish> {
 protected:
  void TearDown() override { *GetParam().error = kForReal; }
};

TEST_P(RefusedWishes, AreToldAndFatalOnlyIfRequired) {
  const Wish& wish = GetParam();
  RuntimeUnderTest lenient(wish.ask);
  RuntimeUnderTest strict([&](pose_wall_runtime_options* o) {
    wish.ask(o);
    o->required = wish.bit;
  });
  *wish.error = EPERM;
  lenient.start();
  EXPECT_EQ(wish.told(lenient.statistics()), EPERM);
  EXPECT_EQ(frame(&lenient, 0), "VVVVVVV");
  EXPECT_EQ(pose_wall_runtime_start(strict.get()), POSE_WALL_RUNTIME_E_SYSTEM);
  EXPECT_EQ(wish.told(strict.statistics()), EPERM);
  EXPECT_EQ(strict.statistics().state, std::uint32_t{POSE_WALL_RUNTIME_STOPPED});
  *wish.error = 0;
  strict.start();
  EXPECT_EQ(wish.told(strict.statistics()), 0) << "of the last start";
  EXPECT_EQ(frame(&strict, 0), "VVVVVVV");
}

INSTANTIATE_TEST_SUITE_P(
    Faults, RefusedWishes,
    ::testing::Values(Wish{"lock", POSE_WALL_RUNTIME_LOCK, &lock_error, [](auto* o) { o->lock_memory = 1; },
                           [](const auto& s) { return s.lock_error; }},
                      Wish{"priority", POSE_WALL_RUNTIME_PRIORITY, &priority_error,
                           [](auto* o) { o->worker_priority = 1; }, [](const auto& s) { return s.priority_error; }}),
    [](const auto& test) { return test.param.name; });

TEST(RuntimeFaults, AClockThatStandsStill) {
  RuntimeUnderTest runtime([](auto* o) { o->watchdog_ns = 300 * kMs; });
  runtime.start();
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(frame(&runtime, i), "VVVVVVV");
  EXPECT_EQ(pose_wall_runtime_tick(runtime.get()), POSE_WALL_OK);
  runtime.wait_idle();
  EXPECT_EQ(runtime.statistics().silences, 0U) << "no time has passed";
}

TEST(RuntimeFaults, AClockThatGoesBack) {
  RuntimeUnderTest runtime([](auto* o) { o->watchdog_ns = 300 * kMs; });
  runtime.clock.set_step(-1 * kMs);
  runtime.start();
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(frame(&runtime, i), "VVVVVVV");
}

TEST(RuntimeFaults, AClockThatLeapsBetweenFrames) {
  RuntimeUnderTest runtime([](auto* o) { o->watchdog_ns = 300 * kMs; });
  runtime.start();
  frame(&runtime, 0);
  runtime.pass(3600000 * kMs);
  EXPECT_EQ(states_of(runtime.latest().result), "IIIIIII");
  EXPECT_EQ(frame(&runtime, 1), "VVVVVVV");
}

TEST(RuntimeFaults, AStepOfItsEngineFailsForAWhile) {
  RuntimeUnderTest runtime;
  runtime.start();
  EXPECT_EQ(frame(&runtime, 0), "VVVVVVV");
  fail_from_now_on(Fault::kFloorNotFound);
  EXPECT_EQ(frame(&runtime, 1), "HHHHHHH");
  fail_from_now_on(Fault::kNone);
  EXPECT_EQ(frame(&runtime, 2), "VVVVVVV");
}

// Where the runtime has placed its engine.
pose_wall_engine* engine_in(AlignedBlock* block) {
  unsigned char* const bytes = static_cast<unsigned char*>(block->data());
  for (std::uint64_t at = 0; at < block->size(); at += POSE_WALL_BLOCK_ALIGNMENT) {
    auto* const engine = reinterpret_cast<pose_wall_engine*>(bytes + at);
    pose_wall_points any;
    if (pose_wall_last_points(engine, &any) == POSE_WALL_OK) return engine;
  }
  return nullptr;
}

void flip_a_bit(RuntimeUnderTest* runtime) {
  pose_wall_engine* const engine = engine_in(&runtime->block());
  ASSERT_NE(engine, nullptr);
  reinterpret_cast<unsigned char*>(engine)[600] ^= 4;
}

TEST(RuntimeFaults, ABitFallsOverInItsEngine) {
  RuntimeUnderTest runtime;
  std::atomic<bool> balanced{true};
  runtime.in_callback = [&] { balanced = balanced && accounts_balance(runtime.statistics()); };
  runtime.start();
  frame(&runtime, 0);
  flip_a_bit(&runtime);
  // The frame that finds it is dropped and counted, and nothing is known; the next one is measured afresh.
  EXPECT_EQ(runtime.push(room_frame(1), 2 * kPeriod_ns), POSE_WALL_OK);
  runtime.wait_idle();
  EXPECT_EQ(runtime.statistics().dropped[POSE_WALL_RUNTIME_DROP_ENGINE], 1U);
  EXPECT_TRUE(accounts_balance(runtime.statistics()));
  EXPECT_TRUE(balanced) << "in the callback, too";
  EXPECT_EQ(runtime.latest().cause, POSE_WALL_RUNTIME_SILENCE);
  EXPECT_EQ(states_of(runtime.latest().result), "IIIIIII");
  EXPECT_EQ(frame(&runtime, 2), "VVVVVVV");
  EXPECT_EQ(runtime.latest().result.frame_index, 0U);
}

TEST(RuntimeFaults, ABitFallsOverBeforeASilence) {
  RuntimeUnderTest runtime([](auto* o) { o->watchdog_ns = 300 * kMs; });
  runtime.start();
  frame(&runtime, 0);
  flip_a_bit(&runtime);
  runtime.pass(301 * kMs);
  const pose_wall_result told = runtime.latest().result;
  EXPECT_EQ(states_of(told), "IIIIIII");
  for (const pose_wall_value& v : told.quantity) EXPECT_NE(v.reasons & POSE_WALL_R_NEVER_MEASURED, 0U);
  EXPECT_EQ(frame(&runtime, 1), "VVVVVVV");
}

// In the config that a new engine would be opened by, too: there is none, and that is told at once and for good.
TEST(RuntimeFaults, BitsFallOverInItsEngineAndItsConfig) {
  RuntimeUnderTest runtime([](auto* o) { o->watchdog_ns = 0; });
  runtime.start();
  frame(&runtime, 0);
  flip_a_bit(&runtime);
  const pose_wall_config config = small_config();
  auto* const bytes = static_cast<unsigned char*>(runtime.block().data());
  std::uint64_t at = 0;
  while (std::memcmp(bytes + at, &config, sizeof config) != 0) ASSERT_LT(++at, runtime.block().size() - sizeof config);
  bytes[at + sizeof config / 2] ^= 4;
  for (std::uint32_t i = 1; i < 4; ++i) {
    EXPECT_EQ(runtime.push(room_frame(i), (i + 1) * kPeriod_ns), POSE_WALL_OK);
    runtime.wait_idle();
    const pose_wall_publication p = runtime.latest();
    EXPECT_EQ(states_of(p.result), "IIIIIII") << i;
    EXPECT_EQ(broken_contract(p.result, limits_of(config)), "") << i;
    EXPECT_EQ(p.result.frame_index, UINT64_MAX) << i;
  }
  EXPECT_EQ(runtime.statistics().dropped[POSE_WALL_RUNTIME_DROP_ENGINE], 3U);
  ASSERT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_start(runtime.get()), POSE_WALL_E_ENGINE);
  EXPECT_EQ(runtime.statistics().state, static_cast<std::uint32_t>(POSE_WALL_RUNTIME_STOPPED));
}

TEST(RuntimeFaults, ABitFallsOverInWhatReadersGet) {
  RuntimeUnderTest runtime;
  runtime.start();
  frame(&runtime, 0);
  const pose_wall_publication told = runtime.latest();
  auto* const bytes = static_cast<unsigned char*>(runtime.block().data());
  const std::uint64_t end = runtime.block().size() - sizeof told.result;
  std::uint64_t copies = 0;
  for (std::uint64_t at = 0; at < end; at += 8) {  // the cell that readers get, and the worker's own copies
    if (std::memcmp(bytes + at, &told.result, sizeof told.result) != 0) continue;
    bytes[at + offsetof(pose_wall_result, quantity[2].state)] ^= 1;
    ++copies;
  }
  EXPECT_GT(copies, 0U);
  pose_wall_publication p{};
  p.struct_size = sizeof p;
  EXPECT_EQ(pose_wall_runtime_latest(runtime.get(), &p), POSE_WALL_E_ENGINE);
  EXPECT_EQ(states_of(p.result), "IIIIIII");
  EXPECT_EQ(frame(&runtime, 1), "VVVVVVV");
}

TEST(RuntimeFaults, ABitFallsOverBetweenStopAndStart) {
  RuntimeUnderTest runtime;
  runtime.start();
  frame(&runtime, 0);
  ASSERT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
  flip_a_bit(&runtime);
  runtime.start();
  EXPECT_EQ(frame(&runtime, 0), "VVVVVVV");
  EXPECT_EQ(runtime.statistics().dropped[POSE_WALL_RUNTIME_DROP_ENGINE], 0U);
}

}  // namespace
}  // namespace pose_wall::test

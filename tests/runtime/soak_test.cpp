// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a soak calls good. Each fault makes it fail, and what could not be looked at makes it unknown; every way
// to ask the heap is counted. That pose_wall_soak runs at all is the entry runtime.soak.

#include "apps/soak/soak_outcome.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cerrno>
#include <cstdlib>
#include <functional>
#include <new>

namespace pose_wall::test {
namespace {

using tools::SoakOutcome;
using tools::SoakVerdict;

SoakOutcome good() {
  SoakOutcome o;
  o.statistics.pushed = 10;
  o.statistics.processed = 9;
  o.statistics.dropped[POSE_WALL_RUNTIME_DROP_OVERTAKEN] = 1;
  o.resident_begin_kb = 10000;
  o.resident_end_kb = o.resident_begin_kb + tools::kGrowthMax_kb;
  o.looks = o.looks_at_work = 10;
  return o;
}

SoakVerdict verdict_with(const std::function<void(SoakOutcome*)>& change) {
  SoakOutcome o = good();
  change(&o);
  return o.verdict();
}

TEST(SoakVerdicts, EachFaultFails) {
  EXPECT_EQ(verdict_with([](auto* o) { o->unbalanced = 1; }), SoakVerdict::kFailed);
  EXPECT_EQ(verdict_with([](auto* o) { ++o->statistics.pushed; }), SoakVerdict::kFailed);
  EXPECT_EQ(verdict_with([](auto* o) { o->heap_calls = 1; }), SoakVerdict::kFailed);
  EXPECT_EQ(verdict_with([](auto* o) { ++o->resident_end_kb; }), SoakVerdict::kFailed);
}

TEST(SoakVerdicts, WhatWasNotLookedAtIsUnknown) {
  if (tools::heap_calls_are_counted()) {
    EXPECT_EQ(good().verdict(), SoakVerdict::kGood);
  } else {
    EXPECT_EQ(good().verdict(), SoakVerdict::kUnknown);
  }
  EXPECT_EQ(verdict_with([](auto* o) { o->resident_begin_kb = tools::kResidentUnknown_kb; }), SoakVerdict::kUnknown);
  EXPECT_EQ(verdict_with([](auto* o) { o->resident_end_kb = tools::kResidentUnknown_kb; }), SoakVerdict::kUnknown);
  EXPECT_EQ(verdict_with([](auto* o) { o->resident_begin_kb = o->resident_end_kb = 0; }), SoakVerdict::kUnknown);
  EXPECT_EQ(verdict_with([](auto* o) { o->looks_at_work = 0; }), SoakVerdict::kUnknown);
  EXPECT_EQ(verdict_with([](auto* o) {
              o->statistics.dropped[POSE_WALL_RUNTIME_DROP_OVERTAKEN] = o->statistics.pushed;
              o->statistics.processed = 0;
            }),
            SoakVerdict::kUnknown);
  EXPECT_EQ(SoakOutcome().verdict(), SoakVerdict::kUnknown);
  // A fault is a fault whatever else is unknown.
  EXPECT_EQ(verdict_with([](auto* o) {
              o->resident_end_kb = tools::kResidentUnknown_kb;
              o->heap_calls = 1;
            }),
            SoakVerdict::kFailed);
}

TEST(HeapCount, EveryWayToAskTheHeapIsCounted) {
  if (!tools::heap_calls_are_counted()) GTEST_SKIP() << "a sanitizer has its own malloc";
  struct alignas(256) Wide {
    char bytes[256];
  };
  // What is asked for goes through volatile pointers: a compiler may leave out a pair that nobody looks at.
  void* volatile taken = nullptr;
  const auto ways = {
      std::function<void()>([&] { taken = std::malloc(100); }),
      std::function<void()>([&] { taken = std::calloc(10, 10); }),
      std::function<void()>([&] { taken = std::realloc(nullptr, 100); }),
      std::function<void()>([&] { taken = std::aligned_alloc(64, 128); }),
      std::function<void()>([&] { taken = memalign(64, 100); }),
      std::function<void()>([&] { taken = valloc(100); }),
      std::function<void()>([&] { taken = pvalloc(100); }),
      std::function<void()>([&] {
        void* block = nullptr;
        EXPECT_EQ(posix_memalign(&block, 64, 100), 0);
        taken = block;
      }),
  };
  int way = 0;
  for (const auto& ask : ways) {
    tools::start_counting_heap_calls();
    ask();
    EXPECT_EQ(tools::stop_counting_heap_calls(), 1U) << way;
    EXPECT_NE(taken, nullptr) << way;
    tools::start_counting_heap_calls();
    std::free(taken);
    EXPECT_EQ(tools::stop_counting_heap_calls(), 1U) << way;
    ++way;
  }
  tools::start_counting_heap_calls();
  Wide* volatile wide = new Wide;
  delete wide;
  EXPECT_GE(tools::stop_counting_heap_calls(), 2U) << "aligned operator new";
}

// Of the counter's own posix_memalign; a sanitizer's takes that for a mistake of the program.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(HeapCount, AnAlignmentThatIsNoneIsRefused) {
  void* block = nullptr;
  EXPECT_EQ(posix_memalign(&block, sizeof(void*) / 2, 100), EINVAL);
  EXPECT_EQ(posix_memalign(&block, 3 * sizeof(void*), 100), EINVAL);
  EXPECT_EQ(block, nullptr);
}
#endif

}  // namespace
}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What is left to say of a soak, and whether it is good. What could not be looked at is unknown, and not good.

#pragma once

#include <cstdint>

#include "apps/soak/heap_count.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::tools {

// Resident memory that grows by more than this between a tenth of the way and its end is called a leak.
constexpr std::int64_t kGrowthMax_kb = 1024;

inline std::uint64_t sum_of_drops(const pose_wall_runtime_statistics& s) {
  std::uint64_t sum = 0;
  for (const std::uint64_t d : s.dropped) sum += d;
  return sum;
}

enum class SoakVerdict { kGood, kFailed, kUnknown };

struct SoakOutcome {
  pose_wall_runtime_statistics statistics{};             // after stop
  std::uint64_t heap_calls = 0;                          // after start, before stop
  std::int64_t resident_begin_kb = kResidentUnknown_kb;  // when a tenth was done: everything was touched once by then
  std::int64_t resident_end_kb = kResidentUnknown_kb;
  std::uint64_t unbalanced = 0;  // looks at the counters that did not add up
  std::uint64_t looks = 0;
  std::uint64_t looks_at_work = 0;  // of them while a frame was on its way
  std::uint64_t states[4] = {};     // of the newest yaw, by look
  std::uint64_t stale = 0;          // looks at which the newest was refused for its age
  std::uint64_t bytes = 0;          // the block

  bool accounts_balance() const {
    return unbalanced == 0 && statistics.pushed == statistics.processed + sum_of_drops(statistics);
  }
  bool resident_is_known() const { return resident_begin_kb > 0 && resident_end_kb > 0; }

  SoakVerdict verdict() const {
    const bool grown = resident_is_known() && resident_end_kb - resident_begin_kb > kGrowthMax_kb;
    if (!accounts_balance() || heap_calls > 0 || grown) return SoakVerdict::kFailed;
    const bool all_known = resident_is_known() && heap_calls_are_counted() && looks_at_work > 0;
    return all_known && statistics.processed > 0 ? SoakVerdict::kGood : SoakVerdict::kUnknown;
  }
};

}  // namespace pose_wall::tools

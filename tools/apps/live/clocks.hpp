// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The two clocks of the daemon: one that runs on whatever people do, and the one that they set.

#pragma once

#include <cstdint>
#include <ctime>

namespace pose_wall::tools::live {

inline std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

inline std::int64_t monotonic_ns() {
  return clock_ns(CLOCK_MONOTONIC);
}

inline std::int64_t wall_ns() {
  return clock_ns(CLOCK_REALTIME);
}

}  // namespace pose_wall::tools::live

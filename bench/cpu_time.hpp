// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Processor time, so that other work on the machine does not count. Of the whole process: who starts threads pays for
// them.
#pragma once

#include <time.h>

#include <cstdint>

namespace pose_wall::bench {

inline std::int64_t cpu_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

// As pose_wall_set_clock takes it.
inline std::int64_t cpu_clock(void* /*user*/) {
  return cpu_time_ns();
}

template <typename Work>
double cpu_time_ms(Work work) {
  const std::int64_t start_ns = cpu_time_ns();
  work();
  return static_cast<double>(cpu_time_ns() - start_ns) * 1e-6;
}

}  // namespace pose_wall::bench

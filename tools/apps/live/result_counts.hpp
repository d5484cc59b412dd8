// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What of the results monitors count: how long each value was not fit to steer by, and how late results came.

#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "apps/live/sink.hpp"
#include "apps/live/state_times.hpp"

namespace pose_wall::tools::live {

// Since the start.
struct ResultSums {
  // Upper ends of the histogram's steps, in s. The last one is the runtime's watchdog (pose_wall_runtime.h): what comes
  // later is published as no frame.
  static constexpr std::array<double, 10> kUpTo_s = {0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.2, 0.3};

  // From the reception of a frame to its result: frames of each step, and behind them those of none.
  std::array<std::uint64_t, kUpTo_s.size() + 1> latency{};
  std::int64_t latency_sum_ns = 0;
  std::array<std::int64_t, POSE_WALL_QUANTITIES> not_steering_ns{};
};

class ResultCounts {
 public:
  // watchdog_ns: so old a frame's result is stale, as the runtime has it.
  ResultCounts(std::int64_t watchdog_ns, std::int64_t now_ns);

  // Each publication, as it comes. By one thread.
  void note(const LiveResult& result);
  // Up to now_ns, by the clock of published_ns. From any thread.
  ResultSums until(std::int64_t now_ns) const;

 private:
  std::int64_t watchdog_ns_;
  mutable std::mutex lock_;
  ResultSums sums_;
  mutable std::vector<StateTimes> steering_;
};

}  // namespace pose_wall::tools::live

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/result_counts.hpp"

#include <algorithm>

#include "study/steer/steer_cause.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::size_t kNotSteering = 0, kSteering = 1, kStates = 2;  // numbers of StateTimes, and how many

}  // namespace

ResultCounts::ResultCounts(std::int64_t watchdog_ns, std::int64_t now_ns)
    : watchdog_ns_(watchdog_ns), steering_(POSE_WALL_QUANTITIES, StateTimes(kStates, kNotSteering, now_ns)) {}

void ResultCounts::note(const LiveResult& result) {
  const pose_wall_publication& told = result.publication;
  const bool is_frame = told.cause == POSE_WALL_RUNTIME_FRAME;
  // As the runtime has it (pose_wall_runtime.h, FRESHNESS).
  const std::int64_t stale_ns = (is_frame ? told.received_ns : told.published_ns) + watchdog_ns_;
  const std::lock_guard<std::mutex> locked(lock_);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const bool may_steer = steer_cause(told.result.quantity[q]) == kMaySteer;
    steering_[q].note(may_steer ? kSteering : kNotSteering, told.published_ns, stale_ns);
  }
  if (!is_frame) return;
  const std::int64_t latency_ns = std::max<std::int64_t>(told.published_ns - told.received_ns, 0);
  const auto* const step =
      std::lower_bound(ResultSums::kUpTo_s.begin(), ResultSums::kUpTo_s.end(), static_cast<double>(latency_ns) * 1e-9);
  ++sums_.latency[static_cast<std::size_t>(step - ResultSums::kUpTo_s.begin())];
  sums_.latency_sum_ns += latency_ns;
}

ResultSums ResultCounts::until(std::int64_t now_ns) const {
  const std::lock_guard<std::mutex> locked(lock_);
  ResultSums sums = sums_;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    sums.not_steering_ns[q] = steering_[q].until(now_ns)[kNotSteering];
  }
  return sums;
}

}  // namespace pose_wall::tools::live

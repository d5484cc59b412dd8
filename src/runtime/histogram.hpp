// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Times in a fixed number of buckets: 32 per doubling, so that a quantile is never too small and too large by 1/32 at
// most. One thread adds, any thread reads.

#pragma once

#include <atomic>
#include <cstdint>

#include "pose_wall_runtime.h"

namespace pose_wall::runtime {

class Histogram {
 public:
  // A step is at most a 32nd of its time, which is what a quantile may be off by:
  static constexpr int kStepBits = 5;
  static constexpr std::uint32_t kSteps = 1U << kStepBits;
  static constexpr int kDoublings = 38;  // up to 2^42 ns, more than an hour; beyond counts as that, worst is exact
  static constexpr std::uint32_t kBuckets = kSteps * kDoublings;  // one for each step

  void add(std::int64_t time_ns) {
    const std::uint64_t time = time_ns > 0 ? static_cast<std::uint64_t>(time_ns) : 0;
    bump(&bucket_[bucket_of(time)], 1);
    bump(&count_, 1);
    if (time > worst_.load(std::memory_order_relaxed)) worst_.store(time, std::memory_order_relaxed);
  }

  // Read while another thread adds, it may miss that one.
  pose_wall_runtime_times times() const {
    pose_wall_runtime_times t{};
    t.count = count_.load(std::memory_order_relaxed);
    t.worst_ns = static_cast<std::int64_t>(worst_.load(std::memory_order_relaxed));
    t.p50_ns = quantile(t, 500);
    t.p99_ns = quantile(t, 990);
    t.p999_ns = quantile(t, 999);
    return t;
  }

  static std::uint32_t bucket_of(std::uint64_t time) {
    if (time < kSteps) return static_cast<std::uint32_t>(time);
    int doubling = 1;
    while (doubling < kDoublings && time >> (kStepBits + doubling) != 0) ++doubling;
    if (doubling == kDoublings) return kBuckets - 1;
    const std::uint32_t step = static_cast<std::uint32_t>(time >> (doubling - 1)) & (kSteps - 1);
    return kSteps * static_cast<std::uint32_t>(doubling) + step;
  }

  // The longest time that falls into the bucket.
  static std::uint64_t upper_edge(std::uint32_t bucket) {
    if (bucket < kSteps) return bucket;
    const std::uint32_t doubling = bucket / kSteps, step = bucket % kSteps;
    return (static_cast<std::uint64_t>(kSteps + step + 1) << (doubling - 1)) - 1;
  }

 private:
  // One thread writes: no read-modify-write is needed.
  static void bump(std::atomic<std::uint64_t>* counter, std::uint64_t by) {
    counter->store(counter->load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
  }

  // The smallest edge that at least so many thousandths of all times lie within.
  std::int64_t quantile(const pose_wall_runtime_times& t, std::uint64_t thousandths) const {
    const std::uint64_t needed = t.count / 1000 * thousandths + (t.count % 1000 * thousandths + 999) / 1000;
    std::uint64_t seen = 0;
    for (std::uint32_t bucket = 0; bucket < kBuckets; ++bucket) {
      seen += bucket_[bucket].load(std::memory_order_relaxed);
      if (seen < needed || seen == 0) continue;
      const std::int64_t edge = static_cast<std::int64_t>(upper_edge(bucket));
      return edge < t.worst_ns ? edge : t.worst_ns;
    }
    return t.worst_ns;
  }

  std::atomic<std::uint64_t> bucket_[kBuckets] = {};
  std::atomic<std::uint64_t> count_{0}, worst_{0};
};

}  // namespace pose_wall::runtime

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How long a step took, since the start: the mean and the worst. One thread notes, any asks.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <string>

namespace pose_wall::tools::live {

class Delays {
 public:
  void note(std::int64_t took_ns) {
    const std::lock_guard<std::mutex> locked(lock_);
    ++count_;
    sum_ms_ += static_cast<double>(took_ns) * kMsPerNs;
    worst_ms_ = std::max(worst_ms_, static_cast<double>(took_ns) * kMsPerNs);
  }
  // "0.0" before the first one.
  std::string mean_ms_text() const {
    const std::lock_guard<std::mutex> locked(lock_);
    return fmt::format("{:.1f}", count_ > 0 ? sum_ms_ / static_cast<double>(count_) : 0.0);
  }
  std::string worst_ms_text() const {
    const std::lock_guard<std::mutex> locked(lock_);
    return fmt::format("{:.1f}", worst_ms_);
  }

 private:
  static constexpr double kMsPerNs = 1e-6;

  mutable std::mutex lock_;
  std::uint64_t count_ = 0;
  double sum_ms_ = 0.0, worst_ms_ = 0.0;
};

}  // namespace pose_wall::tools::live

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether scans under one name are of several sensors: those of one follow each other, those of two lie upon each
// other. livox_ros_driver2 needs it: its lidar_id is the first byte of the sensor's address, 192 for all of them.

#pragma once

#include <algorithm>
#include <cstdint>

namespace pose_wall::tools {

struct ScanSpan {
  std::int64_t begin_ns = 0, end_ns = 0;
};

class ScanOverlap {
 public:
  // In the order in which they came.
  void add(const ScanSpan& scan) {
    if (scans_++ > 0) {
      const std::int64_t overlap_ns = std::min(scan.end_ns, last_.end_ns) - std::max(scan.begin_ns, last_.begin_ns);
      overlap_s_ += static_cast<double>(std::max<std::int64_t>(overlap_ns, 0)) * 1e-9;
    }
    span_s_ += static_cast<double>(scan.end_ns - scan.begin_ns) * 1e-9;
    last_ = scan;
  }

  // Two in turn overlap by half of their spans together, one by next to nothing.
  bool is_of_several() const { return scans_ >= kScansLeast && overlap_s_ > kShareMost * span_s_; }

 private:
  static constexpr std::uint64_t kScansLeast = 4;
  static constexpr double kShareMost = 0.25;

  ScanSpan last_;
  std::uint64_t scans_ = 0;
  double overlap_s_ = 0.0, span_s_ = 0.0;
};

}  // namespace pose_wall::tools

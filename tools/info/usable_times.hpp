// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether the times of a recording's scans are of any use, for verbs that only measure: one look at each of the first
// scans. ScanTimeLook judges more, and takes longer.

#pragma once

#include <cstddef>
#include <string>

#include "frames/frame.hpp"
#include "info/scan_times.hpp"

namespace pose_wall::tools {

// What makes the times of one scan unusable: kType, kOne, kUnit; kNone also for a scan that carries none.
TimeFault unusable_times(const Frame& frame);

class UsableTimes {
 public:
  void add(const Frame& frame);
  // "times: 12 of 12 scans: all points of a scan have the same time. ..."; empty where they are usable, or are none.
  std::string doubt() const;

 private:
  std::size_t scans_ = 0;
  std::size_t faulty_[3] = {};
};

}  // namespace pose_wall::tools

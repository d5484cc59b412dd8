// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether the times of a recording's scans are of any use, for who only measures: one look at each of the first scans.
// ScanTimeLook judges more, and takes longer.

#pragma once

#include <cstddef>
#include <string>

#include "io/frames/frame.hpp"
#include "pose_wall_motion.h"
#include "study/info/scan_times.hpp"

namespace pose_wall::tools {

// What makes the times of one scan unusable: kType, kOne, kUnit; kNone also for a scan that carries none.
TimeFault unusable_times(const Frame& frame);

bool has_times(const Frame& frame);

constexpr std::size_t kBentScansLeast = 3;  // in which the machine moved: a single step may be a mistake

// The machine surely moves so fast that a scan without times is bent by it: a fifth of the usual alert limits in the
// 0.1 s of a scan.
bool bends_scan(const pose_wall_motion_result& moved);

class UsableTimes {
 public:
  void add(const Frame& frame);
  // How the machine moved up to the frame that was added last.
  void add_motion(const pose_wall_motion_result& moved);
  // "times: 12 of 12 scans: all points of a scan have the same time. ..."; empty where they are usable, or are none.
  std::string doubt() const;

 private:
  std::size_t scans_ = 0;
  std::size_t faulty_[3] = {};
  bool has_times_ = false;  // the last one
  std::size_t all_scans_ = 0, bent_ = 0;
};

}  // namespace pose_wall::tools

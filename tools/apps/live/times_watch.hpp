// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether the times of the clouds' points are of any use just now, for the health: whatever the source is.

#pragma once

#include <atomic>
#include <cstdint>

#include "apps/live/health.hpp"
#include "io/frames/frame.hpp"
#include "pose_wall_runtime.h"
#include "study/info/scan_times.hpp"

namespace pose_wall::tools::live {

class TimesWatch {
 public:
  // Of each frame that was measured, in one thread. Looks at all times of one frame in ten; says in the log what
  // changed.
  void note(const Frame& frame, const pose_wall_publication& publication);

  // From any thread. Adds the fact; what is of no use is a warning.
  void tell(PartHealth* health) const;

 private:
  void decide(TimeFault fault, std::uint64_t scans, std::uint64_t faulty, bool carries);

  std::uint64_t frames_ = 0, alike_ = 0;
  std::uint64_t without_ = 0, bent_ = 0;  // frames in turn without times, and those of them in which the machine moved
  TimeFault seen_ = TimeFault::kNone;     // at the last look
  std::atomic<TimeFault> fault_{TimeFault::kNone};
  std::atomic<bool> is_known_{false}, has_times_{false};
};

}  // namespace pose_wall::tools::live

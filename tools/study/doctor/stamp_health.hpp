// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How steadily the frames come, and whether their stamps can be believed.

#pragma once

#include <cstddef>

#include "study/doctor/recording.hpp"
#include "study/info/stamp_steps.hpp"

namespace pose_wall::tools::doctor {

struct StampHealth : StampSteps {
  std::size_t frames = 0;  // that could be read
  std::size_t unreadable = 0;
  std::size_t empty = 0;       // without any return
  std::size_t cut = 0;         // less than 60 % of the median's returns, but some
  std::size_t repeated = 0;    // the very points of the frame before
  std::size_t own_stamps = 0;  // 0: the format carries none, and the steps are those of --rate

  bool has_stamps() const { return own_stamps > 1; }
};

StampHealth look_at_stamps(const Recording& recording);

// Whether the times of the scans fit. Stamps that --rate made say nothing of them.
ScanTimeFacts look_at_times(const Recording& recording);

}  // namespace pose_wall::tools::doctor

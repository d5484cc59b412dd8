// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How fast an instrument notices, and how fast it comes back. All in frames.

#pragma once

#include <cstddef>
#include <vector>

#include "lab/campaign/record.hpp"

namespace pose_wall::tools::campaign {

// Time to alert: from the frame in which a value's error passes its alert limit, until its state leaves valid. 0: no
// value was ever valid with such an error. Over the seven quantities the longest.
// Noticed: from the first frame of the event, until a value that was valid before it is not valid.
// Recovered: from the first frame after the event, until all values are valid again that were so in the last frame
// before it. Frames in which the run ended first are counted as never.
struct EventTimes {
  std::size_t alert_max = 0;
  std::vector<std::size_t> noticed;
  std::size_t never_noticed = 0;
  std::vector<std::size_t> recovered;
  std::size_t never_recovered = 0;

  void add(const RunRecord& record, const AlertLimits& limits);
};

}  // namespace pose_wall::tools::campaign

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How steadily stamps come. `info` and `doctor` both ask here, so that they agree.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pose_wall::tools {

struct StampSteps {
  double duration_s = 0.0;  // gaps left out
  double rate_hz = 0.0;     // of the median step; 0: no stamp lies ahead of another
  double jitter_s = 0.0;    // nine in ten steps lie within this of the median
  std::size_t gaps = 0;     // steps of more than 1.5 times the median: a frame is missing
  double longest_s = 0.0;
  std::size_t still = 0;  // the stamp repeats
  std::size_t back = 0;   // it goes back
};

StampSteps look_at_steps(const std::vector<std::int64_t>& stamps_ns);

// "10.00 Hz (median of the steps), nine in ten within 1.2 ms; longest step 0.100 s, gaps: 0; stamps that repeat: 0,
// ..."
std::string steps_text(const StampSteps& steps);

}  // namespace pose_wall::tools

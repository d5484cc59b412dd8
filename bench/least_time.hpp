// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cmath>

#include "cpu_time.hpp"
#include "least_pass.hpp"

namespace pose_wall::bench {

// Of a pass that finds frame and table in the caches, where others' passes have just been: nobody's multiple of it
// shall look small because the floor was made dear. NaN for a frame without points.
inline double least_time_ms(LeastPass* least, const tools::sim::Frame& frame) {
  least->run(frame);
  std::uint32_t cells = 0;
  const double ms = cpu_time_ms([&] { cells = least->run(frame); });
  return cells > 0 ? ms : std::nan("");
}

}  // namespace pose_wall::bench

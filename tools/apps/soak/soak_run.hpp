// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frames through the runtime, by the clock or as fast as they go.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/soak/soak_outcome.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::tools {

using SoakPoints = std::vector<std::array<float, 3>>;

struct SoakPlan {
  pose_wall_config config{};
  std::vector<SoakPoints> frames;  // forth and back, each time under a new stamp
  double rate_hz = 20.0;
  double seconds = 10.0;
  std::uint64_t accelerated = 0;  // so many frames as fast as they go, instead of seconds at a rate
  std::uint32_t burst = 1;        // frames pushed at once before it waits, when accelerated
  std::uint32_t load = 0;         // threads that only burn time
  std::uint32_t thinning_max = 1;
  std::string box;  // a file, or empty
  std::uint64_t box_mb = 256;
};

// Throws std::runtime_error.
SoakOutcome soak(const SoakPlan& plan);

}  // namespace pose_wall::tools

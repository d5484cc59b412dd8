// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A frame computed once more by the engine that takes notes.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "pose_wall.hpp"
#include "pose_wall_trace.h"

namespace pose_wall::tools {

// What an engine remembers before a frame.
using Memento = std::vector<std::byte>;
Memento memento_of(pose_wall_engine* engine);

struct TracedFrame {
  pose_wall_result result;
  std::unique_ptr<pose_wall_trace> trace;  // never null
};

// Throws std::runtime_error with the status where the engine refuses config, memento or cloud.
TracedFrame trace_frame(const api::Config& config, const Memento& before, const pose_wall_cloud& cloud);

// Whether both results are the same bits, but for the times of the stages, which need a clock.
bool same_bits(pose_wall_result a, pose_wall_result b);

}  // namespace pose_wall::tools

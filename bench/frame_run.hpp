// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One benchmark: frames through the engine, and what is told of them.
#pragma once

#include <benchmark/benchmark.h>

#include "frame_input.hpp"

namespace pose_wall::bench {

// Counters: points, voxels and measured_of_7 of a frame; ms_* of each stage; points_per_s; median_ms, p99_ms and
// worst_ms of all frames of the run (these and ms_* are wall time); x_least, the engine's processor time as a multiple
// of the least pass's on the same frames.
void run_frames(benchmark::State& state, const FrameInput& input);

}  // namespace pose_wall::bench

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frame_input.hpp"

#include "bench_frames.hpp"

namespace pose_wall::bench {
namespace {

// Enough that the engine never sees a frame it would take for a repeat.
constexpr std::uint32_t kFrames = 8;
constexpr const char* kDensest = "os0-128";

}  // namespace

FrameInput simulated_input(const std::string& sensor) {
  FrameInput input;
  input.config = config(sensor);
  for (const tools::sim::Frame& frame : frames(sensor, kFrames)) input.frames.push_back({cloud_of(frame, 0), &frame});
  return input;
}

FrameInput spread_input(std::uint32_t points) {
  const auto frame = std::make_shared<const tools::sim::Frame>(spread(points));
  FrameInput input;
  input.config = config(kDensest);
  input.frames.push_back({cloud_of(*frame, 0), frame.get()});
  input.in_sequence = false;
  input.storage = frame;
  return input;
}

}  // namespace pose_wall::bench

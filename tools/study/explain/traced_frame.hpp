// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frames by the engine that takes notes: one computed once more, or one after the other.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pose_wall.hpp"
#include "pose_wall_trace.h"

namespace pose_wall::tools {

// Whether the gate failed in the frame, perhaps on a plane without a note.
inline bool has_failed(const pose_wall_trace& trace, std::uint32_t gate) {
  return (trace.failed[gate / 64] >> gate % 64 & 1U) != 0;
}

// The table's limits are back, whatever ends its life. Limits are of the whole program.
template <void (*forget_limits)()>
struct LimitsRestoredBy {
  LimitsRestoredBy() = default;
  ~LimitsRestoredBy() { forget_limits(); }
  LimitsRestoredBy(const LimitsRestoredBy&) = delete;
  LimitsRestoredBy& operator=(const LimitsRestoredBy&) = delete;
};
using LimitsRestored = LimitsRestoredBy<pose_wall_trace_forget_limits>;

// The engine's memory before a frame.
using Memento = std::vector<std::byte>;
Memento memento_of(pose_wall_engine* engine);

// Frames one after the other, as api::Engine measures them. Each is slower: an engine of its own is opened for it.
class TracedEngine {
 public:
  // POSE_WALL_OK, or the fault of the config. Starts without memory of earlier frames.
  std::int32_t open(const api::Config& config);
  std::int32_t process(const pose_wall_cloud& cloud, pose_wall_result& result);

  // Continues after the frames of this memory.
  void remember(Memento memento) { memento_ = std::move(memento); }
  // Notes on the last frame.
  const pose_wall_trace& trace() const { return *trace_; }

 private:
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  api::Config config_;
  std::vector<Line> block_;
  Memento memento_;  // empty before the first frame
  std::unique_ptr<pose_wall_trace> trace_ = std::make_unique<pose_wall_trace>();
};

struct TracedFrame {
  pose_wall_result result;
  std::unique_ptr<pose_wall_trace> trace;  // never null
};

// Throws std::runtime_error with the status where the engine refuses config, memento or cloud.
TracedFrame trace_frame(const api::Config& config, const Memento& before, const pose_wall_cloud& cloud);

// Whether both results have the same bits; the times of the stages are left out.
bool same_bits(pose_wall_result a, pose_wall_result b);

}  // namespace pose_wall::tools

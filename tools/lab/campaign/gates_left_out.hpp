// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Gates that are left out: which are asked for, where they failed before, and what becomes of the values without them.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall_trace.h"

namespace pose_wall::tools::campaign {

using Gates = std::vector<std::uint32_t>;  // pose_wall_trace_gate_id

struct GateRows {
  std::vector<Gates> rows;  // the gates of a row go together
  std::string fault;        // empty, or what is wrong with the words
};
// "each": every gate alone, in their order, but floor_planes, which cannot go. "wall_low,ever": these gates, one row.
GateRows gate_rows(const std::string& words);

// In following traced frames of the whole program, until the limits are forgotten.
void leave_out(const Gates& gates);

// Frames in which each gate failed.
class GateFailures {
 public:
  void add(const pose_wall_trace& trace);
  // Of that gate among them which failed in most frames.
  std::size_t most_of(const Gates& gates) const;

 private:
  std::array<std::size_t, POSE_WALL_TRACE_GATES> frames_{};
};

// How a value stands to the truth.
struct Standing {
  bool valid, misleading, beyond;
};

// How many values are so without the gates alone, and with them alone.
struct MoreAndFewer {
  std::size_t more = 0, fewer = 0;
  void add(bool with_all, bool without);
};

struct StandingChanges {
  MoreAndFewer valid, misleading, beyond;
  void add(const Standing& with_all, const Standing& without);
  // Wrong values that pass only without the gates.
  std::size_t wrong_more() const { return misleading.more + beyond.more; }
};

}  // namespace pose_wall::tools::campaign

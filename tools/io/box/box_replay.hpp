// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A black box computed again, event by event.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "io/box/result_difference.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::tools {

struct BoxDifference {
  std::uint64_t sequence;
  std::uint64_t frame_index;
  std::int64_t stamp_ns;
  ResultDifference what;
};

// What is recorded of motion; nothing of it is computed again, for its map is not in the box.
struct BoxMotion {
  std::uint64_t frames = 0;
  std::array<std::uint64_t, POSE_WALL_ALONG_MEASURED + 1> of_state{};
  double first_m = 0.0, last_m = 0.0;  // travel of the first and the last frame with a pose
  bool has_travel = false;
};

// One event, in the order of the sequence.
struct BoxEvent {
  std::uint64_t sequence = 0, frame_index = 0;
  std::int64_t stamp_ns = 0, received_ns = 0;
  std::uint32_t kind = 0;  // pose_wall_box_kind
  std::string computed;    // "same", "different", "refused", "digest"
  std::optional<pose_wall_motion_result> motion;
};

struct BoxReplay {
  std::string version;          // of the library that recorded
  std::uint64_t records = 0;    // whole ones of the run of the header; all of them are computed
  std::uint64_t left_over = 0;  // of them: from laps of the ring that newer ones have overwritten but for these
  std::uint64_t first_sequence = 0, last_sequence = 0;  // of the others
  std::uint64_t frames = 0, silences = 0, thinned = 0, with_inputs = 0;
  std::uint64_t equal = 0, different = 0;
  std::uint64_t digests_only = 0;
  std::uint64_t refused = 0;  // the kind, the memento or the cloud: a record that no engine of this build wrote
  std::uint64_t damaged = 0;
  std::uint64_t missing = 0;  // between the first and the last; of a ring that never came round, also before the first
  std::uint64_t torn = 0;     // bytes that are no record between two that were written one behind the other
  std::uint64_t not_searched = 0;    // bytes of damaged records with heads of others within them: too many to follow
  std::uint64_t of_other_runs = 0;   // of earlier starts: not computed, their config may have been another
  std::uint64_t damaged_of_old = 0;  // of other runs, or left over
  std::optional<BoxDifference> first;
  BoxMotion motion;

  // What is older than the newest events without a gap does not count: a ring overwrites it in parts.
  bool is_whole() const { return damaged == 0 && missing == 0 && torn == 0 && not_searched == 0 && refused == 0; }
  bool reproduced() const { return different == 0 && digests_only == 0 && equal > 0; }
};

// After each record: how many are done, of how many.
using ReplayProgress = std::function<void(std::uint64_t done, std::uint64_t of)>;

using EventNotice = std::function<void(const BoxEvent& event)>;

// In the order of the events. Throws std::runtime_error where the file is no black box of this build.
BoxReplay replay_box(const std::string& path, const ReplayProgress& progress, const EventNotice& notice = nullptr);

}  // namespace pose_wall::tools

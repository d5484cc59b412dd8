// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A black box computed again, event by event.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "box/result_difference.hpp"

namespace pose_wall::tools {

struct BoxDifference {
  std::uint64_t sequence;
  std::uint64_t frame_index;
  std::int64_t stamp_ns;
  ResultDifference what;
};

struct BoxReplay {
  std::string version;  // of the library that recorded
  std::uint64_t records = 0;
  std::uint64_t first_sequence = 0, last_sequence = 0;
  std::uint64_t frames = 0, silences = 0, thinned = 0;
  std::uint64_t equal = 0, different = 0;
  std::uint64_t digests_only = 0;
  std::uint64_t refused = 0;  // the memento or the cloud: a record that no engine of this build wrote
  std::uint64_t damaged = 0;
  std::uint64_t missing = 0;      // between the first and the last
  std::uint64_t passed_over = 0;  // bytes that are no record
  std::optional<BoxDifference> first;

  // A box from its beginning has no bytes that are no record; in a ring that came round there are some.
  bool is_whole() const { return damaged == 0 && (passed_over == 0 || first_sequence > 0) && refused == 0; }
  bool reproduced() const { return different == 0 && digests_only == 0 && equal > 0; }
};

// After each record: how many are done, of how many.
using ReplayProgress = std::function<void(std::uint64_t done, std::uint64_t of)>;

// In the order of the events. Throws std::runtime_error where the file is no black box of this build.
BoxReplay replay_box(const std::string& path, const ReplayProgress& progress);

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The table that `pose_wall run` writes: one row per frame.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pose_wall.h"
#include "study/truth/alert_limits.hpp"

namespace pose_wall::tools {

// What became of one frame.
struct FrameOutcome {
  std::uint64_t frame = 0;  // position in the list of inputs
  std::string source;
  std::int64_t stamp_ns = 0;
  std::optional<pose_wall_result> result;  // none: the frame could not be read, or the engine refused its layout
  std::string error;                       // then why
  double load_ms = 0.0;
  double total_ms = 0.0;      // in the engine, elapsed
  double processor_ms = 0.0;  // what of it the thread was running: other programs do not count
  AlertLimits limits;         // by which its values are valid; zeros: not known
};

// Whether each part of each protection level has a column of its own.
enum class PartColumns { kNone, kAll };

// The alert limits in force, of angles (rad) and distances (m): whoever reads the table alone knows what valid meant.
inline constexpr const char* kLimitColumns[2] = {"alert_limit_angle", "alert_limit_distance"};

// Columns keep their places: later versions and kAll add theirs behind the others.
std::vector<std::string> result_head(PartColumns parts = PartColumns::kNone);
std::vector<std::string> result_cells(const FrameOutcome& outcome, PartColumns parts = PartColumns::kNone);

// The value as it is written: an invalid one has no value, sigma and level, for there is nothing to act on. Its raw
// stays.
pose_wall_value written_value(const pose_wall_value& value);

// The lowest of the seven states.
std::uint32_t worst_state(const pose_wall_result& result);

// Of the frame and of all seven values.
std::uint32_t all_reasons(const pose_wall_result& result);

// Names of reason bits, joined by '|'.
std::string reason_names(std::uint32_t reasons);

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The result of a frame in one line, so that frames alike can be counted.

#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "pose_wall.h"

namespace pose_wall::tools::explain {

enum class StoryKind : std::uint32_t {
  kUnreadable,
  kFrameRefused,  // nothing was measured
  kFloorRefused,  // so no wall was looked for
  kWallsRefused,  // one or both
  kDoubted,       // every plane was measured, some with doubts
  kNotValid,      // no plane is doubted, but some value is not valid
  kValid,         // all seven values
  kOther          // stands for the rest where there are too many stories
};

struct Story {
  StoryKind kind = StoryKind::kOther;
  std::uint32_t refused = 0;               // bits 1 << subject (pose_wall_trace_subject)
  std::array<std::uint32_t, 4> reasons{};  // of frame, floor, left, right; of kNotValid the first: those of the values

  bool operator<(const Story& other) const;
  bool operator==(const Story& other) const { return !(*this < other) && !(other < *this); }
};

Story story_of(const pose_wall_result& result);

// "left wall refused (wall_seen_through)".
std::string story_words(const Story& story);

// For programs: "walls_refused".
const char* story_name(StoryKind kind);

}  // namespace pose_wall::tools::explain

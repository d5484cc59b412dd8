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
  kValid          // all seven values
};

struct Story {
  StoryKind kind = StoryKind::kUnreadable;
  std::uint32_t subjects = 0;             // that are refused or doubted; bits 1 << subject (pose_wall_trace_subject)
  std::array<std::uint32_t, 4> always{};  // reasons of frame, floor, left, right; of kNotValid the first: the values'
  std::array<std::uint32_t, 4> sometimes{};  // of several frames: reasons that some of them have

  // The same planes are refused or doubted.
  bool is_alike(const Story& other) const { return kind == other.kind && subjects == other.subjects; }
  // Alike, with a reason in common for each plane.
  bool shares_reasons(const Story& other) const;
  void merge(const Story& other);
};

Story story_of(const pose_wall_result& result);

// "left wall refused (wall_not_found; at times wall_short)".
std::string story_words(const Story& story);

// For programs: "walls_refused".
const char* story_name(StoryKind kind);

}  // namespace pose_wall::tools::explain

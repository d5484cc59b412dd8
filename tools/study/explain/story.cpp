// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/story.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/language/language.hpp"
#include "pose_wall_trace.h"
#include "study/explain/amounts.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

constexpr std::uint32_t kFloor = POSE_WALL_TRACE_FLOOR, kLeft = POSE_WALL_TRACE_LEFT, kRight = POSE_WALL_TRACE_RIGHT;
// With these reasons a frame may measure nothing at all, but need not.
constexpr std::uint32_t kOfFrame = POSE_WALL_R_NO_POINTS | POSE_WALL_R_LEAF_GROWN | POSE_WALL_R_STAMP_STILL |
                                   POSE_WALL_R_FROZEN | POSE_WALL_R_WORK_LIMIT;
// Reasons of values that are no fault of a measurement.
constexpr std::uint32_t kAside = POSE_WALL_R_RATE_LIMITED | POSE_WALL_R_PRIOR;

bool is_measured(const pose_wall_result& r, std::uint32_t quantity) {
  return std::isfinite(r.quantity[quantity].raw);
}

bool is_refused(const pose_wall_result& r, std::uint32_t subject) {
  if (subject == kFloor) return !is_measured(r, POSE_WALL_ROLL);
  if (subject == kLeft) return !is_measured(r, POSE_WALL_D_LF) && !is_measured(r, POSE_WALL_D_LB);
  return !is_measured(r, POSE_WALL_D_RF) && !is_measured(r, POSE_WALL_D_RB);
}

bool all_valid(const pose_wall_result& r) {
  return std::all_of(r.quantity, r.quantity + POSE_WALL_QUANTITIES,
                     [](const pose_wall_value& v) { return v.state == POSE_WALL_VALID; });
}

std::uint32_t reasons_of_values(const pose_wall_result& r) {
  std::uint32_t reasons = 0;
  for (const pose_wall_value& v : r.quantity) {
    if (v.state != POSE_WALL_VALID) reasons |= v.reasons;
  }
  return reasons & ~kAside;
}

std::string names_of(std::uint32_t reasons) {
  std::vector<std::string> names;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) names.emplace_back(pose_wall_reason_name(bit));
  }
  return listed(names);
}

std::string reasons_text(const Story& story, std::uint32_t subject) {
  const std::string always = names_of(story.always[subject]), sometimes = names_of(story.sometimes[subject]);
  if (sometimes.empty()) return always;
  return always.empty() ? say("at times {}", sometimes) : say("{}; at times {}", always, sometimes);
}

// `of`: the subject whose reasons are shown; both walls have none of their own.
std::string refused_words(const Story& story, std::uint32_t subject, std::uint32_t of) {
  const std::string words = subject_words(subject), reasons = reasons_text(story, of);
  return reasons.empty() ? say("{} refused", words) : say("{} refused ({})", words, reasons);
}

bool has(const Story& story, std::uint32_t subject) {
  return (story.subjects >> subject & 1U) != 0;
}

std::string refusals_words(const Story& story) {
  const bool both_alike = has(story, kLeft) && has(story, kRight) && story.always[kLeft] == story.always[kRight] &&
                          story.sometimes[kLeft] == story.sometimes[kRight];
  if (both_alike) return refused_words(story, POSE_WALL_TRACE_WALLS, kLeft);
  std::vector<std::string> refused;
  for (std::uint32_t subject = 0; subject < story.always.size(); ++subject) {
    if (has(story, subject)) refused.push_back(refused_words(story, subject, subject));
  }
  return clauses(refused);
}

std::string doubts_words(const Story& story) {
  std::vector<std::string> doubts;
  for (std::uint32_t subject = 0; subject < story.always.size(); ++subject) {
    if (has(story, subject))
      doubts.push_back(say("{} doubted ({})", subject_words(subject), reasons_text(story, subject)));
  }
  return clauses(doubts);
}

}  // namespace

bool Story::shares_reasons(const Story& other) const {
  if (!is_alike(other)) return false;
  for (std::size_t i = 0; i < always.size(); ++i) {
    const bool without = always[i] == 0 && other.always[i] == 0;
    if (!without && (always[i] & other.always[i]) == 0) return false;
  }
  return true;
}

void Story::merge(const Story& other) {
  for (std::size_t i = 0; i < always.size(); ++i) {
    const std::uint32_t any = always[i] | sometimes[i] | other.always[i] | other.sometimes[i];
    always[i] &= other.always[i];
    sometimes[i] = any & ~always[i];
  }
}

Story story_of(const pose_wall_result& r) {
  Story story;
  const std::array<std::uint32_t, 4> reasons = {r.frame_reasons & kOfFrame, r.floor.reasons, r.left.reasons,
                                                r.right.reasons};
  std::uint32_t refused = 0, doubted = 0;
  for (const std::uint32_t subject : {kFloor, kLeft, kRight}) {
    if (is_refused(r, subject)) refused |= 1U << subject;
    if (reasons[subject] != 0) doubted |= 1U << subject;
  }
  if (all_valid(r)) {
    story.kind = StoryKind::kValid;
  } else if ((refused >> kFloor & 1U) != 0) {
    story.kind = reasons[0] != 0 ? StoryKind::kFrameRefused : StoryKind::kFloorRefused;
    story.subjects = 1U << (reasons[0] != 0 ? std::uint32_t{POSE_WALL_TRACE_FRAME} : kFloor);
  } else if (refused != 0) {
    story.kind = StoryKind::kWallsRefused;
    story.subjects = refused;
  } else if (doubted != 0) {
    story.kind = StoryKind::kDoubted;
    story.subjects = doubted;
  } else {
    story.kind = StoryKind::kNotValid;
    story.always[0] = reasons_of_values(r);
  }
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if ((story.subjects >> i & 1U) != 0) story.always[i] = reasons[i];
  }
  return story;
}

std::string story_words(const Story& story) {
  switch (story.kind) {
    case StoryKind::kUnreadable:
      return tr("could not be read");
    case StoryKind::kDoubted:
      return doubts_words(story);
    case StoryKind::kNotValid:
      return say("planes accepted, some values not valid ({})", reasons_text(story, 0));
    case StoryKind::kValid:
      return tr("all seven values valid");
    default:
      return refusals_words(story);
  }
}

const char* story_name(StoryKind kind) {
  switch (kind) {
    case StoryKind::kUnreadable:
      return "unreadable";
    case StoryKind::kFrameRefused:
      return "frame_refused";
    case StoryKind::kFloorRefused:
      return "floor_refused";
    case StoryKind::kWallsRefused:
      return "walls_refused";
    case StoryKind::kDoubted:
      return "doubted";
    case StoryKind::kNotValid:
      return "not_valid";
    default:
      return "valid";
  }
}

}  // namespace pose_wall::tools::explain

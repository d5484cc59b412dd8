// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "explain/story.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "explain/amounts.hpp"
#include "explain/prose.hpp"
#include "language/language.hpp"
#include "pose_wall_trace.h"

namespace pose_wall::tools::explain {
namespace {

constexpr std::uint32_t kFloor = POSE_WALL_TRACE_FLOOR, kLeft = POSE_WALL_TRACE_LEFT, kRight = POSE_WALL_TRACE_RIGHT;
// Reasons with which a frame may measure nothing at all; alone they need not refuse it.
constexpr std::uint32_t kOfFrame = POSE_WALL_R_NO_POINTS | POSE_WALL_R_LEAF_GROWN | POSE_WALL_R_STAMP_STILL |
                                   POSE_WALL_R_FROZEN | POSE_WALL_R_WORK_LIMIT;
// They stand in the values' reasons, but say nothing of a measurement.
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

std::string reason_text(std::uint32_t reasons) {
  std::vector<std::string> names;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) names.emplace_back(pose_wall_reason_name(bit));
  }
  return listed(names);
}

std::string refused_words(std::uint32_t subject, std::uint32_t reasons) {
  const std::string words = subject_words(subject);
  return reasons == 0 ? say("{} refused", words) : say("{} refused ({})", words, reason_text(reasons));
}

std::string walls_words(const Story& story) {
  const bool both = (story.refused >> kLeft & 1U) != 0 && (story.refused >> kRight & 1U) != 0;
  if (both && story.reasons[kLeft] == story.reasons[kRight]) {
    return refused_words(POSE_WALL_TRACE_WALLS, story.reasons[kLeft]);
  }
  std::vector<std::string> sides;
  for (const std::uint32_t side : {kLeft, kRight}) {
    if ((story.refused >> side & 1U) != 0) sides.push_back(refused_words(side, story.reasons[side]));
  }
  return clauses(sides);
}

std::string doubts_words(const Story& story) {
  std::vector<std::string> doubts;
  for (std::uint32_t subject = 0; subject < story.reasons.size(); ++subject) {
    if (story.reasons[subject] == 0) continue;
    doubts.push_back(say("{} doubted ({})", subject_words(subject), reason_text(story.reasons[subject])));
  }
  return clauses(doubts);
}

}  // namespace

bool Story::operator<(const Story& other) const {
  return std::tie(kind, refused, reasons) < std::tie(other.kind, other.refused, other.reasons);
}

Story story_of(const pose_wall_result& r) {
  Story story;
  const std::array<std::uint32_t, 4> reasons = {r.frame_reasons & kOfFrame, r.floor.reasons, r.left.reasons,
                                                r.right.reasons};
  for (const std::uint32_t subject : {kFloor, kLeft, kRight}) {
    if (is_refused(r, subject)) story.refused |= 1U << subject;
  }
  if (all_valid(r)) {
    story.kind = StoryKind::kValid;
  } else if ((story.refused >> kFloor & 1U) != 0) {
    story.kind = reasons[0] != 0 ? StoryKind::kFrameRefused : StoryKind::kFloorRefused;
    story.refused = 1U << (reasons[0] != 0 ? std::uint32_t{POSE_WALL_TRACE_FRAME} : kFloor);
    const std::size_t of = reasons[0] != 0 ? 0 : kFloor;
    story.reasons[of] = reasons[of];
  } else if (story.refused != 0) {
    story.kind = StoryKind::kWallsRefused;
    for (const std::uint32_t side : {kLeft, kRight}) {
      if ((story.refused >> side & 1U) != 0) story.reasons[side] = reasons[side];
    }
  } else if ((reasons[1] | reasons[2] | reasons[3]) != 0) {
    story.kind = StoryKind::kDoubted;
    story.reasons = {0, reasons[1], reasons[2], reasons[3]};
  } else {
    story.kind = StoryKind::kNotValid;
    story.reasons[0] = reasons_of_values(r);
  }
  return story;
}

std::string story_words(const Story& story) {
  switch (story.kind) {
    case StoryKind::kUnreadable:
      return tr("could not be read");
    case StoryKind::kFrameRefused:
      return refused_words(POSE_WALL_TRACE_FRAME, story.reasons[0]);
    case StoryKind::kFloorRefused:
      return refused_words(kFloor, story.reasons[kFloor]);
    case StoryKind::kWallsRefused:
      return walls_words(story);
    case StoryKind::kDoubted:
      return doubts_words(story);
    case StoryKind::kNotValid:
      return say("planes accepted, some values not valid ({})", reason_text(story.reasons[0]));
    case StoryKind::kValid:
      return tr("all seven values valid");
    default:
      return tr("other, each of few frames");
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
    case StoryKind::kValid:
      return "valid";
    default:
      return "other";
  }
}

}  // namespace pose_wall::tools::explain

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/steer/steer_cause.hpp"

#include <cmath>
#include <initializer_list>
#include <iterator>

#include "io/language/both_languages.hpp"
#include "pose_wall_trace.h"
#include "study/remedies/remedies.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;  // no reason, gate or part has this number
constexpr const char* kNothing = "";

// What helps against a cause: words of its own, else those of a gate, else those of a part of a level.
struct CauseWords {
  const char* words;
  const char* help = nullptr;
  std::uint32_t gate = kNone;
  std::uint32_t part = kNone;
};

constexpr CauseWords by_gate(const char* words, std::uint32_t gate) {
  return {words, nullptr, gate, kNone};
}

constexpr CauseWords by_part(const char* words, std::uint32_t part) {
  return {words, nullptr, kNone, part};
}

// By cause. Of several gates with one reason, the one whose help fits them all.
constexpr CauseWords kWords[] = {
    {translatable("too few points are left after the filters"),
     translatable(
         "clean the sensor's window; check range_min, range_max, the body boxes, and that lengths are in metres")},
    by_gate(translatable("there are more points than fit"), POSE_WALL_TRACE_VOXELS_FIT),
    by_gate(translatable("the stamps stand still"), POSE_WALL_TRACE_STAMP_STILL),
    by_gate(translatable("the stamp went back"), POSE_WALL_TRACE_STAMP_BACK),
    by_gate(translatable("the stamp leapt ahead"), POSE_WALL_TRACE_STAMP_LEAP),
    by_gate(translatable("an earlier cloud came again"), POSE_WALL_TRACE_FROZEN),
    by_gate(translatable("no floor is found"), POSE_WALL_TRACE_FLOOR_PLANES),
    by_gate(translatable("the floor has too few points"), POSE_WALL_TRACE_FLOOR_INLIERS),
    by_gate(translatable("too little of the floor is seen"), POSE_WALL_TRACE_FLOOR_AREA),
    by_gate(translatable("another surface may be the floor"), POSE_WALL_TRACE_FLOOR_BESIDE),
    by_gate(translatable("no wall is found"), POSE_WALL_TRACE_WALL_PLANES),
    by_gate(translatable("the wall has too few points"), POSE_WALL_TRACE_WALL_INLIERS),
    by_gate(translatable("too little of the wall is seen along the road"), POSE_WALL_TRACE_WALL_LENGTH),
    by_gate(translatable("the wall leans too far"), POSE_WALL_TRACE_WALL_LEAN),
    by_gate(translatable("what stands there is not solid like a wall"), POSE_WALL_TRACE_WALL_SOLID),
    by_part(translatable("another surface may be the wall"), POSE_WALL_PART_RIVAL),
    by_gate(translatable("the two walls are not parallel"), POSE_WALL_TRACE_WALLS_PARALLEL),
    by_gate(translatable("the machine is turned too far"), POSE_WALL_TRACE_WALL_YAW),
    by_gate(translatable("the machine stands across the road"), POSE_WALL_TRACE_ACROSS),
    by_part(translatable("the wall bends"), POSE_WALL_PART_BEND),
    by_part(translatable("the wall is unseen beside the machine"), POSE_WALL_PART_EXTRAPOLATION),
    {translatable("there is no floor to level by"), kNothing},
    by_part(translatable("the level is beyond the limit"), POSE_WALL_PART_RANDOM),
    {translatable("the value jumped or is new, not yet confirmed"),
     translatable("wait until it has come three times more")},
    by_part(translatable("the value still follows a turn"), POSE_WALL_PART_LAG),
    {translatable("it was not measured for too long"), kNothing},
    by_gate(translatable("something near blocks the view to this side"), POSE_WALL_TRACE_WALL_NEAR),
    {translatable("it was never measured"), kNothing},
    {translatable("no frame has come since"), translatable("look after the sensor, its power and its cable")},
    by_gate(translatable("the frame took more steps than work_max"), POSE_WALL_TRACE_WORK),
    by_gate(translatable("what was given with the frame contradicts it"), POSE_WALL_TRACE_INPUTS),
    by_part(translatable("the surface is rough, or little of it is seen"), POSE_WALL_PART_RANDOM),
    by_part(translatable("the ranges may all be off by range_bias_max"), POSE_WALL_PART_RANGE_BIAS),
    by_part(translatable("the surface is no plane"), POSE_WALL_PART_BEND),
    by_part(translatable("another surface may be the floor or the wall"), POSE_WALL_PART_RIVAL),
    by_part(translatable("the wall is unseen beside the machine"), POSE_WALL_PART_EXTRAPOLATION),
    by_part(translatable("the value lags behind this frame"), POSE_WALL_PART_LAG),
    {translatable("the motion since or within the scan is not known"),
     translatable("a first frame knows none; later ones need the times of their points, and no gaps between frames")},
};
static_assert(std::size(kWords) == kSteerCauses, "each cause has its words");

bool has(const pose_wall_value& value, std::uint32_t reason) {
  return (value.reasons & reason) != 0;
}

std::uint32_t bit_of(std::uint32_t reason) {
  std::uint32_t bit = 0;
  while (reason >> bit != 1U) ++bit;
  return bit;
}

std::uint32_t first_of(const pose_wall_value& value, std::initializer_list<std::uint32_t> reasons) {
  for (const std::uint32_t reason : reasons) {
    if (has(value, reason)) return bit_of(reason);
  }
  return kNone;
}

// Reasons that widen this part of a level, the weightiest first.
std::uint32_t reason_behind(const pose_wall_value& value) {
  switch (value.cause) {
    case POSE_WALL_PART_BEND:
      return first_of(value, {POSE_WALL_R_CURVED});
    case POSE_WALL_PART_RIVAL:
      return first_of(value, {POSE_WALL_R_INNOVATION, POSE_WALL_R_FLOOR_AMBIGUOUS, POSE_WALL_R_WALL_SEEN_THROUGH,
                              POSE_WALL_R_WALL_AMBIGUOUS});
    case POSE_WALL_PART_EXTRAPOLATION:
      return first_of(value, {POSE_WALL_R_EXTRAPOLATED});
    case POSE_WALL_PART_LAG:
      return first_of(value, {POSE_WALL_R_RATE_LIMITED});
    case POSE_WALL_PART_AGE:
      return first_of(value, {POSE_WALL_R_FROZEN});
    default:
      return kNone;
  }
}

std::uint32_t cause_of_measured(const pose_wall_value& value) {
  if (has(value, POSE_WALL_R_ALERT_LIMIT) && value.cause < POSE_WALL_PARTS) {
    const std::uint32_t reason = reason_behind(value);
    return reason != kNone ? reason : POSE_WALL_REASON_COUNT + value.cause;
  }
  // Doubts about surfaces stand in the level, which is within its limit.
  return first_of(value, {POSE_WALL_R_FROZEN, POSE_WALL_R_INNOVATION});
}

// As a frame goes through the engine. What says least of a wall, that none was found, stands behind what says more;
// what only says that nothing is left to hold stands last.
std::uint32_t cause_of_unmeasured(const pose_wall_value& value) {
  return first_of(value, {POSE_WALL_R_NO_FRAME,           POSE_WALL_R_WORK_LIMIT,       POSE_WALL_R_FROZEN,
                          POSE_WALL_R_STAMP_STILL,        POSE_WALL_R_NO_POINTS,        POSE_WALL_R_LEAF_GROWN,
                          POSE_WALL_R_FLOOR_THIN,         POSE_WALL_R_FLOOR_AMBIGUOUS,  POSE_WALL_R_FLOOR_FEW_INLIERS,
                          POSE_WALL_R_FLOOR_NOT_FOUND,    POSE_WALL_R_LEVEL_MISSING,    POSE_WALL_R_WALL_TOO_NEAR,
                          POSE_WALL_R_CROSS_ROAD,         POSE_WALL_R_YAW_OUT_OF_RANGE, POSE_WALL_R_WALL_SEEN_THROUGH,
                          POSE_WALL_R_WALL_SHORT,         POSE_WALL_R_WALL_FEW_INLIERS, POSE_WALL_R_WALL_LEANS,
                          POSE_WALL_R_WALLS_NOT_PARALLEL, POSE_WALL_R_WALL_AMBIGUOUS,   POSE_WALL_R_WALL_NOT_FOUND,
                          POSE_WALL_R_EXTRAPOLATED,       POSE_WALL_R_CURVED,           POSE_WALL_R_STAMP_BACK,
                          POSE_WALL_R_STAMP_LEAP,         POSE_WALL_R_INNOVATION,       POSE_WALL_R_PRIOR,
                          POSE_WALL_R_RATE_LIMITED,       POSE_WALL_R_HOLD_EXPIRED,     POSE_WALL_R_NEVER_MEASURED,
                          POSE_WALL_R_ALERT_LIMIT});
}

}  // namespace

bool is_measured(const pose_wall_value& value) {
  return value.state >= POSE_WALL_DEGRADED && std::isfinite(value.raw);
}

std::uint32_t steer_cause(const pose_wall_value& value) {
  if (value.state == POSE_WALL_VALID) return kMaySteer;
  std::uint32_t cause = is_measured(value) ? cause_of_measured(value) : kNone;
  if (cause == kNone) cause = cause_of_unmeasured(value);
  return cause != kNone ? cause : bit_of(POSE_WALL_R_NEVER_MEASURED);  // blank, as before the first frame
}

const char* steer_cause_name(std::uint32_t cause) {
  if (cause < POSE_WALL_REASON_COUNT) return pose_wall_reason_name(cause);
  return pose_wall_part_name(cause - POSE_WALL_REASON_COUNT);
}

std::string steer_cause_words(Language language, std::uint32_t cause) {
  return tr(language, kWords[cause].words);
}

std::string steer_remedy(Language language, std::uint32_t cause) {
  const CauseWords& row = kWords[cause];
  if (row.help != nullptr) return *row.help == '\0' ? "" : tr(language, row.help);
  return row.gate != kNone ? help_of_gate(language, row.gate) : help_of_part(language, row.part);
}

}  // namespace pose_wall::tools

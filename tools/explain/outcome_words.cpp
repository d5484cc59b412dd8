// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "explain/outcome_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "explain/amounts.hpp"
#include "explain/gate_words.hpp"
#include "explain/level_words.hpp"

namespace pose_wall::tools::explain {
namespace {

bool is_side(std::uint32_t subject) {
  return subject == POSE_WALL_TRACE_LEFT || subject == POSE_WALL_TRACE_RIGHT;
}

// The planes that a quantity hangs on.
std::vector<std::uint32_t> planes_behind(std::uint32_t quantity) {
  if (quantity < POSE_WALL_YAW) return {POSE_WALL_TRACE_FLOOR};
  if (quantity == POSE_WALL_YAW) return {POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_RIGHT};
  return {quantity <= POSE_WALL_D_LB ? static_cast<std::uint32_t>(POSE_WALL_TRACE_LEFT)
                                     : static_cast<std::uint32_t>(POSE_WALL_TRACE_RIGHT)};
}

std::string head(const pose_wall_value& v, std::uint32_t quantity) {
  std::string text = fmt::format("{}: {}", pose_wall_quantity_name(quantity), pose_wall_state_name(v.state));
  if (std::isfinite(v.value)) {
    text += fmt::format(", {} ± {}", quantity_amount(quantity, v.value), quantity_amount(quantity, v.protection_level));
  }
  if (v.age_s > 0.0) text += fmt::format(", {:.2f} s old", v.age_s);
  return text + ".";
}

std::string why_unmeasured(const Notes& notes, std::uint32_t quantity) {
  if (notes.refused(POSE_WALL_TRACE_FRAME)) return "Not measured: see the frame.";
  std::vector<std::string> refused;
  for (const std::uint32_t subject : planes_behind(quantity)) {
    const bool both = is_side(subject) && notes.refused(POSE_WALL_TRACE_WALLS);
    if (both || notes.refused(subject)) refused.push_back(subject_name(subject) + " refused");
  }
  if (refused.empty()) return "Not measured.";
  return fmt::format("Not measured: {}.", fmt::join(refused, ", "));
}

// What speaks against the planes it hangs on. With one wall left, the other does not speak against yaw.
std::vector<std::string> doubted(const Notes& notes, std::uint32_t quantity) {
  std::vector<std::string> out;
  for (const std::uint32_t subject : planes_behind(quantity)) {
    if (!notes.refused(subject) && !notes.failed(subject, POSE_WALL_TRACE_DOUBTS).empty()) {
      out.push_back(subject_name(subject) + " doubted");
    }
  }
  return out;
}

// The smoothed value's level says the same as the raw one's, and more.
bool is_said_by_another(const Note& note, const std::vector<Note>& failed) {
  return note.is(POSE_WALL_TRACE_PROTECTION_RAW) && std::any_of(failed.begin(), failed.end(), [](const Note& other) {
           return other.is(POSE_WALL_TRACE_PROTECTION_SMOOTHED);
         });
}

// Where the figures show it: the raw value with a level of its own. Where lag is the largest part, what it comes from.
std::string lag_sentence(const pose_wall_value& v, std::uint32_t quantity) {
  if (!shows_lag(v, quantity)) return "";
  const std::string raw = fmt::format(" This frame alone measured {} ± {}", quantity_amount(quantity, v.raw),
                                      quantity_amount(quantity, v.raw_protection_level));
  if (v.cause != POSE_WALL_PART_LAG) return raw + ".";
  return fmt::format("{}: the value follows what earlier frames said (temporal_smoothing_tau{}).", raw,
                     quantity == POSE_WALL_YAW ? ", yaw_rate_limit_deg" : "");
}

}  // namespace

std::string outcome_sentence(const pose_wall_result& result, const Notes& notes, std::uint32_t quantity) {
  const pose_wall_value& v = result.quantity[quantity];
  std::string text = head(v, quantity);
  const bool measured = std::isfinite(v.raw);
  const std::string sum = level_sum(v, quantity);
  if (!sum.empty()) text += fmt::format(" Its level: {}.", sum);
  if (!measured) text += " " + why_unmeasured(notes, quantity);
  if (measured) text += lag_sentence(v, quantity);
  if (measured && v.state != POSE_WALL_VALID) {
    const std::vector<std::string> planes = doubted(notes, quantity);
    if (!planes.empty()) text += fmt::format(" Degraded: {}.", fmt::join(planes, ", "));
    if (!notes.failed(POSE_WALL_TRACE_FRAME, POSE_WALL_TRACE_DOUBTS).empty()) text += " Degraded: see the frame.";
  }
  std::vector<Note> failed;
  for (const Note& note : notes.of(POSE_WALL_TRACE_QUANTITY + quantity)) {
    const bool of_a_refused_wall = !measured && note.info.effect == POSE_WALL_TRACE_DOUBTS;
    if (!note.passed() && !of_a_refused_wall) failed.push_back(note);
  }
  for (const Note& note : failed) {
    if (!is_said_by_another(note, failed)) text += " " + sentence_of(note);
  }
  return text;
}

}  // namespace pose_wall::tools::explain

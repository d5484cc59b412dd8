// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/outcome_words.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "io/language/engine_words.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/gate_words.hpp"
#include "study/explain/level_words.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

bool is_side(std::uint32_t subject) {
  return subject == POSE_WALL_TRACE_LEFT || subject == POSE_WALL_TRACE_RIGHT;
}

// The planes that a quantity depends on.
std::vector<std::uint32_t> planes_behind(std::uint32_t quantity) {
  if (quantity < POSE_WALL_YAW) return {POSE_WALL_TRACE_FLOOR};
  if (quantity == POSE_WALL_YAW) return {POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_RIGHT};
  return {quantity <= POSE_WALL_D_LB ? static_cast<std::uint32_t>(POSE_WALL_TRACE_LEFT)
                                     : static_cast<std::uint32_t>(POSE_WALL_TRACE_RIGHT)};
}

std::string head(const pose_wall_value& v, std::uint32_t quantity) {
  std::vector<std::string> parts = {state_words(v.state)};
  if (std::isfinite(v.value)) {
    parts.push_back(
        say("{}, error at most {}", quantity_amount(quantity, v.value), quantity_amount(quantity, v.protection_level)));
  }
  if (v.age_s > 0.0) parts.push_back(say("{:.2f} s old", v.age_s));
  return say("{}: {}.", pose_wall_quantity_name(quantity), in_a_row(parts));
}

std::string why_unmeasured(const Notes& notes, std::uint32_t quantity) {
  if (notes.refused(POSE_WALL_TRACE_FRAME)) return tr("Not measured: see the frame.");
  std::vector<std::string> refused;
  for (const std::uint32_t subject : planes_behind(quantity)) {
    const bool both = is_side(subject) && notes.refused(POSE_WALL_TRACE_WALLS);
    if (both || notes.refused(subject)) refused.push_back(say("{} refused", subject_words(subject)));
  }
  return refused.empty() ? tr("Not measured.") : say("Not measured: {}.", listed(refused));
}

// Doubts about the planes it depends on. Where one wall is refused, only the other counts for yaw.
std::vector<std::string> doubted(const Notes& notes, std::uint32_t quantity) {
  std::vector<std::string> out;
  for (const std::uint32_t subject : planes_behind(quantity)) {
    if (!notes.refused(subject) && !notes.failed(subject, POSE_WALL_TRACE_DOUBTS).empty()) {
      out.push_back(subject_words(subject));
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

// What lowers a level, by its largest part. Never the limit: a wider one lowers no error.
constexpr const char* kHelpOfPart[POSE_WALL_PARTS] = {
    translatable("show more of the surface: mount the sensor where it sees more of it, keep body boxes to the machine "
                 "itself, or take a sensor of more beams"),
    translatable("set range_bias_max to the sensor's data sheet"),
    translatable("a bent surface is no plane: look at a straighter piece"),
    translatable("another plane may be the surface: see what was doubted above, clear or show it"),
    translatable(
        "the wall is not seen at the sampling point: mount the sensor where nothing hides the wall there, set s_front "
        "and s_back to where it is seen, or measure the piece beside the machine (region: on)"),
    translatable("wait until the value has followed"),
    translatable("frames are missing or late"),
};

bool is_about_level(const Note& note) {
  return note.is(POSE_WALL_TRACE_PROTECTION_RAW) || note.is(POSE_WALL_TRACE_PROTECTION_SMOOTHED);
}

// The level of this frame's own measurement passed, and what earlier frames left in doubt was added to it.
std::string kept_doubt(const pose_wall_value& v, const Notes& notes, std::uint32_t quantity) {
  if (!std::isfinite(v.raw) || v.cause != POSE_WALL_PART_RIVAL || v.raw_state == POSE_WALL_VALID) return "";
  const std::vector<Note> all = notes.of(POSE_WALL_TRACE_QUANTITY + quantity);
  const bool passed = std::any_of(all.begin(), all.end(), [](const Note& note) {
    return note.is(POSE_WALL_TRACE_PROTECTION_RAW) && note.passed();
  });
  return passed ? tr("By itself this frame would be valid; the rival plane was seen in one of the last frames.") : "";
}

// The raw value with its own level, where the figures differ. Where lag is the largest part, also its cause.
std::string lag_sentence(const pose_wall_value& v, std::uint32_t quantity) {
  if (!shows_lag(v, quantity)) return "";
  const std::string raw = quantity_amount(quantity, v.raw), level = quantity_amount(quantity, v.raw_protection_level);
  if (v.cause != POSE_WALL_PART_LAG) return say("This frame alone measured {} ± {}.", raw, level);
  return say("This frame alone measured {} ± {}: the value follows earlier frames ({}).", raw, level,
             quantity == POSE_WALL_YAW ? "temporal_smoothing_tau, yaw_rate_limit_deg" : "temporal_smoothing_tau");
}

std::vector<Note> failed_notes(const Notes& notes, std::uint32_t quantity, bool measured) {
  std::vector<Note> failed;
  for (const Note& note : notes.of(POSE_WALL_TRACE_QUANTITY + quantity)) {
    const bool of_a_refused_wall = !measured && note.info.effect == POSE_WALL_TRACE_DOUBTS;
    if (!note.passed() && !of_a_refused_wall) failed.push_back(note);
  }
  const auto is_repeated = [all = failed](const Note& note) { return is_said_by_another(note, all); };
  failed.erase(std::remove_if(failed.begin(), failed.end(), is_repeated), failed.end());
  return failed;
}

}  // namespace

std::string outcome_sentence(const pose_wall_result& result, const Notes& notes, std::uint32_t quantity,
                             const RivalsSeen& rivals) {
  const pose_wall_value& v = result.quantity[quantity];
  const bool measured = std::isfinite(v.raw);
  const std::string sum = level_sum(v, quantity);
  std::vector<std::string> told = {head(v, quantity), sum.empty() ? "" : say("Its level: {}.", sum)};
  told.push_back(measured ? lag_sentence(v, quantity) : why_unmeasured(notes, quantity));
  told.push_back(kept_doubt(v, notes, quantity));
  const std::vector<std::string> planes = doubted(notes, quantity);
  if (measured && !planes.empty()) told.push_back(say("Its level holds the doubts about: {}.", listed(planes)));
  if (measured && v.state != POSE_WALL_VALID) {
    if (!notes.failed(POSE_WALL_TRACE_FRAME, POSE_WALL_TRACE_DOUBTS).empty()) {
      told.emplace_back(tr("Degraded: see the frame."));
    }
  }
  const std::optional<std::uint64_t> rival_frame = rivals.last(quantity);
  for (const Note& note : failed_notes(notes, quantity, measured)) {
    told.push_back(sentence_of(note));
    if (note.is(POSE_WALL_TRACE_DOUBTED) && rival_frame)
      told.push_back(say("It was last seen in frame {}.", *rival_frame));
  }
  return paragraph(told);
}

std::vector<std::string> outcome_helps(const pose_wall_result& result, const Notes& notes, std::uint32_t quantity) {
  std::vector<std::string> helps;
  for (const Note& note : failed_notes(notes, quantity, std::isfinite(result.quantity[quantity].raw))) {
    const std::uint32_t cause = result.quantity[quantity].cause;
    if (is_about_level(note) && cause < POSE_WALL_PARTS) helps.emplace_back(tr(kHelpOfPart[cause]));
    helps.push_back(help_of(note));
  }
  return helps;
}

}  // namespace pose_wall::tools::explain

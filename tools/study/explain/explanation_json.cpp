// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/explanation_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"
#include "io/numbers/quantities.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/candidate_words.hpp"

namespace pose_wall::tools::explain {
namespace {

Json paragraphs_json(const Explanation& explanation) {
  Json out = Json::array();
  for (const Paragraph& p : explanation.paragraphs) {
    out.push_back({{"of", subject_name(p.subject)},
                   {"verdict", acceptance_name(p.acceptance)},
                   {"sentences", p.sentences},
                   {"to_look_at", p.helps}});
  }
  return out;
}

Json outcome_json(const pose_wall_result& result, const Explanation& explanation) {
  Json out = Json::array();
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = result.quantity[q];
    out.push_back({{"quantity", pose_wall_quantity_name(q)},
                   {"state", pose_wall_state_name(v.state)},
                   {"value", v.value},
                   {"protection_level", v.protection_level},
                   {"parts", parts_json(v)},
                   {"cause", v.cause < POSE_WALL_PARTS ? Json(cause_name(v)) : Json()},
                   {"raw", v.raw},
                   {"raw_protection_level", v.raw_protection_level},
                   {"raw_state", pose_wall_state_name(v.raw_state)},
                   {"age_s", v.age_s},
                   {"reasons", reason_list(v.reasons)},
                   {"sentence", explanation.outcome.at(q)}});
  }
  return out;
}

Json gates_json(const Notes& notes) {
  Json out = Json::array();
  for (const Note& note : notes.all()) {
    const bool has_ratio = note.info.sense != POSE_WALL_TRACE_IS_SO && std::fabs(note.gate.limit) > 0.0;
    out.push_back({{"of", subject_name(note.gate.subject)},
                   {"gate", note.info.name},
                   {"is", note.info.asks},
                   {"key", key_of(note)},
                   {"unit", note.info.unit},
                   {"value", note.gate.value},
                   {"limit", note.gate.limit},
                   {"ratio", has_ratio ? Json(note.gate.value / note.gate.limit) : Json()},
                   {"passed", note.passed()},
                   {"answered", note.answered()},
                   {"reasons", note.passed() ? Json::array() : reason_list(note.info.reasons)}});
  }
  return out;
}

Json planes_json(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes) {
  Json out = Json::array();
  for (const std::uint32_t subject : {POSE_WALL_TRACE_FLOOR, POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_RIGHT,
                                      POSE_WALL_TRACE_AHEAD, POSE_WALL_TRACE_BEHIND}) {
    for (const PlaneWords& p : planes_of(config, result, notes, subject)) {
      const pose_wall_trace_candidate& c = p.candidate;
      out.push_back({{"of", subject_name(subject)},
                     {"chosen", c.fate == POSE_WALL_TRACE_CHOSEN},
                     {"lies", p.where},
                     {"shows", p.shows},
                     {"became_of_it", p.fate},
                     {"normal", c.normal},
                     {"d_m", c.d_m},
                     {"score_m2", c.score_m2},
                     {"area_m2", c.area_m2},
                     {"length_m", c.length_m},
                     {"seen_through", c.seen_through}});
    }
  }
  return out;
}

}  // namespace

Json explanation_page(const pose_wall_config& config, const FrameOutcome& outcome, const TracedFrame& traced,
                      const Explanation& explanation) {
  const Notes notes(*traced.trace);
  return {{"frame", outcome.frame},
          {"source", outcome.source},
          {"stamp_ns", outcome.stamp_ns},
          {"frame_reasons", reason_list(traced.result.frame_reasons)},
          {"explanation", paragraphs_json(explanation)},
          {"outcome", outcome_json(traced.result, explanation)},
          {"outcome_to_look_at", explanation.outcome_helps},
          {"gates", gates_json(notes)},
          {"planes", planes_json(config, traced.result, notes)}};
}

std::string explanation_json(const pose_wall_config& config, const FrameOutcome& outcome, const TracedFrame& traced,
                             const Explanation& explanation) {
  return json_text(explanation_page(config, outcome, traced, explanation), 2) + "\n";
}

}  // namespace pose_wall::tools::explain

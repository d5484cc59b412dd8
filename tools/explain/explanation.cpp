// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "explain/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "explain/amounts.hpp"
#include "explain/candidate_words.hpp"
#include "explain/filter_words.hpp"
#include "explain/gate_words.hpp"
#include "explain/outcome_words.hpp"

namespace pose_wall::tools::explain {
namespace {

void add_once(std::vector<std::string>& list, const std::string& text) {
  if (!text.empty() && std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

// The notes of a side and those of both at once.
std::vector<Note> failed(const Notes& notes, std::uint32_t subject, std::uint32_t effect) {
  const bool is_side = subject == POSE_WALL_TRACE_LEFT || subject == POSE_WALL_TRACE_RIGHT;
  std::vector<Note> out;
  if (is_side) out = notes.failed(POSE_WALL_TRACE_WALLS, effect);
  const std::vector<Note> own = notes.failed(subject, effect);
  out.insert(out.end(), own.begin(), own.end());
  return out;
}

void tell(const std::vector<Note>& notes, Paragraph* out) {
  for (const Note& note : notes) {
    add_once(out->sentences, sentence_of(note));
    add_once(out->helps, help_of(note));
  }
}

// What the gates speak of, first.
std::string first_plane(const std::vector<PlaneWords>& planes, Verdict verdict) {
  if (planes.empty()) return "";
  const PlaneWords& p = planes.front();
  const bool chosen = p.candidate.fate == POSE_WALL_TRACE_CHOSEN;
  if (!chosen && verdict != Verdict::kRefused) return "";
  return fmt::format("The plane that {} lies {} ({}).", chosen ? "was chosen" : "shows most", p.where, p.shows);
}

// A frame without a floor, or without points, has nothing to say of planes.
Paragraph plane_paragraph(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes,
                          std::uint32_t subject) {
  const std::vector<Note> refusals = failed(notes, subject, POSE_WALL_TRACE_REFUSES);
  const std::vector<Note> doubts = failed(notes, subject, POSE_WALL_TRACE_DOUBTS);
  const bool nothing_looked_at = notes.of(subject).empty() && refusals.empty();
  const bool is_refused = !refusals.empty() || nothing_looked_at;
  Paragraph out{
      subject, is_refused ? Verdict::kRefused : (doubts.empty() ? Verdict::kAccepted : Verdict::kDoubted), {}, {}};
  std::vector<PlaneWords> planes = planes_of(config, result, notes, subject);
  std::stable_partition(planes.begin(), planes.end(),
                        [](const PlaneWords& p) { return p.candidate.fate == POSE_WALL_TRACE_CHOSEN; });
  if (nothing_looked_at) out.sentences.emplace_back("It was not looked for: see the frame.");
  add_once(out.sentences, first_plane(planes, out.verdict));
  tell(refusals, &out);
  tell(doubts, &out);
  add_once(out.sentences, others_sentence(planes));
  return out;
}

Paragraph frame_paragraph(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes) {
  const bool refused = notes.refused(POSE_WALL_TRACE_FRAME);
  const bool doubted = !notes.failed(POSE_WALL_TRACE_FRAME, POSE_WALL_TRACE_DOUBTS).empty();
  Paragraph out{
      POSE_WALL_TRACE_FRAME, refused ? Verdict::kRefused : (doubted ? Verdict::kDoubted : Verdict::kAccepted), {}, {}};
  for (const std::uint32_t effect : {POSE_WALL_TRACE_REFUSES, POSE_WALL_TRACE_DOUBTS, POSE_WALL_TRACE_TELLS}) {
    for (const Note& note : notes.failed(POSE_WALL_TRACE_FRAME, effect)) {
      tell({note}, &out);
      if (note.is(POSE_WALL_TRACE_POINTS)) {
        const FilterWords filters = filter_words(config, result);
        add_once(out.sentences, filters.sentence);
        add_once(out.helps, filters.help);
      }
    }
  }
  if (out.sentences.empty()) out.sentences.push_back(filter_words(config, result).sentence);
  return out;
}

}  // namespace

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAccepted:
      return "accepted";
    case Verdict::kDoubted:
      return "doubted";
    default:
      return "refused";
  }
}

Explanation explain_frame(const pose_wall_config& config, const pose_wall_result& result,
                          const pose_wall_trace& trace) {
  const Notes notes(trace);
  Explanation out;
  out.paragraphs.push_back(frame_paragraph(config, result, notes));
  for (const std::uint32_t subject : {POSE_WALL_TRACE_FLOOR, POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_RIGHT}) {
    out.paragraphs.push_back(plane_paragraph(config, result, notes, subject));
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) out.outcome.push_back(outcome_sentence(result, notes, q));
  return out;
}

}  // namespace pose_wall::tools::explain

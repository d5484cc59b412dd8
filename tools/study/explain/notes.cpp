// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/notes.hpp"

#include <algorithm>

namespace pose_wall::tools::explain {
namespace {

Note note_of(const pose_wall_trace_gate& gate) {
  Note note{gate, {}};
  pose_wall_trace_gate_info(gate.gate, &note.info);
  return note;
}

bool found_no_plane(const pose_wall_trace_gate& gate) {
  return gate.passed == 0 && (gate.gate == POSE_WALL_TRACE_FLOOR_POINTS || gate.gate == POSE_WALL_TRACE_FLOOR_PLANES);
}

}  // namespace

Notes::Notes(const pose_wall_trace& trace) : trace_(&trace), floor_attempt_(trace.floor_attempt) {
  for (const Note& note : of(POSE_WALL_TRACE_FLOOR)) {
    if (found_no_plane(note.gate)) floor_attempt_ = trace.floor_attempts - 1;
  }
}

bool Notes::counts(const pose_wall_trace_gate& gate) const {
  return gate.subject != POSE_WALL_TRACE_FLOOR || gate.attempt == floor_attempt_;
}

std::vector<Note> Notes::all() const {
  std::vector<Note> out;
  for (std::uint32_t i = 0; i < trace_->gates; ++i) {
    if (counts(trace_->gate[i])) out.push_back(note_of(trace_->gate[i]));
  }
  return out;
}

std::vector<Note> Notes::of(std::uint32_t subject) const {
  std::vector<Note> out = all();
  out.erase(std::remove_if(out.begin(), out.end(), [&](const Note& n) { return n.gate.subject != subject; }),
            out.end());
  return out;
}

std::vector<Note> Notes::failed(std::uint32_t subject, std::uint32_t effect) const {
  std::vector<Note> out = of(subject);
  out.erase(std::remove_if(out.begin(), out.end(),
                           [&](const Note& n) { return n.passed() || n.answered() || n.info.effect != effect; }),
            out.end());
  std::stable_sort(out.begin(), out.end(), [](const Note& a, const Note& b) { return a.gate.gate < b.gate.gate; });
  return out;
}

std::vector<Note> Notes::answered(std::uint32_t subject) const {
  std::vector<Note> out = of(subject);
  out.erase(std::remove_if(out.begin(), out.end(), [](const Note& n) { return !n.answered(); }), out.end());
  return out;
}

std::vector<pose_wall_trace_candidate> Notes::candidates(std::uint32_t subject) const {
  std::vector<pose_wall_trace_candidate> out;
  for (std::uint32_t i = 0; i < trace_->candidates; ++i) {
    const pose_wall_trace_candidate& c = trace_->candidate[i];
    const bool taken = subject != POSE_WALL_TRACE_FLOOR || c.attempt == floor_attempt_;
    if (c.subject == subject && taken) out.push_back(c);
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.score_m2 > b.score_m2; });
  return out;
}

}  // namespace pose_wall::tools::explain

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/explanation_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "io/language/language.hpp"
#include "io/terminal/program_word.hpp"
#include "io/terminal/text_table.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/candidate_words.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

constexpr std::size_t kWidth = 110;
constexpr std::size_t kIndent = 2;
// Of the planes across the road only the strongest matter.
constexpr std::size_t kAcrossTold = 2;

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string ratio_text(const Note& note) {
  if (note.info.sense == POSE_WALL_TRACE_IS_SO || !(std::fabs(note.gate.limit) > 0.0)) return "";
  return fmt::format("{:.3g}", note.gate.value / note.gate.limit);
}

const char* passed_text(const Note& note) {
  if (note.passed()) return tr("passed");
  if (note.answered()) return tr("answered");
  switch (note.info.effect) {
    case POSE_WALL_TRACE_REFUSES:
      return tr("REFUSES");
    case POSE_WALL_TRACE_DOUBTS:
      return tr("doubts");
    default:
      return tr("tells");
  }
}

const char* colour_of(const Note& note) {
  if (note.passed() || note.answered()) return "";
  switch (note.info.effect) {
    case POSE_WALL_TRACE_REFUSES:
      return "\033[31m";
    case POSE_WALL_TRACE_DOUBTS:
      return "\033[33m";
    default:
      return "\033[34m";
  }
}

// Their rows in the table: what failed stands first, else in the order of the pipeline.
std::vector<std::size_t> failing_first(const std::vector<Note>& notes) {
  std::vector<std::size_t> order(notes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [&notes](std::size_t index) { return !notes[index].passed(); });
  return order;
}

std::string coloured_rows(const std::string& table, const std::vector<Note>& notes,
                          const std::vector<std::size_t>& order) {
  constexpr std::size_t kHeadLines = 2;
  std::istringstream lines(table);
  std::string line, out;
  for (std::size_t row = 0; std::getline(lines, line); ++row) {
    const std::size_t i = row - kHeadLines;
    const std::string colour = row >= kHeadLines && i < notes.size() ? colour_of(notes[order[i]]) : "";
    out += colour.empty() ? line + "\n" : colour + line + "\033[0m\n";
  }
  return out;
}

// Several gates may have the same remedy: each clause once.
std::string to_look_at(const std::vector<std::string>& helps) {
  std::vector<std::string> once;
  for (const std::string& help : helps) {
    for (const std::string& clause : clauses_of(help)) {
      if (std::find(once.begin(), once.end(), clause) == once.end()) once.push_back(clause);
    }
  }
  return say("To look at: {}.", clauses(once));
}

}  // namespace

std::string sentences_text(const Explanation& explanation) {
  std::string out;
  for (const Paragraph& p : explanation.paragraphs) {
    out += say("{}: {}", capital(subject_words(p.subject)), acceptance_words(p.acceptance)) + "\n";
    out += wrapped(paragraph(p.sentences), kIndent, kWidth);
    if (!p.helps.empty()) out += wrapped(to_look_at(p.helps), kIndent, kWidth);
    out += "\n";
  }
  out += tr("Outcome");
  out += "\n";
  for (const std::string& sentence : explanation.outcome) out += wrapped(sentence, kIndent, kWidth);
  if (!explanation.outcome_helps.empty()) out += wrapped(to_look_at(explanation.outcome_helps), kIndent, kWidth);
  return out;
}

std::string planes_text(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes) {
  std::size_t rows = 0;
  TextTable table({tr("plane of"), tr("lies"), tr("shows"), tr("result"), tr("score")});
  for (const std::uint32_t subject : {POSE_WALL_TRACE_FLOOR, POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_RIGHT,
                                      POSE_WALL_TRACE_AHEAD, POSE_WALL_TRACE_BEHIND}) {
    const bool is_across = subject == POSE_WALL_TRACE_AHEAD || subject == POSE_WALL_TRACE_BEHIND;
    std::size_t told = 0;
    for (const PlaneWords& p : planes_of(config, result, notes, subject)) {
      if (is_across && told++ == kAcrossTold) break;
      ++rows;
      table.add_row({subject_words(subject), p.where, p.shows, p.fate, fmt::format("{:.2f} m²", p.candidate.score_m2)});
    }
  }
  return rows > 0 ? table.text(4) : std::string(tr("none")) + "\n";
}

// A wall meets some gates twice, as it was drawn and as it was fitted.
std::string name_of(const std::vector<Note>& all, std::size_t index) {
  const Note& note = all[index];
  const bool is_of_a_plane = note.is(POSE_WALL_TRACE_WALL_INLIERS) || note.is(POSE_WALL_TRACE_WALL_LENGTH) ||
                             note.is(POSE_WALL_TRACE_WALL_SOLID) || note.is(POSE_WALL_TRACE_WALL_LEAN);
  const auto is_the_same = [&note](const Note& later) {
    return later.gate.subject == note.gate.subject && later.gate.gate == note.gate.gate;
  };
  const bool is_asked_again =
      is_of_a_plane && std::any_of(all.begin() + static_cast<std::ptrdiff_t>(index) + 1, all.end(), is_the_same);
  return is_asked_again ? say("{} (drawn)", note.info.name) : note.info.name;
}

std::string gates_text(const Notes& notes, bool coloured) {
  const std::vector<Note> all = notes.all();
  TextTable table({tr("of"), tr("gate"), tr("key"), tr("value"), "", tr("limit"), tr("ratio"), ""});
  const std::vector<std::size_t> order = failing_first(all);
  for (const std::size_t index : order) {
    const Note& note = all[index];
    const char* sense = note.info.sense == POSE_WALL_TRACE_IS_SO      ? tr("is")
                        : note.info.sense == POSE_WALL_TRACE_AT_LEAST ? ">="
                        : note.info.sense == POSE_WALL_TRACE_BELOW    ? "<"
                                                                      : "<=";
    table.add_row({subject_words(note.gate.subject), name_of(all, index), key_of(note), value_text(note), sense,
                   limit_text(note), ratio_text(note), passed_text(note)});
  }
  const std::string text = table.text(3);
  return (coloured ? coloured_rows(text, all, order) : text) +
         say("Meaning of each gate: {}", program_word() + " explain --gates") + "\n";
}

}  // namespace pose_wall::tools::explain

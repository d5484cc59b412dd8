// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/explanation.hpp"

#include <algorithm>

#include "io/language/language.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/candidate_words.hpp"
#include "study/explain/filter_words.hpp"
#include "study/explain/gate_words.hpp"
#include "study/explain/outcome_words.hpp"
#include "study/explain/prose.hpp"

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

const Note* find(const std::vector<Note>& notes, pose_wall_trace_gate_id id) {
  const auto found = std::find_if(notes.begin(), notes.end(), [&](const Note& n) { return n.is(id); });
  return found != notes.end() ? &*found : nullptr;
}

bool is_of_any_wall(const Note& note) {
  return note.is(POSE_WALL_TRACE_WALL_INLIERS) || note.is(POSE_WALL_TRACE_WALL_LENGTH) ||
         note.is(POSE_WALL_TRACE_WALL_SOLID) || note.is(POSE_WALL_TRACE_WALL_LEAN);
}

// True where a weightier gate gives the same message: requirements of a wall that stands alone where there is no wall,
// and open area that is silent.
bool is_said_already(const Note& note, const std::vector<Note>& refusals) {
  if (note.is(POSE_WALL_TRACE_WALL_LENGTH_ALONE)) {
    return std::any_of(refusals.begin(), refusals.end(), [](const Note& n) { return is_of_any_wall(n); });
  }
  const Note* const silent = find(refusals, POSE_WALL_TRACE_WALL_SILENT);
  return note.is(POSE_WALL_TRACE_WALL_OPEN_DOUBT) && silent != nullptr && note.gate.value < 1.1 * silent->gate.value;
}

bool is_rival(const Note& note) {
  return note.is(POSE_WALL_TRACE_FLOOR_RIVAL) || note.is(POSE_WALL_TRACE_WALL_RIVAL);
}

// Each rival has a note of its own. The strongest gets a sentence, which counts the others; theirs are empty.
std::string rival_sentence(const Note& rival, const std::vector<Note>& notes) {
  std::size_t others = 0;
  const Note* strongest = &rival;
  for (const Note& n : notes) {
    if (n.gate.gate != rival.gate.gate || &n == &rival) continue;
    ++others;
    if (n.gate.value > strongest->gate.value) strongest = &n;
  }
  if (strongest != &rival) return "";
  if (others == 0) return sentence_of(rival);
  return paragraph({sentence_of(rival), others == 1 ? say("The same holds for {} further plane.", others)
                                                    : say("The same holds for {} further planes.", others)});
}

void tell(const std::vector<Note>& notes, const std::vector<Note>& refusals, Paragraph* out) {
  for (const Note& note : notes) {
    if (is_said_already(note, refusals)) continue;
    add_once(out->sentences, is_rival(note) ? rival_sentence(note, notes) : sentence_of(note));
    add_once(out->helps, help_of(note));
  }
}

// The plane that the gates are about.
std::string first_plane(const std::vector<PlaneWords>& planes, Acceptance acceptance) {
  if (planes.empty()) return "";
  const PlaneWords& p = planes.front();
  const bool chosen = p.candidate.fate == POSE_WALL_TRACE_CHOSEN;
  if (!chosen && acceptance != Acceptance::kRefused) return "";
  if (p.candidate.fate == POSE_WALL_TRACE_OUT_OF_RANGE) {
    return say("The strongest plane lies {} ({}): {}.", p.where, p.shows, p.fate);
  }
  return chosen ? say("The chosen plane lies {} ({}).", p.where, p.shows)
                : say("The strongest plane lies {} ({}).", p.where, p.shows);
}

std::string looked_for(const Notes& notes) {
  const std::uint32_t attempt = notes.floor_attempt();
  const std::string radius = metres(notes.floor_radius_m(attempt));
  if (attempt == 0) return say("The search reached {} around the machine.", radius);
  return say("The search began within {} of the machine and widened to {}. The figures are of the widest search.",
             metres(notes.floor_radius_m(0)), radius);
}

// Not a gate: where no wall is chosen beside the machine, walls ahead and behind show how it stands.
std::string across_sentence(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes,
                            const std::vector<PlaneWords>& beside) {
  constexpr double kClearlyMore = 2.0;
  std::vector<std::string> walls;
  for (const std::uint32_t subject : {POSE_WALL_TRACE_AHEAD, POSE_WALL_TRACE_BEHIND}) {
    const std::vector<PlaneWords> planes = planes_of(config, result, notes, subject);
    const double beside_m2 = beside.empty() ? 0.0 : beside.front().candidate.score_m2;
    if (planes.empty() || planes.front().candidate.reasons != 0) continue;
    if (!(planes.front().candidate.score_m2 > kClearlyMore * beside_m2)) continue;
    walls.push_back(say("{} {} ({})", subject_words(subject), planes.front().where, planes.front().shows));
  }
  if (walls.empty()) return "";
  const std::string places = walls.size() == 1 ? walls[0] : say("{} and {}", walls[0], walls[1]);
  return say("Much more wall is seen {}: the machine seems to stand across the road.", places);
}

// Gates that failed on the endless plane, whose place that of the region took.
std::string answered_sentence(const std::vector<Note>& answered) {
  std::vector<std::string> names;
  for (const Note& note : answered) add_once(names, note.info.name);
  if (names.empty()) return "";
  return say(
      "The plane of all that is in view failed {}. The value is of the region beside the machine, which answers it.",
      listed(names));
}

std::uint32_t reasons_of(const pose_wall_result& result, std::uint32_t subject) {
  if (subject == POSE_WALL_TRACE_FLOOR) return result.floor.reasons;
  return subject == POSE_WALL_TRACE_LEFT ? result.left.reasons : result.right.reasons;
}

// Without a floor or points no plane was looked for.
Paragraph plane_paragraph(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes,
                          std::uint32_t subject) {
  const std::vector<Note> refusals = failed(notes, subject, POSE_WALL_TRACE_REFUSES);
  const std::vector<Note> doubts = failed(notes, subject, POSE_WALL_TRACE_DOUBTS);
  const bool nothing_looked_at = notes.of(subject).empty() && refusals.empty();
  const bool is_refused = !refusals.empty() || nothing_looked_at;
  const std::vector<Note> answered = notes.answered(subject);
  // The result may tell the reason of an answered gate, as a doubt.
  const bool is_doubted = !doubts.empty() || std::any_of(answered.begin(), answered.end(), [&](const Note& n) {
    return (n.info.reasons & reasons_of(result, subject)) != 0;
  });
  Paragraph out{
      subject, is_refused ? Acceptance::kRefused : (is_doubted ? Acceptance::kDoubted : Acceptance::kAccepted), {}, {}};
  std::vector<PlaneWords> planes = planes_of(config, result, notes, subject);
  std::stable_partition(planes.begin(), planes.end(),
                        [](const PlaneWords& p) { return p.candidate.fate == POSE_WALL_TRACE_CHOSEN; });
  if (nothing_looked_at) out.sentences.emplace_back(tr("It was not looked for: see the frame."));
  if (is_refused && notes.floor_attempts() > 0 && subject == POSE_WALL_TRACE_FLOOR) {
    out.sentences.push_back(looked_for(notes));
  }
  add_once(out.sentences, first_plane(planes, out.acceptance));
  tell(refusals, refusals, &out);
  if (find(refusals, POSE_WALL_TRACE_WALL_CHOSEN) != nullptr) {
    tell(notes.failed(POSE_WALL_TRACE_WALLS, POSE_WALL_TRACE_TELLS), refusals, &out);
    const std::string across = across_sentence(config, result, notes, planes);
    add_once(out.sentences, across);
    // First: while these are wrong, a wider gate only hides the fault.
    if (!across.empty()) out.helps.insert(out.helps.begin(), tr("check forward_axis and extrinsic_yaw"));
  }
  tell(doubts, refusals, &out);
  add_once(out.sentences, answered_sentence(answered));
  add_once(out.sentences, others_sentence(planes));
  return out;
}

Paragraph frame_paragraph(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes) {
  const bool refused = notes.refused(POSE_WALL_TRACE_FRAME);
  const bool doubted = !notes.failed(POSE_WALL_TRACE_FRAME, POSE_WALL_TRACE_DOUBTS).empty();
  Paragraph out{POSE_WALL_TRACE_FRAME,
                refused ? Acceptance::kRefused : (doubted ? Acceptance::kDoubted : Acceptance::kAccepted),
                {},
                {}};
  for (const std::uint32_t effect : {POSE_WALL_TRACE_REFUSES, POSE_WALL_TRACE_DOUBTS, POSE_WALL_TRACE_TELLS}) {
    for (const Note& note : notes.failed(POSE_WALL_TRACE_FRAME, effect)) {
      tell({note}, {}, &out);
      if (note.is(POSE_WALL_TRACE_POINTS)) {
        const FilterWords filters = filter_words(config, result);
        add_once(out.sentences, filters.sentence);
        add_once(out.helps, filters.help);
      }
    }
  }
  if (out.sentences.empty()) {
    const FilterWords filters = filter_words(config, result);
    out.sentences.push_back(filters.sentence);
    add_once(out.helps, filters.help);
  }
  return out;
}

}  // namespace

const char* acceptance_name(Acceptance acceptance) {
  switch (acceptance) {
    case Acceptance::kAccepted:
      return "accepted";
    case Acceptance::kDoubted:
      return "doubted";
    default:
      return "refused";
  }
}

std::string acceptance_words(Acceptance acceptance) {
  switch (acceptance) {
    case Acceptance::kAccepted:
      return tr("accepted");
    case Acceptance::kDoubted:
      return tr("doubted");
    default:
      return tr("refused");
  }
}

Explanation explain_frame(const pose_wall_config& config, const pose_wall_result& result, const pose_wall_trace& trace,
                          const RivalsSeen& rivals) {
  const Notes notes(trace);
  Explanation out;
  out.paragraphs.push_back(frame_paragraph(config, result, notes));
  for (const std::uint32_t subject : {POSE_WALL_TRACE_FLOOR, POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_RIGHT}) {
    out.paragraphs.push_back(plane_paragraph(config, result, notes, subject));
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    out.outcome.push_back(outcome_sentence(result, notes, q, rivals));
    for (const std::string& help : outcome_helps(result, notes, q)) add_once(out.outcome_helps, help);
  }
  return out;
}

}  // namespace pose_wall::tools::explain

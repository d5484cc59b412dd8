// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/ablation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "campaign/traced_runs.hpp"
#include "explain/gate_list.hpp"
#include "results/json_words.hpp"
#include "terminal/counted.hpp"
#include "terminal/did_you_mean.hpp"
#include "terminal/text_table.hpp"

namespace pose_wall::tools::campaign {
namespace {

// Frames in which each gate failed.
using FailedFrames = std::array<std::size_t, POSE_WALL_TRACE_GATES>;
using AblatedRun = TracedRun<FailedFrames>;

void count_failed(const pose_wall_trace& trace, FailedFrames* failed) {
  for (std::uint32_t gate = 0; gate < failed->size(); ++gate) {
    if (has_failed(trace, gate)) ++failed->at(gate);
  }
}

std::vector<AblatedRun> traced(const EngineChoice& choice, const std::vector<Run>& runs, const Crew& crew) {
  return traced_runs<FailedFrames>(choice, runs, crew, count_failed);
}

// The fit takes a plane as given: without it there is nothing to begin with.
bool is_indispensable(std::uint32_t gate) {
  return gate == POSE_WALL_TRACE_FLOOR_PLANES;
}

struct AblationRequest {
  std::vector<Gates> rows;
  std::string fault;
};

AblationRequest parse_ablation(const std::string& words) {
  AblationRequest parsed;
  if (words == "each") {
    for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES; ++gate) {
      if (!is_indispensable(gate)) parsed.rows.push_back({gate});
    }
    return parsed;
  }
  const std::vector<std::string> names = explain::gate_names();
  parsed.rows.emplace_back();
  std::istringstream list(words + ",");
  for (std::string name; std::getline(list, name, ',');) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      const std::string hint = did_you_mean(name, names);
      const char* const allowed = "; 'each' and the names of `pose_wall explain --gates` are allowed";
      return {{}, fmt::format("'{}' is no gate{}", name, hint.empty() ? allowed : hint)};
    }
    const auto gate = static_cast<std::uint32_t>(found - names.begin());
    if (is_indispensable(gate)) return {{}, fmt::format("{} cannot go: the fit needs a plane", name)};
    parsed.rows.back().push_back(gate);
  }
  return parsed;
}

std::string names_of(const Gates& gates) {
  std::string names;
  for (const std::uint32_t gate : gates) {
    names += (names.empty() ? "" : ", ") + std::string(explain::gate_list()[gate].name);
  }
  return names;
}

std::string effects_of(const Gates& gates) {
  return gates.size() == 1 ? explain::effect_name(explain::gate_list()[gates.front()].effect) : "";
}

std::string worst_of(const std::map<std::string, std::size_t>& wrong_by_class) {
  std::string worst;
  std::size_t most = 0;
  for (const auto& [name, wrong] : wrong_by_class) {
    if (wrong > most) worst = name;
    most = std::max(most, wrong);
  }
  return worst;
}

// Measures the runs in which a gate failed; in all others its absence changes nothing.
AblationRow row_of(const Gates& gates, const std::vector<AblatedRun>& with_all, const Manifest& manifest,
                   const Crew& crew) {
  AblationRow row{gates, {}, ""};
  std::vector<Run> again;
  std::vector<const AblatedRun*> before;
  for (const AblatedRun& run : with_all) {
    std::size_t failed = 0;
    for (const std::uint32_t gate : gates) failed = std::max(failed, run.seen.at(gate));
    if (failed == 0) continue;
    row.worth.frames_failed += failed;
    again.push_back(run.record.run);
    before.push_back(&run);
  }
  row.worth.runs_failed = again.size();
  if (again.empty()) return row;
  const LimitsRestored afterwards;
  for (const std::uint32_t gate : gates) pose_wall_trace_let_pass(gate);
  const std::vector<AblatedRun> now = traced(manifest.engine, again, crew);
  std::map<std::string, std::size_t> wrong_by_class;
  for (std::size_t run = 0; run < now.size(); ++run) {
    const std::size_t wrong_before = row.worth.wrong_more();
    for (std::size_t i = 0; i < now[run].record.frames.size(); ++i) {
      row.worth.add(before[run]->record.frames[i], now[run].record.frames[i], manifest.limits);
    }
    wrong_by_class[again[run].scene + ", " + again[run].sensor] += row.worth.wrong_more() - wrong_before;
  }
  row.worst = worst_of(wrong_by_class);
  return row;
}

Json row_json(const AblationRow& row) {
  const GateWorth& w = row.worth;
  return {{"without", names_of(row.without)},
          {"effect", effects_of(row.without)},
          {"runs_failed", w.runs_failed},
          {"frames_failed", w.frames_failed},
          {"frames_changed", w.frames_changed},
          {"valid_gained", w.valid_gained},
          {"valid_lost", w.valid_lost},
          {"misleading_more", w.misleading_more},
          {"misleading_fewer", w.misleading_fewer},
          {"beyond_more", w.beyond_more},
          {"beyond_fewer", w.beyond_fewer},
          {"worst", row.worst}};
}

std::string command_of(const Ablation& ablation) {
  return fmt::format("{} --ablate {}", ablation.manifest.command(), ablation.words);
}

// "+3 -1", or "" where nothing changed.
std::string more_and_fewer(std::size_t more, std::size_t fewer) {
  std::string text = more > 0 ? fmt::format("+{}", more) : "";
  if (fewer > 0) text += fmt::format("{}-{}", more > 0 ? " " : "", fewer);
  return text;
}

}  // namespace

void GateWorth::add(const FrameRecord& with_all, const FrameRecord& without, const AlertLimits& limits) {
  if (same_outcome(with_all, without)) return;
  ++frames_changed;
  const auto count = [](bool now, bool before, std::size_t* more, std::size_t* fewer) {
    if (now && !before) ++*more;
    if (before && !now) ++*fewer;
  };
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const Judged before = judge(with_all, q, limits), now = judge(without, q, limits);
    const auto is_valid = [q](const FrameRecord& f) { return f.quantity[q].measured.state == POSE_WALL_VALID; };
    count(is_valid(without), is_valid(with_all), &valid_gained, &valid_lost);
    count(now.misleading, before.misleading, &misleading_more, &misleading_fewer);
    const auto is_beyond = [](const Judged& one) { return one.value_beyond_protection || one.raw_beyond_protection; };
    count(is_beyond(now), is_beyond(before), &beyond_more, &beyond_fewer);
  }
}

std::string ablation_fault(const std::string& words) {
  return parse_ablation(words).fault;
}

Ablation run_ablation(const std::string& words, const Manifest& manifest, const std::vector<Run>& runs,
                      const Crew& crew) {
  const AblationRequest parsed = parse_ablation(words);
  if (!parsed.fault.empty()) throw std::invalid_argument("--ablate: " + parsed.fault);
  Ablation ablation{manifest, words, frames_of(runs), {}};
  if (crew.tell_progress) fmt::print(stderr, "with all gates: {}\n", counted(runs.size(), "run"));
  const std::vector<AblatedRun> with_all = traced(manifest.engine, runs, crew);
  for (const Gates& gates : parsed.rows) {
    if (crew.tell_progress) {
      fmt::print(stderr, "without {} ({} of {})\n", names_of(gates), ablation.rows.size() + 1, parsed.rows.size());
    }
    ablation.rows.push_back(row_of(gates, with_all, manifest, crew));
  }
  return ablation;
}

std::string ablation_text(const Ablation& ablation) {
  TextTable table(
      {"without", "effect", "failed in frames", "frames changed", "valid", "misleading", "beyond level", "worst in"});
  for (const AblationRow& row : ablation.rows) {
    const GateWorth& w = row.worth;
    table.add_row({names_of(row.without), effects_of(row.without), std::to_string(w.frames_failed),
                   std::to_string(w.frames_changed), more_and_fewer(w.valid_gained, w.valid_lost),
                   more_and_fewer(w.misleading_more, w.misleading_fewer), more_and_fewer(w.beyond_more, w.beyond_fewer),
                   row.worst});
  }
  return fmt::format("{}\n{}; a row without gates that let everything pass\n\n{}", command_of(ablation),
                     counted(ablation.frames, "frame"), table.text(2));
}

std::string ablation_json(const Ablation& ablation) {
  Json rows = Json::array();
  for (const AblationRow& row : ablation.rows) rows.push_back(row_json(row));
  return json_text({{"command", command_of(ablation)},
                    {"version", pose_wall_version()},
                    {"frames", ablation.frames},
                    {"rows", rows}},
                   2) +
         "\n";
}

}  // namespace pose_wall::tools::campaign

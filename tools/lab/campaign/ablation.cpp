// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/ablation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/json/json_words.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/campaign/card_words.hpp"
#include "lab/campaign/traced_runs.hpp"
#include "study/explain/gate_list.hpp"

namespace pose_wall::tools::campaign {
namespace {

using AblatedRun = TracedRun<GateFailures>;

std::vector<AblatedRun> traced(const EngineChoice& choice, const std::vector<Run>& runs, const Crew& crew) {
  return traced_runs<GateFailures>(choice, runs, crew,
                                   [](const pose_wall_trace& trace, GateFailures* failed) { failed->add(trace); });
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
    const std::size_t failed = run.seen.most_of(gates);
    if (failed == 0) continue;
    row.worth.frames_failed += failed;
    again.push_back(run.record.run);
    before.push_back(&run);
  }
  row.worth.runs_failed = again.size();
  if (again.empty()) return row;
  const LimitsRestored afterwards;
  leave_out(gates);
  const std::vector<AblatedRun> now = traced(manifest.engine, again, crew);
  std::map<std::string, std::size_t> wrong_by_class;
  for (std::size_t run = 0; run < now.size(); ++run) {
    const std::size_t wrong_before = row.worth.values.wrong_more();
    for (std::size_t i = 0; i < now[run].record.frames.size(); ++i) {
      row.worth.add(before[run]->record.frames[i], now[run].record.frames[i], manifest.limits);
    }
    wrong_by_class[again[run].scene + ", " + again[run].sensor] += row.worth.values.wrong_more() - wrong_before;
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
          {"valid_gained", w.values.valid.more},
          {"valid_lost", w.values.valid.fewer},
          {"misleading_more", w.values.misleading.more},
          {"misleading_fewer", w.values.misleading.fewer},
          {"beyond_more", w.values.beyond.more},
          {"beyond_fewer", w.values.beyond.fewer},
          {"worst", row.worst}};
}

std::string command_of(const Ablation& ablation) {
  return fmt::format("{} --ablate {}", ablation.manifest.command(), ablation.words);
}

// "+3 -1", or "" where nothing changed.
std::string change_text(const MoreAndFewer& values) {
  std::string text = values.more > 0 ? fmt::format("+{}", values.more) : "";
  if (values.fewer > 0) text += fmt::format("{}-{}", values.more > 0 ? " " : "", values.fewer);
  return text;
}

Standing standing_of(const FrameRecord& frame, std::size_t quantity, const AlertLimits& limits) {
  const Judged judged = judge(frame, quantity, limits);
  return {frame.quantity[quantity].measured.state == POSE_WALL_VALID, judged.misleading,
          judged.value_beyond_protection || judged.raw_beyond_protection};
}

}  // namespace

void GateWorth::add(const FrameRecord& with_all, const FrameRecord& without, const AlertLimits& limits) {
  if (same_outcome(with_all, without)) return;
  ++frames_changed;
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    values.add(standing_of(with_all, q, limits), standing_of(without, q, limits));
  }
}

Ablation run_ablation(const std::string& words, const Manifest& manifest, const std::vector<Run>& runs,
                      const Crew& crew) {
  const GateRows parsed = gate_rows(words);
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
                   std::to_string(w.frames_changed), change_text(w.values.valid), change_text(w.values.misleading),
                   change_text(w.values.beyond), row.worst});
  }
  return fmt::format("{}\n{}; a row without gates that let everything pass\n{}\n\n{}", command_of(ablation),
                     counted(ablation.frames, "frame"), movement_text(ablation.manifest), table.text(2));
}

std::string ablation_json(const Ablation& ablation) {
  Json rows = Json::array();
  for (const AblationRow& row : ablation.rows) rows.push_back(row_json(row));
  return json_text({{"command", command_of(ablation)},
                    {"version", pose_wall_version()},
                    {"motion", "off"},
                    {"scans", scans_name(ablation.manifest.plan.scans)},
                    {"frames", ablation.frames},
                    {"rows", rows}},
                   2) +
         "\n";
}

}  // namespace pose_wall::tools::campaign

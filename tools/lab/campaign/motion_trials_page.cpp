// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/campaign/card_words.hpp"
#include "lab/campaign/motion_trials.hpp"

namespace pose_wall::tools::campaign {
namespace {

double share(const MotionTrialRow& row, std::uint32_t state) {
  return row.judged > 0 ? static_cast<double>(row.states[state]) / static_cast<double>(row.judged) : std::nan("");
}

// The command that prints the table again.
std::string command_of(const MotionTrials& trials) {
  return fmt::format("{} --{} {}", trials.manifest.command(), trials.request.is_sweep ? "sweep" : "ablate",
                     trials.request.words);
}

std::string head_of(const MotionTrials& trials) {
  const std::string frames = fmt::format("{}\n{}\n\n", command_of(trials), counted(trials.frames, "frame"));
  if (!trials.request.is_sweep) return frames;
  const pose_wall_motion_trace_info gate = motion_gate(trials.request.trials.front().gates.front());
  return fmt::format("{}: {}\n{}, in {}; from: {}\n{}", gate.name, gate.asks, gate.sense, gate.unit, gate.origin,
                     frames);
}

std::string name_of(const MotionTrials& trials, const MotionTrialRow& row) {
  if (!trials.request.is_sweep) return row.trial.gates.empty() ? "none" : motion_gate_names(row.trial.gates);
  if (!std::isnan(row.trial.limit)) return fmt::format("{:.6g}", row.trial.limit);
  return fmt::format("table: {}", motion_gate(row.trial.gates.front()).limit);
}

// What is not a number becomes null.
Json row_json(const MotionTrials& trials, const MotionTrialRow& row) {
  return {{trials.request.is_sweep ? "limit" : "without",
           trials.request.is_sweep ? Json(row.trial.limit) : Json(motion_gate_names(row.trial.gates))},
          {"frames", row.judged},
          {"measured", share(row, POSE_WALL_ALONG_MEASURED)},
          {"ambiguous", share(row, POSE_WALL_ALONG_AMBIGUOUS)},
          {"unobservable", share(row, POSE_WALL_ALONG_UNOBSERVABLE)},
          {"lost", share(row, POSE_WALL_ALONG_LOST)},
          {"misleading_poses", row.poses.misleading},
          {"misleading_steps", row.steps.misleading},
          {"step_along_rmse_m", row.along_step.rmse()},
          {"frames_changed", row.frames_changed},
          {"gate", {{"asked", row.asked}, {"not_passed", row.failed}}}};
}

}  // namespace

std::string motion_trials_text(const MotionTrials& trials) {
  TextTable table({trials.request.is_sweep ? "limit" : "without", "frames", "measured", "ambiguous", "unobservable",
                   "lost", "misleading poses", "steps", "step along, rmse", "gate did not pass", "frames changed"});
  for (const MotionTrialRow& row : trials.rows) {
    table.add_row({name_of(trials, row), std::to_string(row.judged), percent(share(row, POSE_WALL_ALONG_MEASURED)),
                   percent(share(row, POSE_WALL_ALONG_AMBIGUOUS)), percent(share(row, POSE_WALL_ALONG_UNOBSERVABLE)),
                   percent(share(row, POSE_WALL_ALONG_LOST)), std::to_string(row.poses.misleading),
                   std::to_string(row.steps.misleading), fmt::format("{:.1f} mm", 1e3 * row.along_step.rmse()),
                   row.trial.gates.empty() ? "" : fmt::format("{} of {}", row.failed, row.asked),
                   std::to_string(row.frames_changed)});
  }
  return head_of(trials) + table.text();
}

std::string motion_trials_json(const MotionTrials& trials) {
  Json rows = Json::array();
  for (const MotionTrialRow& row : trials.rows) rows.push_back(row_json(trials, row));
  Json page = {
      {"command", command_of(trials)}, {"version", pose_wall_version()}, {"motion", "measured"}, {"rows", rows}};
  if (trials.request.is_sweep) {
    const pose_wall_motion_trace_info gate = motion_gate(trials.request.trials.front().gates.front());
    page["gate"] = gate.name;
    page["sense"] = gate.sense;
    page["unit"] = gate.unit;
    page["table_limit"] = gate.limit;
    page["asks"] = gate.asks;
    page["origin"] = gate.origin;
  }
  return json_text(page, 2) + "\n";
}

}  // namespace pose_wall::tools::campaign

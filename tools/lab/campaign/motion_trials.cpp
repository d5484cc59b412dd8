// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/motion_trials.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "io/csv/csv_table.hpp"
#include "io/terminal/counted.hpp"
#include "lab/campaign/limit_words.hpp"
#include "lab/campaign/motion_record.hpp"
#include "lab/campaign/runner.hpp"
#include "study/explain/traced_frame.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::quiet_NaN();

std::optional<std::uint32_t> find_motion_gate(const std::string& name) {
  for (std::uint32_t gate = 0; gate < POSE_WALL_MOTION_TRACE_GATES; ++gate) {
    if (name == motion_gate(gate).name) return gate;
  }
  return std::nullopt;
}

std::string no_motion_gate(const std::string& name) {
  std::vector<std::uint32_t> all(POSE_WALL_MOTION_TRACE_GATES);
  std::iota(all.begin(), all.end(), 0U);
  return fmt::format("'{}' is no gate of the motion library; these are: {}", name, motion_gate_names(all));
}

// NaN for what is no number that a limit may be.
double limit_in(const std::string& word) {
  const double limit = number_in(word);
  constexpr double kMost = 1e9;  // as pose_wall_motion_trace_set_limit takes
  return limit >= 0.0 && limit <= kMost ? limit : kNoLimit;
}

void set(const MotionTrial& trial) {
  for (const std::uint32_t gate : trial.gates) {
    const std::int32_t status = std::isnan(trial.limit) ? pose_wall_motion_trace_let_pass(gate)
                                                        : pose_wall_motion_trace_set_limit(gate, trial.limit);
    if (status != POSE_WALL_OK) throw std::invalid_argument(pose_wall_status_text(status));
  }
}

struct TrialRun {
  CsvTable table;
  pose_wall_motion_trace sum{};  // over its frames

  std::size_t failed(const std::vector<std::uint32_t>& gates) const {
    std::size_t all = 0;
    for (const std::uint32_t gate : gates) all += sum.failed[gate];
    return all;
  }
};

void add(const pose_wall_motion_trace& frame, pose_wall_motion_trace* sum) {
  for (std::uint32_t gate = 0; gate < POSE_WALL_MOTION_TRACE_GATES; ++gate) {
    sum->asked[gate] += frame.asked[gate];
    sum->failed[gate] += frame.failed[gate];
  }
}

std::vector<TrialRun> count_gates(const EngineChoice& choice, const std::vector<Run>& runs, const Crew& crew) {
  std::vector<TrialRun> done(runs.size());
  work_on(runs, crew, [&]() -> RunWork {
    return [&](const Run& run, const std::function<void()>& on_frame) {
      TrialRun& out = done.at(static_cast<std::size_t>(&run - runs.data()));
      const MotionLibrary library = {
          pose_wall_motion_trace_open,
          [&out](pose_wall_motion* motion, const pose_wall_cloud* cloud, pose_wall_motion_result* result) {
            pose_wall_motion_trace frame{};
            const std::int32_t status = pose_wall_motion_trace_frame(motion, cloud, result, &frame);
            add(frame, &out.sum);
            return status;
          }};
      std::istringstream table(measure_motion(run, choice, library, on_frame));
      out.table = CsvTable::parse(table);
    };
  });
  return done;
}

std::size_t rows_changed(const CsvTable& before, const CsvTable& now) {
  const std::size_t time = before.find_column("total_ms").value_or(before.head().size());
  std::size_t changed = 0;
  for (std::size_t row = 0; row < now.rows(); ++row) {
    bool differs = false;
    for (std::size_t column = 0; column < now.head().size(); ++column) {
      differs = differs || (column != time && before.cell(row, column) != now.cell(row, column));
    }
    changed += differs ? 1 : 0;
  }
  return changed;
}

MotionTrialRow row_of(const MotionTrial& trial, const std::vector<TrialRun>& with_table,
                      const std::vector<TrialRun>& now, const Manifest& manifest) {
  MotionTrialRow row;
  row.trial = trial;
  MotionCard card{manifest, 0, {}, {}};
  for (std::size_t run = 0; run < now.size(); ++run) {
    card.add(motion_record_of(now[run].table));
    row.frames_changed += rows_changed(with_table[run].table, now[run].table);
    for (const std::uint32_t gate : trial.gates) row.asked += now[run].sum.asked[gate];
    row.failed += now[run].failed(trial.gates);
  }
  for (const MotionClassCard& one : card.classes) {
    row.judged += one.judged;
    for (std::size_t state = 0; state < row.states.size(); ++state) row.states[state] += one.states[state];
    row.poses.merge(one.poses);
    row.steps.merge(one.steps);
    row.along_step.merge(one.step[POSE_WALL_MOTION_ALONG]);
  }
  return row;
}

// Measures the runs that the trial can change. Where a gate never failed, its absence changes nothing.
std::vector<TrialRun> measure(const MotionTrial& trial, const std::vector<TrialRun>& with_table,
                              const Manifest& manifest, const std::vector<Run>& runs, const Crew& crew) {
  std::vector<Run> again;
  std::vector<std::size_t> which;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (std::isnan(trial.limit) && with_table[run].failed(trial.gates) == 0) continue;
    again.push_back(runs[run]);
    which.push_back(run);
  }
  const LimitsRestoredBy<pose_wall_motion_trace_forget_limits> afterwards;
  set(trial);
  std::vector<TrialRun> measured = count_gates(manifest.engine, again, crew), all = with_table;
  for (std::size_t k = 0; k < which.size(); ++k) all[which[k]] = std::move(measured[k]);
  return all;
}

}  // namespace

pose_wall_motion_trace_info motion_gate(std::uint32_t gate) {
  pose_wall_motion_trace_info info{};
  if (pose_wall_motion_trace_gate_info(gate, &info) != POSE_WALL_OK) throw std::out_of_range("no such gate of motion");
  return info;
}

std::string motion_gate_names(const std::vector<std::uint32_t>& gates) {
  std::string names;
  for (const std::uint32_t gate : gates) names += (names.empty() ? "" : ", ") + std::string(motion_gate(gate).name);
  return names;
}

MotionTrialRequest motion_sweep(const std::string& words) {
  const std::size_t end = words.find('=');
  const std::string name = words.substr(0, end);
  MotionTrialRequest request{true, words, {}, ""};
  const std::optional<std::uint32_t> gate = find_motion_gate(name);
  if (!gate) return {true, words, {}, no_motion_gate(name)};
  if (end == std::string::npos)
    return {true, words, {}, fmt::format("'{}' has no limits; GATE=A,B,... is asked for", words)};
  for (const std::string& word : words_between_commas(words.substr(end + 1))) {
    const double limit = limit_in(word);
    if (std::isnan(limit)) {
      request.fault = fmt::format("{}: '{}' is refused; numbers from 0 to 1e9 in {}, separated by commas, are allowed",
                                  name, word, motion_gate(*gate).unit);
      return request;
    }
    request.trials.push_back({{*gate}, limit});
  }
  return request;
}

MotionTrialRequest motion_ablation(const std::string& words) {
  MotionTrialRequest request{false, words, {}, ""};
  if (words == "each") {
    for (std::uint32_t gate = 0; gate < POSE_WALL_MOTION_TRACE_GATES; ++gate)
      request.trials.push_back({{gate}, kNoLimit});
    return request;
  }
  MotionTrial together{{}, kNoLimit};
  for (const std::string& name : words_between_commas(words)) {
    const std::optional<std::uint32_t> gate = find_motion_gate(name);
    if (!gate) return {false, words, {}, no_motion_gate(name)};
    together.gates.push_back(*gate);
  }
  request.trials.push_back(together);
  return request;
}

MotionTrials run_motion_trials(const MotionTrialRequest& request, const Manifest& manifest,
                               const std::vector<Run>& runs, const Crew& crew) {
  if (!request.fault.empty()) throw std::invalid_argument(request.fault);
  MotionTrials trials{request, manifest, frames_of(runs), {}};
  if (crew.tell_progress) fmt::print(stderr, "with the table: {}\n", counted(runs.size(), "run"));
  const std::vector<TrialRun> with_table = count_gates(manifest.engine, runs, crew);
  const MotionTrial none{request.is_sweep ? request.trials.front().gates : std::vector<std::uint32_t>{}, kNoLimit};
  trials.rows.push_back(row_of(none, with_table, with_table, manifest));
  for (const MotionTrial& trial : request.trials) {
    if (crew.tell_progress) {
      fmt::print(stderr, "{} ({} of {})\n", motion_gate_names(trial.gates), trials.rows.size(), request.trials.size());
    }
    trials.rows.push_back(row_of(trial, with_table, measure(trial, with_table, manifest, runs, crew), manifest));
  }
  return trials;
}

}  // namespace pose_wall::tools::campaign

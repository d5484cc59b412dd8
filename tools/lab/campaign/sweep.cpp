// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/sweep.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "io/terminal/counted.hpp"
#include "lab/campaign/limit_words.hpp"
#include "lab/campaign/traced_runs.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/notes.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The fit takes a plane as given: with none let pass it would have nothing to begin with.
constexpr double kFewestFloorPlanes = 1.0;

bool is_floor_planes(const pose_wall_trace_info& gate) {
  return &gate == &explain::gate_list()[POSE_WALL_TRACE_FLOOR_PLANES];
}

std::string allowed_limits(const pose_wall_trace_info& gate) {
  if (gate.sense == POSE_WALL_TRACE_IS_SO) return "0 (it lets everything pass) and 1 (as in the table) are allowed";
  if (is_floor_planes(gate)) return "numbers from 1, separated by commas, are allowed: the fit needs a plane";
  const std::string unit = gate.unit;
  return fmt::format("numbers{}{}, separated by commas, are allowed", unit.empty() ? "" : " in ", unit);
}

bool is_allowed(const pose_wall_trace_info& gate, double limit) {
  if (gate.sense == POSE_WALL_TRACE_IS_SO) return limit == 0.0 || limit == 1.0;
  return std::isfinite(limit) && (!is_floor_planes(gate) || limit >= kFewestFloorPlanes);
}

struct Parsed {
  SweepRequest request;
  std::string fault;
};

Parsed parse(const std::string& words) {
  Parsed parsed;
  const std::size_t end = words.find('=');
  const std::string name = words.substr(0, end);
  const std::optional<std::uint32_t> found = explain::find_gate(name);
  if (!found) return {{}, explain::no_gate_text(name, "; `pose_wall explain --gates` lists them")};
  parsed.request.gate = *found;
  const pose_wall_trace_info& gate = explain::gate_list()[parsed.request.gate];
  std::istringstream limits(end == std::string::npos ? "" : words.substr(end + 1) + ",");
  for (std::string word; std::getline(limits, word, ',');) {
    const double limit = number_in(word);
    if (!is_allowed(gate, limit)) {
      parsed.fault = fmt::format("{}: '{}' is refused; {}", name, word, allowed_limits(gate));
      return parsed;
    }
    parsed.request.limits.push_back(limit);
  }
  if (parsed.request.limits.empty()) {
    parsed.fault = fmt::format("'{}' has no limits; GATE=A,B,... is asked for: {}", words, allowed_limits(gate));
  }
  return parsed;
}

std::size_t frames_changed(const std::vector<RunRecord>& of_table, const std::vector<RunRecord>& now) {
  std::size_t changed = 0;
  for (std::size_t run = 0; run < now.size(); ++run) {
    for (std::size_t i = 0; i < now[run].frames.size(); ++i) {
      if (!same_outcome(of_table[run].frames[i], now[run].frames[i])) ++changed;
    }
  }
  return changed;
}

// `of_table`: the records of the first row, which fills them in.
SweepRow measure_row(std::uint32_t gate, double limit, const Manifest& manifest, const std::vector<Run>& runs,
                     const Crew& crew, std::vector<RunRecord>* of_table) {
  const LimitsRestored afterwards;
  if (!std::isnan(limit)) pose_wall_trace_set_limit(gate, limit);
  std::vector<TracedRun<GateCounts>> swept = traced_runs<GateCounts>(
      manifest.engine, runs, crew, [gate](const pose_wall_trace& trace, GateCounts* seen) { seen->add(trace, gate); });
  SweepRow row{std::isnan(limit), limit, {}, {}, 0};
  std::vector<RunRecord> records;
  for (TracedRun<GateCounts>& one : swept) {
    records.push_back(std::move(one.record));
    row.gate.merge(one.seen);
  }
  row.judged = make_card(manifest, records, 0).judged;
  if (row.is_of_table) *of_table = records;
  row.frames_changed = frames_changed(*of_table, records);
  return row;
}

}  // namespace

std::string sweep_fault(const std::string& words) {
  return parse(words).fault;
}

SweepRequest parse_sweep(const std::string& words) {
  Parsed parsed = parse(words);
  if (!parsed.fault.empty()) throw std::invalid_argument("--sweep: " + parsed.fault);
  return parsed.request;
}

GateCounts::GateCounts() : limit_least(kNaN), limit_most(kNaN) {}

void GateCounts::add(const pose_wall_trace& trace, std::uint32_t of_gate) {
  notes_dropped += trace.dropped;
  for (const explain::Note& note : explain::Notes(trace).all()) {
    if (note.gate.gate != of_gate) continue;
    ++asked;
    if (!note.passed()) ++not_passed;
    limit_least = std::fmin(limit_least, note.gate.limit);
    limit_most = std::fmax(limit_most, note.gate.limit);
  }
}

void GateCounts::merge(const GateCounts& other) {
  asked += other.asked;
  not_passed += other.not_passed;
  notes_dropped += other.notes_dropped;
  limit_least = std::fmin(limit_least, other.limit_least);
  limit_most = std::fmax(limit_most, other.limit_most);
}

Sweep run_sweep(const SweepRequest& request, const Manifest& manifest, const std::vector<Run>& runs, const Crew& crew) {
  Sweep sweep{request, manifest, {}};
  std::vector<RunRecord> of_table;
  std::vector<double> limits = {kNaN};
  limits.insert(limits.end(), request.limits.begin(), request.limits.end());
  for (const double limit : limits) {
    if (crew.tell_progress) {
      fmt::print(stderr, "{}: {} ({} of {}), {}\n", explain::gate_list()[request.gate].name,
                 std::isnan(limit) ? "the table's limit" : fmt::format("limit {:g}", limit), sweep.rows.size() + 1,
                 limits.size(), counted(runs.size(), "run"));
    }
    sweep.rows.push_back(measure_row(request.gate, limit, manifest, runs, crew, &of_table));
  }
  return sweep;
}

}  // namespace pose_wall::tools::campaign

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"
#include "io/numbers/angles.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/campaign/card_words.hpp"
#include "lab/campaign/sweep.hpp"
#include "study/explain/gate_list.hpp"

namespace pose_wall::tools::campaign {
namespace {

const pose_wall_trace_info& gate_of(const Sweep& sweep) {
  return explain::gate_list()[sweep.request.gate];
}

SevenStatistics angles(const Totals& judged) {
  return {judged.quantities.begin(), judged.quantities.begin() + POSE_WALL_D_LF};
}

SevenStatistics distances(const Totals& judged) {
  return {judged.quantities.begin() + POSE_WALL_D_LF, judged.quantities.end()};
}

// The command that prints the table again.
std::string command_of(const Sweep& sweep) {
  std::string limits;
  for (const double limit : sweep.request.limits) limits += fmt::format("{}{}", limits.empty() ? "" : ",", limit);
  return fmt::format("{} --sweep {}={}", sweep.manifest.command(), gate_of(sweep).name, limits);
}

std::string limit_text(const pose_wall_trace_info& gate, double limit) {
  const bool is_angle = std::string(gate.unit) == "rad";
  return is_angle ? fmt::format("{:.4g} ({:.3g}°)", limit, limit * kDegPerRad) : fmt::format("{:.6g}", limit);
}

// What the table's limit came to; scenes and sensors may ask for another one each.
std::string limit_of_table(const pose_wall_trace_info& gate, const GateCounts& counts) {
  if (counts.asked == 0) return "table";
  const std::string least = limit_text(gate, counts.limit_least), most = limit_text(gate, counts.limit_most);
  return least == most ? "table: " + least : fmt::format("table: {} to {}", least, most);
}

std::string head_of(const Sweep& sweep) {
  const pose_wall_trace_info& gate = gate_of(sweep);
  const std::string key = *gate.key != '\0' ? fmt::format("; key {}", gate.key) : "";
  return fmt::format("{}: {}\n{}{}{}; {} where it does not hold{}; from: {}\n{}\n{}\n\n", gate.name, gate.asks,
                     explain::sense_name(gate.sense), *gate.unit != '\0' ? ", in " : "", gate.unit,
                     explain::effect_name(gate.effect), key, gate.origin, command_of(sweep),
                     movement_text(sweep.manifest));
}

std::string foot_of(const Sweep& sweep) {
  std::string text;
  std::size_t dropped = 0;
  for (const SweepRow& row : sweep.rows) dropped += row.gate.notes_dropped;
  if (dropped > 0) {
    text += fmt::format("\n{} found no room: the gate was asked more often than is told.\n", counted(dropped, "note"));
  }
  if (sweep.rows.front().judged.frames.frames == 0) {
    text += "\nNothing to judge: in classes that are unobservable nobody can tell that anything is wrong.\n";
  }
  return text;
}

// What is not a number becomes null: the limit of the table's row, shares of nothing.
Json row_json(const SweepRow& row) {
  const FrameCounts& f = row.judged.frames;
  return {{"limit", row.limit},
          {"frames", f.frames},
          {"valid_angles", state_shares(angles(row.judged)).valid},
          {"valid_distances", state_shares(distances(row.judged)).valid},
          {"degraded", state_shares(row.judged.quantities).degraded},
          {"misleading", f.misleading},
          {"value_beyond_protection", f.value_beyond_protection},
          {"raw_beyond_protection", f.raw_beyond_protection},
          {"frames_changed", row.frames_changed},
          {"gate",
           {{"asked", row.gate.asked},
            {"not_passed", row.gate.not_passed},
            {"limit_least", row.gate.limit_least},
            {"limit_most", row.gate.limit_most},
            {"notes_dropped", row.gate.notes_dropped}}}};
}

}  // namespace

std::string sweep_text(const Sweep& sweep) {
  TextTable table({"limit", "frames", "valid: angles", "distances", "degraded", "misleading", "value > protection",
                   "raw > protection", "gate did not pass", "frames changed"});
  for (const SweepRow& row : sweep.rows) {
    const Totals& judged = row.judged;
    const FrameCounts& f = judged.frames;
    table.add_row({row.is_of_table ? limit_of_table(gate_of(sweep), row.gate) : limit_text(gate_of(sweep), row.limit),
                   std::to_string(f.frames), percent(state_shares(angles(judged)).valid),
                   percent(state_shares(distances(judged)).valid), percent(state_shares(judged.quantities).degraded),
                   count_with_bound(f.misleading, f.frames), count_with_bound(f.value_beyond_protection, f.frames),
                   count_with_bound(f.raw_beyond_protection, f.frames),
                   fmt::format("{} of {}", row.gate.not_passed, row.gate.asked), std::to_string(row.frames_changed)});
  }
  return head_of(sweep) + table.text() + foot_of(sweep);
}

std::string sweep_json(const Sweep& sweep) {
  const pose_wall_trace_info& gate = gate_of(sweep);
  Json rows = Json::array();
  for (const SweepRow& row : sweep.rows) rows.push_back(row_json(row));
  return json_text(
             {{"command", command_of(sweep)},
              {"version", pose_wall_version()},
              {"motion", "off"},
              {"scans", scans_name(sweep.manifest.plan.scans)},
              {"gate", gate.name},
              {"asks", gate.asks},
              {"sense", explain::sense_name(gate.sense)},
              {"unit", gate.unit},
              {"key", gate.key},
              {"effect", explain::effect_name(gate.effect)},
              {"table_limit", gate.limit},
              {"origin", gate.origin},
              {"alert_limits",
               {{"angle_rad", sweep.manifest.limits.angle_rad}, {"distance_m", sweep.manifest.limits.distance_m}}},
              {"rows", rows}},
             2) +
         "\n";
}

}  // namespace pose_wall::tools::campaign

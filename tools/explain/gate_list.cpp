// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "explain/gate_list.hpp"

#include <fmt/format.h>

#include "terminal/text_table.hpp"

namespace pose_wall::tools::explain {
namespace {

std::vector<pose_wall_trace_info> read_table() {
  std::vector<pose_wall_trace_info> gates(POSE_WALL_TRACE_GATES);
  for (std::uint32_t i = 0; i < gates.size(); ++i) pose_wall_trace_gate_info(i, &gates[i]);
  return gates;
}

// Settings stand in the table as members of s, which says nothing to a reader of keys.
std::string without_settings_prefix(const std::string& limit) {
  std::string out;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const bool begins_word = i == 0 || limit[i - 1] == ' ' || limit[i - 1] == '(';
    if (begins_word && limit.compare(i, 2, "s.") == 0) {
      ++i;
    } else {
      out += limit[i];
    }
  }
  return out;
}

std::string limit_words(const pose_wall_trace_info& gate) {
  if (gate.sense == POSE_WALL_TRACE_IS_SO) return sense_name(gate.sense);
  const std::string limit = gate.limit;
  return fmt::format("{} {}", sense_name(gate.sense),
                     limit == "BY_CALLER" ? "what the frame allows" : without_settings_prefix(limit));
}

}  // namespace

const std::vector<pose_wall_trace_info>& gate_list() {
  static const std::vector<pose_wall_trace_info> gates = read_table();
  return gates;
}

std::vector<std::string> gate_names() {
  std::vector<std::string> names;
  for (const pose_wall_trace_info& gate : gate_list()) names.emplace_back(gate.name);
  return names;
}

const char* sense_name(std::uint32_t sense) {
  switch (sense) {
    case POSE_WALL_TRACE_AT_LEAST:
      return "at least";
    case POSE_WALL_TRACE_AT_MOST:
      return "at most";
    case POSE_WALL_TRACE_BELOW:
      return "below";
    default:
      return "is so";
  }
}

const char* effect_name(std::uint32_t effect) {
  switch (effect) {
    case POSE_WALL_TRACE_REFUSES:
      return "refuses";
    case POSE_WALL_TRACE_DOUBTS:
      return "doubts";
    default:
      return "tells";
  }
}

std::string gate_list_text() {
  TextTable table({"gate", "limit", "unit", "key", "effect", "what it asks (where the limit is from)"});
  for (const pose_wall_trace_info& gate : gate_list()) {
    table.add_row({gate.name, limit_words(gate), gate.unit, gate.key, effect_name(gate.effect),
                   fmt::format("{} ({})", gate.asks, gate.origin)});
  }
  return table.text(6);
}

}  // namespace pose_wall::tools::explain

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/gate_list.hpp"

#include <fmt/format.h>

#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "io/terminal/text_table.hpp"
#include "study/explain/gate_list_texts.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

std::vector<pose_wall_trace_info> read_table() {
  std::vector<pose_wall_trace_info> gates(POSE_WALL_TRACE_GATES);
  for (std::uint32_t i = 0; i < gates.size(); ++i) pose_wall_trace_gate_info(i, &gates[i]);
  return gates;
}

// The table writes settings as members of s; a reader knows them as keys.
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
  // Marked here for sense_name.
  constexpr const char* kSenses[] = {translatable("at least"), translatable("at most"), translatable("is so"),
                                     translatable("below")};
  const std::string sense = tr(kSenses[gate.sense]), limit = gate.limit;
  if (gate.sense == POSE_WALL_TRACE_IS_SO) return sense;
  return fmt::format("{} {}", sense,
                     limit == "BY_CALLER" ? tr("what the frame allows") : without_settings_prefix(limit));
}

// The whole origin in English; in Chinese its head: "swept, 2026-11".
std::string origin_words(const std::string& origin) {
  if (language() == Language::kEnglish) return origin;
  constexpr const char* kDivider = ", ";
  const std::string head = origin.substr(0, origin.find(':'));
  std::vector<std::string> parts;
  for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 2) {
    end = head.find(kDivider, at);
    parts.emplace_back(tr(head.substr(at, end == std::string::npos ? end : end - at).c_str()));
  }
  return in_a_row(parts);
}

}  // namespace

const std::vector<pose_wall_trace_info>& gate_list() {
  static const std::vector<pose_wall_trace_info> gates = read_table();
  return gates;
}

std::optional<std::uint32_t> find_gate(const std::string& name) {
  for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES; ++gate) {
    if (name == gate_list()[gate].name) return gate;
  }
  return std::nullopt;
}

std::string no_gate_text(const std::string& name, const char* otherwise) {
  std::vector<std::string> names;
  for (const pose_wall_trace_info& gate : gate_list()) names.emplace_back(gate.name);
  const std::string hint = did_you_mean(name, names);
  return fmt::format("'{}' is no gate{}", name, hint.empty() ? otherwise : hint);
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
  constexpr const char* kEffects[] = {translatable("tells"), translatable("doubts"), translatable("refuses")};
  TextTable table(
      {tr("gate"), tr("limit"), tr("unit"), tr("key"), tr("effect"), tr("what is measured (where the limit is from)")});
  for (const pose_wall_trace_info& gate : gate_list()) {
    table.add_row({gate.name, limit_words(gate), tr(gate.unit), gate.key, tr(kEffects[gate.effect]),
                   say("{} ({})", tr(gate.asks), origin_words(gate.origin))});
  }
  std::string text = table.text(6);
  text +=
      fmt::format("{}\n", tr("refuses: nothing is measured by it. doubts: the protection level grows, or the value is "
                             "degraded. tells: a note."));
  if (language() != Language::kEnglish) {
    text += fmt::format("{}\n", tr("The full grounds of each limit are in English: --language en."));
  }
  return text;
}

}  // namespace pose_wall::tools::explain

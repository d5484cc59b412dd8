// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/gate_words.hpp"

#include <fmt/format.h>

#include "study/explain/amounts.hpp"
#include "study/remedies/gate_table.hpp"

namespace pose_wall::tools::explain {
namespace {

std::string filled(const char* words, const Note& note) {
  if (*words == '\0') return "";
  return fmt::format(fmt::runtime(tr(words)), fmt::arg("value", value_text(note)), fmt::arg("limit", limit_text(note)),
                     fmt::arg("key", key_of(note)));
}

}  // namespace

std::string sentence_of(const Note& note) {
  const GateWords* words = find_gate_words(note.info.name);
  return words != nullptr ? filled(words->failed, note) : "";
}

std::string help_of(const Note& note) {
  const GateWords* words = find_gate_words(note.info.name);
  return words != nullptr ? filled(words->help, note) : "";
}

}  // namespace pose_wall::tools::explain

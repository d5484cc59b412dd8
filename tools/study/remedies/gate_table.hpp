// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Sentences of the gates, by name. Those of frame, floor and outcome stand in frame_gate_words.cpp, those of walls in
// wall_gate_words.cpp.

#pragma once

#include <cstddef>
#include <cstring>
#include <initializer_list>

#include "io/language/language.hpp"

namespace pose_wall::tools::explain {

// In English; {value}, {limit} and {key} are filled in.
struct GateWords {
  const char* gate;
  const char* failed;
  const char* help;  // clauses, divided by "; "; empty where nothing is to be done
};

struct GateTable {
  const GateWords* rows;
  std::size_t count;
};

// Null where no table has the gate.
inline const GateWords* find_gate(const char* gate, std::initializer_list<GateTable> tables) {
  for (const GateTable& table : tables) {
    for (std::size_t i = 0; i < table.count; ++i) {
      if (std::strcmp(table.rows[i].gate, gate) == 0) return &table.rows[i];
    }
  }
  return nullptr;
}

const GateWords* find_frame_gate(const char* gate);
const GateWords* find_wall_gate(const char* gate);
inline const GateWords* find_gate_words(const char* gate) {
  const GateWords* words = find_frame_gate(gate);
  return words != nullptr ? words : find_wall_gate(gate);
}

}  // namespace pose_wall::tools::explain

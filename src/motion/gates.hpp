// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The motion library's table of gates is gates.def. Rules use them by name: base/gates/gate.hpp says how.

#pragma once

#include <cstdint>

#include "base/gates/gate.hpp"
#include "motion/trace.hpp"

namespace pose_wall {
namespace motion::gate {

enum Id : std::uint32_t {
#define GATE(id, ...) id,
#include "motion/gates.def"
#undef GATE
  kCount
};

}  // namespace motion::gate

// The rows as types. The caller knows the limit of none of them.
#define GATE(id, name, sense_, limit_, ...)                                 \
  template <>                                                               \
  struct GateRow<motion::gate::id> {                                        \
    static constexpr GateSense sense = GateSense::sense_;                   \
    static constexpr bool by_caller = false; /* each limit is in its row */ \
    static constexpr auto limit() { return limit_; }                        \
  };
#include "motion/gates.def"
#undef GATE

#ifdef POSE_WALL_TRACE
template <>
struct GateNotes<motion::gate::Id> {
  static double limit_or(motion::gate::Id id, double of_table) { return motion::trace::limit_or(id, of_table); }
  static bool lets_pass(motion::gate::Id id) { return motion::trace::lets_pass(id); }
  static void note(motion::gate::Id id, double, double, bool passed) { motion::trace::note_gate(id, passed); }
};
#endif

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The motion library's table of gates is gates.def. Rules use them by name: base/gates/gate.hpp says how.

#pragma once

#include <cstdint>

#include "base/gates/constant_row.hpp"
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

#define GATE(id, name, sense, limit, ...) POSE_WALL_CONSTANT_GATE(motion::gate::id, sense, limit)
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

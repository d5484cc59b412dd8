// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The engine's table of gates is gates.def. Rules use them by name: base/gates/gate.hpp says how. A demand also gives
// the verdict what the row says.

#pragma once

#include <cmath>

#include "base/containers/work.hpp"
#include "base/gates/gate.hpp"
#include "base/math/elementary.hpp"
#include "engine/config.hpp"
#include "engine/trace/trace.hpp"
#include "engine/types.hpp"

namespace pose_wall {
namespace gate {

enum Id : std::uint32_t {
#define GATE(id, ...) id,
#include "engine/gates/gates.def"
#undef GATE
  kCount
};
enum Effect { TELLS, DOUBTS, REFUSES };

}  // namespace gate

#define GATE(id, name, sense_, limit_, unit, key, effect_, reasons_, origin, asks)                  \
  template <>                                                                                       \
  struct GateRow<gate::id> {                                                                        \
    static constexpr GateSense sense = GateSense::sense_;                                           \
    static constexpr gate::Effect effect = gate::effect_;                                           \
    static constexpr std::uint32_t reasons = reasons_;   /* as the row says */                      \
    static constexpr bool by_caller = #limit_[0] == 'B'; /* BY_CALLER alone begins so */            \
    static double limit([[maybe_unused]] const Settings& s) { return static_cast<double>(limit_); } \
  };
#include "engine/gates/gates.def"
#undef GATE

#ifdef POSE_WALL_TRACE
template <>
struct GateNotes<gate::Id> {
  static double limit_or(gate::Id id, double of_table) { return trace::limit_or(id, of_table); }
  static bool lets_pass(gate::Id id) { return trace::lets_pass(id); }
  static void note(gate::Id id, double value, double limit, bool passed) { trace::note_gate(id, value, limit, passed); }
};
#endif

// As passes(). If the value fails, the verdict gets the gate's reasons and is refused if the gate refuses.
template <auto id, typename... Limit>
bool demand(Verdict* verdict, const Limit&... value_and_limit) {
  if (passes<id>(value_and_limit...)) return true;
  verdict->reasons |= GateRow<id>::reasons;
  if (GateRow<id>::effect == gate::REFUSES) verdict->refused = true;
  return false;
}

// The budget of a frame (work_max): once it is spent, unfinished parts are refused.
inline bool demand_work_left(const Work& work, Verdict* verdict) {
  return demand<gate::WORK>(verdict, static_cast<double>(work.done()), static_cast<double>(work.most()));
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A gate compares a value with a limit. The table of all gates is gates.def. Rules use them by name here, and one call
// both judges and, in the traced library, takes the note. In the delivered engine a gate is the bare comparison.

#pragma once

#include <cmath>

#include "base/containers/work.hpp"
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
enum Sense { AT_LEAST, AT_MOST, BELOW, IS_SO };
enum Effect { TELLS, DOUBTS, REFUSES };

// The rows as types: sense, effect, reasons and limit(settings). A limit left to the caller is no number here.
template <Id id>
struct Row;
constexpr double BY_CALLER = -1.0;  // NOLINT(readability-identifier-naming): as gates.def spells it
#define GATE(id, name, sense_, limit_, unit, key, effect_, reasons_, origin, asks)                  \
  template <>                                                                                       \
  struct Row<id> {                                                                                  \
    static constexpr Sense sense = sense_;                                                          \
    static constexpr Effect effect = effect_;                                                       \
    static constexpr std::uint32_t reasons = reasons_;   /* as the row says */                      \
    static constexpr bool by_caller = #limit_[0] == 'B'; /* BY_CALLER alone begins so */            \
    static double limit([[maybe_unused]] const Settings& s) { return static_cast<double>(limit_); } \
  };
#include "engine/gates/gates.def"
#undef GATE

}  // namespace gate

// The limit of a gate.
template <gate::Id id>
double limit_of(const Settings& s) {
  static_assert(!gate::Row<id>::by_caller, "the caller knows this limit");
  double limit = gate::Row<id>::limit(s);
  POSE_WALL_NOTE(limit = trace::limit_or(id, limit));
  return limit;
}

namespace gate {

// NaN passes no gate.
template <Id id>
bool judge(double value, double limit) {
  constexpr Sense sense = Row<id>::sense;
  bool passed = sense == AT_MOST ? value <= limit : (sense == BELOW ? value < limit : value >= limit);
  POSE_WALL_NOTE(trace::note_gate(id, value, limit, passed));
  POSE_WALL_NOTE(passed = passed || trace::lets_pass(id));
  return passed;
}

}  // namespace gate

// True if the value passes. With the table's limit:
template <gate::Id id>
bool passes(double value, const Settings& s) {
  return gate::judge<id>(value, limit_of<id>(s));
}
// With a limit from the caller:
template <gate::Id id>
bool passes(double value, double limit) {
  static_assert(gate::Row<id>::by_caller, "gates.def has the limit");
  POSE_WALL_NOTE(limit = trace::limit_or(id, limit));
  return gate::judge<id>(value, limit);
}
// A bare yes or no:
template <gate::Id id>
bool passes(bool is_so) {
  static_assert(gate::Row<id>::sense == gate::IS_SO, "this gate holds a number against a limit");
  double limit = 1.0;
  POSE_WALL_NOTE(limit = trace::limit_or(id, limit));
  return gate::judge<id>(is_so ? 1.0 : 0.0, limit);
}

// The same. If the value fails, the verdict gets the gate's reasons and is refused if the gate refuses.
template <gate::Id id, typename... Limit>
bool demand(Verdict* verdict, const Limit&... value_and_limit) {
  if (passes<id>(value_and_limit...)) return true;
  verdict->reasons |= gate::Row<id>::reasons;
  if (gate::Row<id>::effect == gate::REFUSES) verdict->refused = true;
  return false;
}

// The budget of a frame (work_max): once it is spent, unfinished parts are refused.
inline bool demand_work_left(const Work& work, Verdict* verdict) {
  return demand<gate::WORK>(verdict, static_cast<double>(work.done()), static_cast<double>(work.most()));
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A gate compares a value with a limit. Engine, motion and planar have a table each, a row a gate, and rules ask for a
// gate by its name in one call. In a delivered library that is the bare comparison. A traced one also notes it, and
// takes another limit where a sweep has set one.

#pragma once

#include <type_traits>

#include "base/gates/note.hpp"

namespace pose_wall {

// How a value has to stand to the limit. IS_SO: a bare yes or no.
enum class GateSense { AT_LEAST, AT_MOST, ABOVE, BELOW, IS_SO };

// In a row whose limit the caller knows; no number is compared with it.
constexpr double BY_CALLER = -1.0;  // NOLINT(readability-identifier-naming): as the tables spell it

// The row of a gate, by the enumerator of its table: sense, by_caller, limit(settings...).
template <auto id>
struct GateRow;

// What a traced library does with the gates of a table, by the type of its enumerators: limit_or(id, of_table),
// note(id, value, limit, passed), lets_pass(id).
template <typename Id>
struct GateNotes;

namespace gates {

// NaN passes no gate.
template <GateSense sense, typename Value, typename Limit>
bool holds(Value value, Limit limit) {
  using Common = std::common_type_t<Value, Limit>;
  const auto v = static_cast<Common>(value), l = static_cast<Common>(limit);
  if constexpr (sense == GateSense::AT_MOST) return v <= l;
  if constexpr (sense == GateSense::ABOVE) return v > l;
  if constexpr (sense == GateSense::BELOW) return v < l;
  return v >= l;
}

template <auto id, typename Limit>
Limit limit_or([[maybe_unused]] Limit of_table) {
  POSE_WALL_NOTE(of_table = static_cast<Limit>(GateNotes<decltype(id)>::limit_or(id, static_cast<double>(of_table))));
  return of_table;
}

template <auto id, typename Value, typename Limit>
bool judge(Value value, Limit limit) {
  bool passed = holds<GateRow<id>::sense>(value, limit);
  POSE_WALL_NOTE(GateNotes<decltype(id)>::note(id, static_cast<double>(value), static_cast<double>(limit), passed));
  POSE_WALL_NOTE(passed = passed || GateNotes<decltype(id)>::lets_pass(id));
  return passed;
}

}  // namespace gates

// The limit of a gate by its table, for a rule that does more than compare with it.
template <auto id, typename... Settings>
auto limit_of(const Settings&... s) {
  static_assert(!GateRow<id>::by_caller, "the caller knows this limit");
  return gates::limit_or<id>(GateRow<id>::limit(s...));
}

// True if the value passes, with the table's limit. A table may need the settings for it.
template <auto id, typename Value>
bool passes(Value value) {
  static_assert(GateRow<id>::sense != GateSense::IS_SO || std::is_same_v<Value, bool>, "this gate asks yes or no");
  if constexpr (std::is_same_v<Value, bool>) {
    static_assert(GateRow<id>::sense == GateSense::IS_SO, "this gate holds a number against a limit");
    return gates::judge<id>(value ? 1.0 : 0.0, gates::limit_or<id>(1.0));
  } else {
    return gates::judge<id>(value, limit_of<id>());
  }
}
// With the settings, or with the limit that the caller knows.
template <auto id, typename Value, typename Given>
bool passes(Value value, const Given& settings_or_limit) {
  if constexpr (GateRow<id>::by_caller) {
    return gates::judge<id>(value, gates::limit_or<id>(settings_or_limit));
  } else {
    return gates::judge<id>(value, limit_of<id>(settings_or_limit));
  }
}
// Of the test ratio value / allowed, whose limit is the table's. It is never divided: a squared error over its
// variance may be over nothing, and the product has other bits.
template <auto id, typename Value>
bool passes_of(Value value, Value allowed) {
  const auto limit = limit_of<id>();
  bool passed = gates::holds<GateRow<id>::sense>(value, static_cast<Value>(limit) * allowed);
  POSE_WALL_NOTE(GateNotes<decltype(id)>::note(id, static_cast<double>(value) / static_cast<double>(allowed),
                                               static_cast<double>(limit), passed));
  POSE_WALL_NOTE(passed = passed || GateNotes<decltype(id)>::lets_pass(id));
  return passed;
}

}  // namespace pose_wall

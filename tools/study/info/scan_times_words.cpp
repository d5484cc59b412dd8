// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <string>

#include "io/language/language.hpp"
#include "study/info/scan_times.hpp"

namespace pose_wall::tools {
namespace {

// What was seen, and what was expected.
std::string seen_text(const ScanTimeFacts& facts) {
  switch (facts.fault) {
    case TimeFault::kNone:
      return "";
    case TimeFault::kMissing:
      return tr("points carry no times, and the machine moves.");
    case TimeFault::kType:
      return tr("a field is called like a time, but is no single number of a type that is read as one.");
    case TimeFault::kOne:
      return tr("all points of a scan have the same time.");
    case TimeFault::kUnit:
      return tr("in none of s, ms, us and ns a scan takes 0.01 to 1 s.");
    case TimeFault::kNoTurn:
      return say(
          "returns of one moment lie all round, though a sensor with {} rings turns and looks one way at a time.",
          facts.rings);
    case TimeFault::kByRow:
      return say("by the times a scan holds as many turns as the sensor has rings, {}: times by row?", facts.rings);
    case TimeFault::kUneven:
      return say(
          "{:.0f} % of the returns are more than a twentieth of a turn off a steady turn: times by a count of "
          "points?",
          100.0 * facts.share);
    case TimeFault::kBackward:
      return tr("times fall in the order in which the points are stored: are they counted back from the scan's end?");
    case TimeFault::kSpan:
      if (facts.step_s == 0.0) return say("by the times a turn takes {:.4f} s; no sensor is so quick.", facts.turn_s);
      return say("by the times a scan takes {:.3f} s and a turn {:.3f} s; from stamp to stamp it is {:.3f} s.",
                 facts.spread_s, facts.turn_s, facts.step_s);
    case TimeFault::kMoved:
      return say(
          "near points lie off the steady turn as if {:.2f} m/s had been taken out: was this cloud de-skewed "
          "already?",
          facts.moved_m_s);
  }
  return "";
}

}  // namespace

std::string times_doubt(const ScanTimeFacts& facts) {
  if (facts.fault == TimeFault::kNone) return "";
  const std::string seen = say("{} of {} scans: {}", facts.faulty, facts.scans, seen_text(facts));
  if (!facts.does_harm()) return say("{} The motion within a scan stays in it", seen);
  if (facts.fault == TimeFault::kMoved) return say("{} The motion within a scan would be taken out twice", seen);
  return say("{} The motion within a scan would be taken out wrongly, and may bend it by twice that motion", seen);
}

std::string times_advice(const ScanTimeFacts& facts) {
  if (!facts.does_harm()) return "";
  if (facts.fault == TimeFault::kMoved) return tr("Leave out the field of times, and set scan_max: 0");
  return tr("Record the times of the sensor's own driver, or its packets");
}

const char* time_fault_name(TimeFault fault) {
  switch (fault) {
    case TimeFault::kNone:
      return "";
    case TimeFault::kMissing:
      return "none_moving";
    case TimeFault::kType:
      return "type";
    case TimeFault::kOne:
      return "one_time";
    case TimeFault::kUnit:
      return "unit";
    case TimeFault::kNoTurn:
      return "no_turn";
    case TimeFault::kByRow:
      return "by_row";
    case TimeFault::kUneven:
      return "uneven";
    case TimeFault::kBackward:
      return "backward";
    case TimeFault::kSpan:
      return "span";
    case TimeFault::kMoved:
      return "moved";
  }
  return "";
}

}  // namespace pose_wall::tools

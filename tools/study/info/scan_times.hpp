// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether the times of a scan fit its shape. A turning sensor looks in one direction at a time, and turns steadily:
// time and azimuth lie on a line. By times that do not fit, the motion within a scan is taken out wrongly.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/frames/frame.hpp"
#include "study/info/sensor_look.hpp"

namespace pose_wall::tools {

enum class TimeFault {
  kNone,
  kMissing,   // none, though the machine moves: only who measures motion can tell
  kType,      // a field is called like a time, but is of no type that is read
  kOne,       // all points of a scan have one time
  kUnit,      // in no unit a scan of them takes 0.01 to 1 s
  kNoTurn,    // what is of one moment lies all round
  kByRow,     // one ring after the other, each a turn
  kUneven,    // off a steady turn
  kBackward,  // falls in the order in which the points are stored
  kSpan,      // a scan, or a turn, takes another time than there is from stamp to stamp
  kMoved      // the points have been moved: somebody took the motion out already
};

struct ScanTimeFacts {
  TimeFault fault = TimeFault::kNone;
  std::size_t scans = 0;   // that have times and enough returns
  std::size_t faulty = 0;  // of these, with this fault
  std::size_t rings = 0;
  double spread_s = 0.0;   // median from a scan's first point to its last
  double turn_s = 0.0;     // median of a whole turn, by the times; 0: it does not turn, or that does not show
  double step_s = 0.0;     // median from stamp to stamp; 0: the scans carry none
  double share = 0.0;      // median share of returns that are off, in the faulty ones
  double moved_m_s = 0.0;  // median speed that was taken out of the faulty ones

  // Taking out motion by such times does harm. (Without motion a scan keeps all of its own, which is as much.)
  bool does_harm() const { return fault > TimeFault::kUnit; }
};

class ScanTimeLook {
 public:
  void add(const Frame& frame);
  // sensor: of the same frames. One that does not turn has no such line, and is not judged by it.
  ScanTimeFacts facts(const SensorFacts& sensor, const std::vector<std::int64_t>& stamps_ns) const;

  struct Note {  // of one scan
    double spread_s = 0.0, turn_s = 0.0, sweep_rad = 0.0;
    double off_moment = 0.0, off_turn = 0.0;
    double order = 1.0;  // correlation of time and place in the cloud
    double moved_m_s = 0.0;
    bool is_type = false, is_one = false, is_unit_unknown = false, has_rings = false, leans = false;
  };

 private:
  std::vector<Note> notes_;
};

// What was seen and what it costs; empty without a fault.
std::string times_doubt(const ScanTimeFacts& facts);
// What to do about it; empty where it does no harm.
std::string times_advice(const ScanTimeFacts& facts);
// For programs: "none_moving", "type", "one_time", "unit", "no_turn", "by_row", "uneven", "backward", "span", "moved";
// empty without a fault.
const char* time_fault_name(TimeFault fault);

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Decides when silence is due, and how old the known values are.

#pragma once

#include <cstdint>

#include "base/math/time_units.hpp"
#include "saturated.hpp"

namespace pose_wall::runtime {

class Watchdog {
 public:
  // watchdog_ns 0: it never speaks.
  Watchdog(std::int64_t watchdog_ns, std::int64_t every_ns) : watchdog_ns_(watchdog_ns), every_ns_(every_ns) {}

  // A start, or a worked frame: the values are as old as its arrival.
  void feed(std::int64_t received_ns) {
    since_ns_ = seen_ns_ = received_ns;
    next_ns_ = sum(received_ns, watchdog_ns_);
    elapsed_ns_ = 0;
    spoke_last_ = false;
  }

  // It does not speak twice while a frame waits: a callback that takes longer than every_ns would never let one
  // through. A clock that went back by more than the watchdog's time has no meaning any more, so silence is due at
  // once. The same holds if it would be due later than ever: a bit in here flipped.
  bool is_due(std::int64_t now_ns, bool frame_waits) {
    if (watchdog_ns_ == 0) return false;
    const bool went_back = difference(seen_ns_, now_ns) > watchdog_ns_;
    if (now_ns > seen_ns_) seen_ns_ = now_ns;
    if (spoke_last_ && frame_waits) return false;
    return now_ns >= next_ns_ || went_back || difference(next_ns_, now_ns) > 2 * longest_ns();
  }

  // A frame that came so long ago is no news: published, it would look fresh.
  bool is_late(std::int64_t now_ns, std::int64_t received_ns) const {
    return watchdog_ns_ > 0 && difference(now_ns, received_ns) >= watchdog_ns_;
  }

  // Duration of the silence, by a clock that may go back. Then it is unknown, and longer than anything is held.
  std::int64_t speak(std::int64_t now_ns) {
    const std::int64_t by_clock_ns = difference(now_ns, since_ns_);
    const std::int64_t silent_ns = by_clock_ns >= elapsed_ns_ ? by_clock_ns : kHour_ns;
    if (silent_ns > elapsed_ns_) elapsed_ns_ = silent_ns;
    seen_ns_ = now_ns;
    next_ns_ = sum(now_ns, every_ns_);
    spoke_last_ = true;
    return elapsed_ns_;
  }

  // To look at the clock again, at the latest.
  std::int64_t wake_ns(std::int64_t now_ns) const {
    const std::int64_t latest_ns = sum(now_ns, longest_ns());
    return next_ns_ < latest_ns ? next_ns_ : latest_ns;
  }

  bool is_on() const { return watchdog_ns_ > 0; }
  std::int64_t since_ns() const { return since_ns_; }

 private:
  std::int64_t longest_ns() const { return watchdog_ns_ > every_ns_ ? watchdog_ns_ : every_ns_; }

  std::int64_t watchdog_ns_, every_ns_;
  std::int64_t since_ns_ = 0, next_ns_ = 0, elapsed_ns_ = 0;
  std::int64_t seen_ns_ = 0;  // the latest look at the clock
  bool spoke_last_ = false;
};

}  // namespace pose_wall::runtime

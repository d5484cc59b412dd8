// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How long something was in each of its states, since the start: who looks every 15 s sees what came and went between.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pose_wall::tools::live {

class StateTimes {
 public:
  // Of so many states. `unknown` is the one before the first note, and once a note holds no more.
  StateTimes(std::size_t states, std::size_t unknown, std::int64_t now_ns)
      : ns_(states, 0), unknown_(unknown), state_(unknown), since_ns_(now_ns), holds_ns_(now_ns), told_ns_(now_ns) {}

  // From now_ns on, and no longer than until_ns, where no other note comes before.
  void note(std::size_t state, std::int64_t now_ns, std::int64_t until_ns) {
    ns_ = until(now_ns);
    state_ = state;
    since_ns_ = told_ns_;
    holds_ns_ = until_ns;
  }

  // By state, in ns. A monitor takes a counter that goes back for a new start: what was told once, stays.
  std::vector<std::int64_t> until(std::int64_t now_ns) {
    std::vector<std::int64_t> sums = ns_;
    told_ns_ = std::max(told_ns_, now_ns);
    const std::int64_t end_ns = told_ns_, held_ns = std::clamp(holds_ns_, since_ns_, end_ns);
    sums[state_] += held_ns - since_ns_;
    sums[unknown_] += end_ns - held_ns;
    return sums;
  }

 private:
  std::vector<std::int64_t> ns_;
  std::size_t unknown_, state_;
  std::int64_t since_ns_, holds_ns_, told_ns_;  // told_ns_: the latest moment that was asked for
};

}  // namespace pose_wall::tools::live

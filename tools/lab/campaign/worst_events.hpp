// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The frames in which the instrument promised too much, the worst first, each with the way back to it.

#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "lab/campaign/record.hpp"
#include "study/truth/alert_limits.hpp"

namespace pose_wall::tools::campaign {

enum class Breach { kMisleading, kValueBeyondProtection, kRawBeyondProtection };
const char* breach_name(Breach breach);

struct WorstEvent {
  Breach breach;
  double excess;  // error / alert limit, or error / protection level; infinite without a truth or a protection level
  Run run;
  std::uint32_t frame;
  std::uint32_t quantity;
  double error;  // NaN without a truth
  Measured measured;
  std::uint32_t reasons;
  bool stamps_are_steady;  // up to this frame as `pose_wall run` gives them to files: 0.1 s apart

  bool misleads() const { return breach == Breach::kMisleading; }
};

// Sorts them, misleading ones first, then by excess, and keeps so many.
template <typename Event>
void keep_worst(std::size_t events_max, std::vector<Event>* events) {
  std::stable_sort(events->begin(), events->end(), [](const Event& a, const Event& b) {
    return a.misleads() != b.misleads() ? a.misleads() : a.excess > b.excess;
  });
  if (events->size() > events_max) events->resize(events_max);
}

// Misleading ones first, then by excess. Of one run and quantity only the worst frame of its gravest breach.
std::vector<WorstEvent> worst_events(const std::vector<const RunRecord*>& records, const AlertLimits& limits,
                                     std::size_t events_max);

}  // namespace pose_wall::tools::campaign

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/event_times.hpp"

#include <algorithm>
#include <optional>

namespace pose_wall::tools::campaign {
namespace {

std::size_t longest_misleading(const RunRecord& record, std::size_t q, const AlertLimits& limits) {
  std::size_t longest = 0;
  std::size_t length = 0;
  for (const FrameRecord& frame : record.frames) {
    length = judge(frame, q, limits).misleading ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  return longest;
}

// Every quantity that was valid in `before` is so in `frame`.
bool keeps_valid(const FrameRecord& frame, const FrameRecord& before) {
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (before.quantity[q].measured.state == POSE_WALL_VALID && frame.quantity[q].measured.state != POSE_WALL_VALID) {
      return false;
    }
  }
  return true;
}

bool has_valid(const FrameRecord& frame) {
  return std::any_of(frame.quantity.begin(), frame.quantity.end(),
                     [](const QuantityRecord& q) { return q.measured.state == POSE_WALL_VALID; });
}

// Frames from `from` to the first before `to` of which `holds` is true.
template <typename Predicate>
std::optional<std::size_t> first_that(const RunRecord& record, std::size_t from, std::size_t to, Predicate holds) {
  for (std::size_t i = from; i < to; ++i) {
    if (holds(record.frames[i])) return i - from;
  }
  return std::nullopt;
}

void count(std::optional<std::size_t> time, std::vector<std::size_t>& times, std::size_t& never) {
  if (time) {
    times.push_back(*time);
  } else {
    ++never;
  }
}

}  // namespace

void EventTimes::add(const RunRecord& record, const AlertLimits& limits) {
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    alert_max = std::max(alert_max, longest_misleading(record, q, limits));
  }
  const std::vector<FrameRecord>& frames = record.frames;
  const auto position = [&frames](auto phase_is) {
    return static_cast<std::size_t>(std::find_if(frames.begin(), frames.end(), phase_is) - frames.begin());
  };
  const std::size_t first =
      position([](const FrameRecord& f) { return f.phase == Phase::kEvent || f.phase == Phase::kAfter; });
  const std::size_t after = position([](const FrameRecord& f) { return f.phase == Phase::kAfter; });
  if (first == 0 || first == frames.size() || !has_valid(frames[first - 1])) return;
  const FrameRecord& before = frames[first - 1];
  count(first_that(record, first, frames.size(), [&](const auto& f) { return !keeps_valid(f, before); }), noticed,
        never_noticed);
  if (after == frames.size()) return;
  count(first_that(record, after, frames.size(), [&](const auto& f) { return keeps_valid(f, before); }), recovered,
        never_recovered);
}

}  // namespace pose_wall::tools::campaign

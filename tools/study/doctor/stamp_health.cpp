// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/stamp_health.hpp"

#include <vector>

#include "study/doctor/statistics.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr double kCutShare = 0.6;

void count_frames(const Recording& recording, StampHealth& health) {
  std::vector<double> returns;
  for (const FrameNote& note : recording.notes) {
    if (note.error.empty() && note.returns > 0) returns.push_back(note.returns);
  }
  const double usual = returns.empty() ? 0.0 : median(returns);
  const FrameNote* before = nullptr;
  for (const FrameNote& note : recording.notes) {
    if (!note.error.empty()) {
      ++health.unreadable;
      continue;
    }
    ++health.frames;
    health.own_stamps += note.has_own_stamp ? std::size_t{1} : 0;
    if (note.returns == 0) ++health.empty;
    if (note.returns > 0 && note.returns < kCutShare * usual) ++health.cut;
    if (before != nullptr && note.returns > 0 && note.digest == before->digest) ++health.repeated;
    before = &note;
  }
}

}  // namespace

ScanTimeFacts look_at_times(const Recording& recording) {
  std::vector<std::int64_t> stamps_ns;
  for (const FrameNote& note : recording.notes) {
    if (note.error.empty() && note.has_own_stamp) stamps_ns.push_back(note.stamp_ns);
  }
  return recording.times.facts(recording.sensor.facts(), stamps_ns);
}

StampHealth look_at_stamps(const Recording& recording) {
  std::vector<std::int64_t> stamps_ns;
  for (const FrameNote& note : recording.notes) {
    if (note.error.empty()) stamps_ns.push_back(note.stamp_ns);
  }
  StampHealth health{look_at_steps(stamps_ns)};
  count_frames(recording, health);
  return health;
}

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "doctor/stamp_health.hpp"

#include <algorithm>
#include <vector>

#include "doctor/statistics.hpp"
#include "frames/frame_stamps.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr double kCutShare = 0.6;
constexpr double kGapSteps = 2.5;
constexpr double kStillBelow_s = 1e-3;  // the engine takes it for the same frame again

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

std::vector<double> steps_of(const Recording& recording) {
  std::vector<double> steps_s;
  const FrameNote* before = nullptr;
  for (const FrameNote& note : recording.notes) {
    if (!note.error.empty()) continue;
    if (before != nullptr) steps_s.push_back(seconds_between(before->stamp_ns, note.stamp_ns));
    before = &note;
  }
  return steps_s;
}

}  // namespace

StampHealth look_at_stamps(const Recording& recording) {
  StampHealth health;
  count_frames(recording, health);
  std::vector<double> ahead_s;
  for (const double step_s : steps_of(recording)) {
    if (step_s >= 0.0 && step_s < kStillBelow_s) ++health.still;
    if (step_s < 0.0) ++health.back;
    if (step_s >= kStillBelow_s) ahead_s.push_back(step_s);
  }
  if (ahead_s.empty()) return health;
  const double usual_s = median(ahead_s);
  health.rate_hz = 1.0 / usual_s;
  health.jitter_s = spread90(ahead_s);
  for (const double step_s : ahead_s) {
    // A gap is no time that was recorded.
    health.duration_s += std::min(step_s, kGapSteps * usual_s);
    health.gaps += step_s > kGapSteps * usual_s ? std::size_t{1} : 0;
    health.gap_max_s = std::max(health.gap_max_s, step_s);
  }
  health.duration_s += usual_s;
  return health;
}

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The stamps of the frames: the time since the last one that was placed, the usual time between two, and when a clock
// that went back is believed.

#pragma once

#include <cstdint>

namespace pose_wall::motion {

class FrameClock {
 public:
  std::uint64_t frames() const { return frames_; }
  // 0 for the first frame.
  double since_last_s(std::int64_t stamp_ns) const {
    return frames_ > 0 ? (static_cast<double>(stamp_ns) - static_cast<double>(stamp_ns_)) * 1e-9 : 0.0;
  }
  bool goes_on(double dt_s) const { return frames_ == 0 || dt_s > kSameStamp_s; }
  bool is_late(double dt_s) const { return dt_s > kGapPeriods * period_s_ && period_s_ > 0.0; }

  // The frame has a pose, or there is no map yet. Frames of nothing have no effect: time counts from the last one that
  // was placed.
  void take(std::int64_t stamp_ns, double dt_s) {
    const bool usual = dt_s > 0.0 && dt_s < kPeriodMost_s;
    if (usual) period_s_ = period_s_ > 0.0 ? period_s_ + kOfPeriod * (dt_s - period_s_) : dt_s;
    stamp_ns_ = stamp_ns;
  }
  void go_on() { back_ = 0; }
  // A frame came, whatever became of it.
  void count() { ++frames_; }
  // One frame out of order, or a clock that was set back: the second one decides. The usual period is the best estimate
  // of the time since the last pose.
  void go_back(std::int64_t stamp_ns, double dt_s) {
    if (!(dt_s < -kSameStamp_s && ++back_ > 1)) return;
    // by whole numbers that wrap: a stamp may be the least there is
    stamp_ns_ =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(period_s_ * 1e9));
  }

 private:
  // Of the usual period: more than two, and at least one frame is missing.
  static constexpr double kGapPeriods = 2.5;
  // A longer silence is no period: sensors turn once a second at least.
  static constexpr double kPeriodMost_s = 10.0;
  static constexpr double kOfPeriod = 0.1;      // so the mean of some ten frames: one late frame is no gap's measure
  static constexpr double kSameStamp_s = 1e-3;  // as the engine's POSE_WALL_R_STAMP_STILL

  std::int64_t stamp_ns_ = 0;
  double period_s_ = 0.0;   // usual time between frames
  std::uint32_t back_ = 0;  // stamps in a row that went back
  std::uint64_t frames_ = 0;
};

}  // namespace pose_wall::motion

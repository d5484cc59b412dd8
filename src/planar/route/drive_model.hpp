// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the machine makes of commands: later, with a lag, with slip. Carries a pose over commands that have yet to act.

#pragma once

#include <cstdint>

#include "place/pose2.hpp"

namespace pose_wall::planar::route {

struct Rates {
  double speed_m_s = 0.0, turn_rad_s = 0.0;
};

class DriveModel {
 public:
  // Poses are at most oldest_s late.
  void open(double delay_s, double lag_s, double oldest_s);
  void forget_commands();

  // Time goes on by step_s, and the command that was given last has held since.
  void advance(double step_s);
  void command(const Rates& rates) { last_ = rates; }

  // Where a machine that stood at a pose age_s ago will be when a command given now begins to act.
  Pose2 predicted(const Pose2& then, double age_s) const;
  // It stands when all commands given so far have acted.
  bool stands() const;

  // What slips is learnt from poses: how far the machine came, and how far by the model.
  void learn(const Pose2& pose, double age_s);
  void learn_anew() { has_mark_ = false; }
  double slip() const { return 1.0 - kept_; }
  double drift_1_m() const { return drift_1_m_; }

 private:
  static constexpr std::uint32_t kCommandsMost =
      256;  // 2.56 s of a controller at 100 Hz; delay and lag end at 1 s each
  struct Given {
    double duration_s;
    Rates rates;
  };
  // The drive at a time, and all it has driven and turned so far, by the model without slip.
  struct Drive {
    Rates rates;
    double way_m = 0.0, turn_rad = 0.0;
  };

  void follow(Drive* drive, const Rates& command, double step_s) const;
  Rates real(const Rates& rates) const;
  const Given& given(std::uint32_t k) const { return given_[(first_ + k) % kCommandsMost]; }
  // The drive after the first seconds_s of the commands that are kept. visit(drive, seconds) for each piece behind
  // them.
  template <typename Visit>
  Drive replay(double seconds_s, const Visit& visit) const;
  double seconds_to(double age_s) const { return kept_s_ - delay_s_ - age_s; }

  double delay_s_ = 0.0, lag_s_ = 0.0, horizon_s_ = 0.0;
  Given given_[kCommandsMost] = {};  // of the last horizon_s, oldest first
  std::uint32_t first_ = 0, count_ = 0;
  double kept_s_ = 0.0;
  Rates last_;
  Drive before_;  // when the oldest of the commands began to act
  double kept_ = 1.0, drift_1_m_ = 0.0;
  bool has_mark_ = false;
  Pose2 mark_;
  Drive drive_at_mark_;
};

}  // namespace pose_wall::planar::route

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The motion within the scan that begins at a frame's stamp: it is told ahead, by the steps before, and each next step
// shows how far off that was. Rates in the road's directions: m/s and rad/s, as pose_wall_odometry.rate_level.

#pragma once

#include <cstdint>

#include "motion/gates.hpp"
#include "motion/travel.hpp"

namespace pose_wall::motion {

class ScanMotion {
 public:
  // Nothing is known but the machine's limits.
  void forget(double speed_most_m_s, double turn_most_rad_s);
  // The mean rates since the last frame, the variances that the two alignments give them, and how much they tell beside
  // the last ones: 1, less after a shorter step.
  void learn(const Six& rate, const Six& variance, double tells = 1.0);
  // The way along is known to within so much, whatever was learnt.
  void set_along(double rate_m_s, double unknown_m_s);

  // Zero in a direction in which no motion shows: a standing machine's scans are left as they are. With the noise of a
  // step taken out of them they would be bent by it.
  const Six& rate() const { return rate_; }
  // Standard deviations of the rates by a factor, with the last change of the motion: it may go on.
  Six level(double factor) const;

 private:
  // How many frames the variance of the alignments stands for: few, since it is of patches of rock, which a standing
  // machine sees alike again. With 2 or 16 the yaw rate's level is 6 % narrower or wider in the sweep.
  static constexpr double kFramesOfAlignment = 4.0;
  // Noise that was hardly any yet may grow from so much of the alignments' variance. From 0.01 to 0.3 the
  // sweep's levels are the same.
  static constexpr double kLeastOfAlignment = 1.0 / 16.0;
  // A machine's motion changes within seconds. With 6 the yaw rate's level is 6 % narrower, with 40 the same.
  static constexpr double kFramesMost = 16.0;

  Six rate_ = Six::Zero();  // told
  // Of the last step, and the variance of steps without their motion.
  Six measured_ = Six::Zero(), noise_ = Six::Zero();
  Six changed_ = Six::Zero(), variance_ = Six::Zero();  // how far off the told ones were, last and in the mean
  Six limit_ = Six::Zero();
  double frames_ = 0.0;  // that the variances are of; 0: nothing is known
};

}  // namespace pose_wall::motion

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The first step of a frame: where the machine is expected. It goes on as it last moved (the constant velocity model),
// unless its own data says otherwise.

#pragma once

#include "motion/frame.hpp"
#include "motion/machine_prior.hpp"
#include "motion/scan_motion.hpp"

namespace pose_wall::motion {

struct Expected {
  MachinePrior prior;
  Pose pose;
  std::uint32_t reasons = 0;
};

// The motion from one frame to the next, and how it is known.
struct MotionStep {
  double s = 0.0;  // since the last frame that had a pose
  Eigen::Vector3d m = Eigen::Vector3d::Zero(), rad = Eigen::Vector3d::Zero();
  Six variance = Six::Zero();  // by the patches of rock alone
  Bounds bounds;
  double slip_m = 0.0;          // the unknown way along, beyond sigma
  bool is_along_known = false;  // by the rock or by the machine
};

// How the machine moves: a smoothed twist to expect the next place by, and the rates within the next scan.
class MotionModel {
 public:
  // All of it, before the first frame.
  void reset(const MotionSettings& settings);
  // The rates alone: a new map, or a mean over a gap, which is that of no scan.
  void forget_rates(const MotionSettings& settings);
  // The machine may do anything: its place was lost.
  void forget_twist() { twist_ = Twist{}; }

  Expected expect(const Course& last, const MotionSettings& settings, const Frame& frame) const;
  // The mean motion since the last frame. The next scan begins now, and its own motion is told by it.
  void learn(const Course& last, const RoadAxes& axes, const MotionSettings& settings, const MotionStep& step,
             double dt_s);

  const Twist& twist() const { return twist_; }
  // Within the next scan, in base.
  Twist rates(const Course& now) const;
  Six rate_level(double factor) const { return scan_motion_.level(factor); }

 private:
  // How much a step of so many seconds tells of the rates beside one as long as usual.
  double tells(double dt_s);

  Twist twist_;
  ScanMotion scan_motion_;
  double usual_s_ = 0.0;  // mean of the steps; 0: none yet
};

}  // namespace pose_wall::motion

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Where base may stand now, before the scan is looked at. Odometry is the likeliest answer, but it may stall, and then
// make up for it in one step: tracks slip, a counter is read late. So there are others, each with what it costs to
// believe it.

#pragma once

#include <cstdint>

#include "place/pose2.hpp"

namespace pose_wall::planar {

class StepPredictor {
 public:
  static constexpr std::uint32_t kMost = 3;  // odometry, odometry that stalled, the last step once more

  struct Prediction {
    Pose2 pose;
    double sigma_m = 0.0, sigma_rad = 0.0;  // of the step
    double unlikely = 0.0;                  // as a squared distance: what it costs to believe this one
    bool is_odometry = false;               // it tells the way, and not only that the machine goes on
  };

  // Standard deviation of odometry, and of going on, by a step's length and turn.
  void open(double share_m, double share_rad);
  // Nothing is known of base's way, and odometry has not spoken.
  void begin();
  // The first scan: odometry's pose here, which may be nullptr. How base moves stays unknown.
  void start(const Pose2* odometry);
  // odometry may be nullptr. The likeliest one first; returns how many.
  std::uint32_t predict(const Pose2& from, const Pose2* odometry, Prediction* out) const;
  // What became of it. `agrees`: the first prediction did.
  void follow(const Pose2& from, const Pose2& to, const Pose2* odometry, bool agrees);

 private:
  Prediction by(const Pose2& from, const Pose2& step, double sigma_m, double sigma_rad) const;

  double share_m_ = 0.0, share_rad_ = 0.0;
  Pose2 odometry_, last_step_;
  Pose2 since_agreed_;     // how base moved since odometry last agreed with a scan
  Pose2 agreed_odometry_;  // what it said then
  bool knows_step_ = false, has_odometry_ = false, has_agreed_ = false, is_astray_ = false;
};

}  // namespace pose_wall::planar

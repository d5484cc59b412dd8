// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From scan to scan in a map of the last metres: the match that the scan and one of the predictions together like best.

#pragma once

#include "place/step_predictor.hpp"
#include "planar/match/matcher.hpp"

namespace pose_wall::planar {

class ScanFollower {
 public:
  struct Followed {
    Fit match;    // its pose is the first prediction's where it is not valid
    Prior prior;  // the first prediction
  };

  // Standard deviation of a step of odometry by its length and turn.
  void open(double odometry_m, double odometry_rad);
  // Forgets what odometry said and how base moved.
  void begin();
  // The scan makes the map: there is nothing to match it with. odometry may be nullptr, here and below.
  void see_first(const Pose2* odometry);
  // Base stood at `from` when the last scan was taken. noise_m of a point about its surface.
  Followed follow(const Pose2& from, Span<const ScanPoint> points, const SurfaceMap& near, double noise_m,
                  const Pose2* odometry, Matcher& matcher);

 private:
  // What is known of the place, if base moved as one of the predictions says.
  struct Predicted {
    Prior prior;
    double unlikely = 0.0;  // as of StepPredictor
  };

  std::uint32_t predict(const Pose2& from, const Pose2* odometry, Predicted* out) const;

  StepPredictor predictor_;
};

}  // namespace pose_wall::planar

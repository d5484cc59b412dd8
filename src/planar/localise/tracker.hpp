// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From scan to scan in the map: pose and covariance, and whether the scans still agree with it.

#pragma once

#include <cstdint>

#include "planar/localise/place_fit.hpp"

namespace pose_wall::planar {

// loose: the scan fits, but the place is not certain along the road.
enum class Track : std::uint32_t { tracked, loose, doubtful, blind, contradicted, lost };

struct TrackRule {
  double odometry_m = 0.1, odometry_rad = 0.3;  // standard deviation of a step by its length and turn
};

class Tracker {
 public:
  void open(const TrackRule& rule);
  // Base stands here; standard deviations of what is known.
  void begin(const Pose2& pose, double sigma_m, double sigma_rad);
  // One scan, in `look` from where base stands. odometry may be nullptr. `room` for two.
  Track follow(const PlaceMap& map, const Look& look, const Pose2* odometry, PatchCosts* room);

  // The scan was taken where base was said to stand.
  Track confirm(const PlaceMap& map, const Look& look, const Pose2* odometry, PatchCosts* room);

  const Pose2& pose() const { return pose_; }
  const Eigen::Matrix3d& covariance() const { return covariance_; }
  const Fit& fit() const { return fit_; }
  const PatchVerdict& verdict() const { return verdict_; }
  double slide_m() const { return slide_m_; }

 private:
  struct Along {
    Eigen::Vector2d direction;
    double sigma_m;
  };

  Track follow_to(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room);
  Along uncertain_along() const;
  Pose2 predict(const Pose2* odometry);
  void place(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room);
  void update(const PlaceMap& map, const Look& look, const Pose2& predicted, PatchCosts* room);
  Track judge(double step_m);

  TrackRule rule_;
  Pose2 pose_, last_step_, odometry_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Identity();
  Fit fit_;
  PatchVerdict verdict_;
  double slide_m_ = 0.0, doubtful_m_ = 0.0;
  std::uint32_t contradicted_ = 0;
  bool has_odometry_ = false, has_step_ = false;
};

}  // namespace pose_wall::planar

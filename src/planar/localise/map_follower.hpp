// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From scan to scan in the map: pose and covariance, and whether the scans still agree with it.

#pragma once

#include <cstdint>

#include "place/step_predictor.hpp"
#include "planar/gates.hpp"
#include "planar/localise/surroundings.hpp"

namespace pose_wall::planar {

// loose: the scan fits, but the place is not certain along the road.
enum class TrackingState : std::uint32_t { tracked, loose, doubtful, blind, contradicted, lost };

class MapFollower {
 public:
  // Standard deviation of a step of odometry by its length and turn.
  void open(double odometry_m, double odometry_rad);
  // Base stands here; standard deviations of what is known.
  void begin(const Pose2& pose, double sigma_m, double sigma_rad);
  // One scan, from where base stands. odometry may be nullptr.
  TrackingState follow(const PlaceMap& map, const Surroundings& around, const Pose2* odometry);

  // The scan was taken where base was said to stand.
  TrackingState confirm(const PlaceMap& map, const Surroundings& around, const Pose2* odometry);

  const Pose2& pose() const { return pose_; }
  const Eigen::Matrix3d& covariance() const { return covariance_; }
  const Fit& fit() const { return fit_; }
  const PatchVerdict& verdict() const { return verdict_; }
  double slide_m() const { return slide_m_; }

 private:
  // What is known before the scan, if the machine moved as this prediction says.
  struct Predicted : Prior {
    Eigen::Matrix3d covariance;
    double unlikely = 0.0;  // a squared distance
    bool is_odometry = false;

    Prior prior() const { return {pose, information}; }
    bool agrees(const Pose2& to) const { return passes<gate::AGREES>(squared_distance(to)); }
  };

  struct Predictions {
    Predicted all[StepPredictor::kMost];  // the likeliest before the scan first
    std::uint32_t count = 0;

    const Predicted* begin() const { return all; }
    const Predicted* end() const { return all + count; }
    const Predicted& first() const { return all[0]; }
    // Of a place, and how unlikely it makes it.
    const Predicted& likeliest(const Pose2& at, double* unlikely) const;
  };
  struct Placed {
    Fit fit;
    PatchVerdict verdict;
    const Predicted* predicted = nullptr;  // the likeliest one
    double cost = 0.0;                     // of patches and prediction
  };

  Predictions predict(const Pose2* odometry) const;
  TrackingState follow_to(const PlaceMap& map, const Surroundings& around, const Pose2* odometry,
                          const Predictions& predictions);
  static Placed fit_from(const PlaceMap& map, const Surroundings& around, const Pose2& start,
                         const Predicted& predicted, const Predictions& predictions);
  Placed place(const PlaceMap& map, const Surroundings& around, const Predictions& predictions) const;
  void update(const PlaceMap& map, const Surroundings& around, const Predictions& predictions,
              const Predicted& likeliest);
  TrackingState judge(double step_m);

  StepPredictor predictor_;
  Pose2 pose_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Identity();
  Fit fit_;
  PatchVerdict verdict_;
  double slide_m_ = 0.0, doubtful_m_ = 0.0;
  std::uint32_t contradicted_ = 0;
  bool has_followed_ = false;  // a scan since base was said to stand there
};

}  // namespace pose_wall::planar

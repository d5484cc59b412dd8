// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The data of one frame, from stage to stage.

#pragma once

#include "motion/along_match.hpp"
#include "motion/features.hpp"
#include "motion/machine_prior.hpp"
#include "motion/registration.hpp"
#include "motion/segmentation.hpp"
#include "motion/travel.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::motion {

struct Frame {
  explicit Frame(const pose_wall_cloud& taken) : cloud(taken) {}

  const pose_wall_cloud& cloud;
  double dt_s = 0.0;  // since the map's last scan was placed
  bool first = false;
  MachinePrior prior;
  Pose expected;
  Segments segments;
  FeatureCounts features;
  Span<Observation> observations;
  bool wide = false;  // it took a wide start
  Alignment alignment;
  Curve curve;
  double halves_m = -1.0;  // negative: not measured
  bool guessed = false;    // the way along is a guess that is better than the last speed
  double slip_m = 0.0;     // the unknown way along since the last frame, beyond sigma
  std::uint32_t reasons = 0, state = POSE_WALL_ALONG_MEASURED;
  double step_s = 0.0;  // since the last frame that had a pose
  Eigen::Vector3d step_m = Eigen::Vector3d::Zero(), step_rad = Eigen::Vector3d::Zero();
  Six step_variance = Six::Zero();  // by the patches of rock alone
  Bounds step, whole;

  bool is(std::uint32_t along_state) const { return state == along_state; }
  bool has_stamp() const { return (reasons & POSE_WALL_MOTION_R_STAMP) == 0; }
};

}  // namespace pose_wall::motion

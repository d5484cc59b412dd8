// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/scan_motion.hpp"

#include <cmath>

namespace pose_wall::motion {

void ScanMotion::forget(double speed_most_m_s, double turn_most_rad_s) {
  *this = ScanMotion{};
  limit_ << speed_most_m_s, speed_most_m_s, speed_most_m_s, turn_most_rad_s, turn_most_rad_s, turn_most_rad_s;
}

// A steady motion is not in the change of the measured rates, so half of its square is noise. A change beyond noise is
// a motion that began or ended, and hides none later. What was told wrongly stays in the level for long all the same: a
// bad alignment is followed by others.
void ScanMotion::learn(const Six& seen, const Six& variance, double tells) {
  const Six rate = frames_ > 0.0 ? Six(measured_ + tells * (seen - measured_)) : seen;
  changed_ = rate - rate_;
  if (frames_ > 0.0) {
    frames_ = frames_ < kFramesMost ? frames_ + 1.0 : kFramesMost;
    const Six scatter = rate - measured_;
    const Six most = limit_of<gate::MOVES>() * noise_.cwiseMax(kLeastOfAlignment * variance);
    noise_ += ((0.5 * scatter.cwiseProduct(scatter)).cwiseMin(most) - noise_) / frames_;
    variance_ += (changed_.cwiseProduct(changed_) - variance_) / frames_;
  } else {
    frames_ = kFramesOfAlignment;
    noise_ = variance_ = variance;
  }
  measured_ = rate;
  limit_.setZero();
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    rate_[k] = passes_of<gate::MOVES>(rate[k] * rate[k], noise_[k]) ? rate[k] : 0.0;
  }
}

void ScanMotion::set_along(double rate_m_s, double unknown_m_s) {
  rate_[POSE_WALL_MOTION_ALONG] = rate_m_s;
  changed_[POSE_WALL_MOTION_ALONG] = 0.0;
  limit_[POSE_WALL_MOTION_ALONG] = unknown_m_s;
}

// The engine adds levels to its own as errors that do not depend on each other. A limit may be reached every time, so
// it counts twice; along it counts in full there.
Six ScanMotion::level(double factor) const {
  Six level;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    level[k] = 2.0 * limit_[k] + std::sqrt(factor * factor * variance_[k] + changed_[k] * changed_[k]);
  }
  return level;
}

}  // namespace pose_wall::motion

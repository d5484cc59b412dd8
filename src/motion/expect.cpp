// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/expect.hpp"

#include <cmath>

namespace pose_wall::motion {
namespace {

// The last motion is a guess for so long. A machine that stops from 2 m/s is then 2 m off, and curves side by side
// reach 2.8 m (far_match). From 0.3 to 5 s the sweep measured the same frames.
constexpr double kTwistLasts_s = 1.0;
constexpr double kNoTurn2 = 1e-10;  // (rad/s)²: keeps a turn of nothing from being divided by nothing

// A motion of base in the directions of the road, and back.
Six in_road(const Pose& pose, const RoadAxes& axes, const Twist& twist) {
  const Eigen::Vector3d* const about[] = {&axes.along, &axes.left, &axes.up};
  const Eigen::Vector3d move = pose.R * twist.velocity_m_s, turn = pose.R * twist.turn_rad_s;
  Six rate;
  for (int k = 0; k < 3; ++k) {
    rate[k] = about[k]->dot(move);
    rate[POSE_WALL_MOTION_ROLL + k] = about[k]->dot(turn);
  }
  return rate;
}

Twist in_base(const Pose& pose, const RoadAxes& axes, const Six& rate) {
  const Eigen::Vector3d* const about[] = {&axes.along, &axes.left, &axes.up};
  Eigen::Vector3d move = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    move += *about[k] * rate[k];
    turn += *about[k] * rate[POSE_WALL_MOTION_ROLL + k];
  }
  return {pose.R.transpose() * move, pose.R.transpose() * turn};
}

// The turns, each as far as it exceeds its own noise. A few rings of ground give pitch to 0.1 degrees, and ten times
// that a second would bend the next scan.
Six shrunk_turn(const Six& rate, const Six& noise) {
  Six out = Six::Zero();
  for (int k = POSE_WALL_MOTION_ROLL; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    const double turn2 = rate[k] * rate[k];
    out[k] = rate[k] * turn2 / (turn2 + noise[k] * noise[k] + kNoTurn2);
  }
  return out;
}

}  // namespace

void MotionModel::reset(const MotionSettings& settings) {
  forget_twist();
  forget_rates(settings);
  usual_s_ = 0.0;
}

void MotionModel::forget_rates(const MotionSettings& settings) {
  scan_motion_.forget(settings.speed_max_m_s, settings.turn_max_rad_s);
}

Expected MotionModel::expect(const Course& last, const MotionSettings& settings, const Frame& frame) const {
  Expected out;
  out.prior = ask_machine(frame.cloud.inputs, frame.dt_s);
  if (!out.prior.sound) out.reasons = POSE_WALL_MOTION_R_PRIOR;
  // The duration of a twist is unknown.
  const double lasts_s = frame.dt_s < kTwistLasts_s ? frame.dt_s : kTwistLasts_s;
  Eigen::Vector3d step_m = twist_.velocity_m_s * lasts_s, step_rad = twist_.turn_rad_s * lasts_s;
  if (out.prior.has_way()) {
    step_m += (out.prior.way_m - settings.forward_base.dot(step_m)) * settings.forward_base;
  }
  if (out.prior.has_turn()) step_rad.z() = out.prior.turn_rad;
  out.pose.t = last.pose.t + last.pose.R * step_m;
  out.pose.R = orthonormal(last.pose.R * turn_by(step_rad));
  return out;
}

// The alignments err by as much after a short step, so the variances of rates go with its inverse square. Stamps that
// jitter may bring two frames together that are a scan apart. Then a standing machine seems to whirl.
double MotionModel::tells(double dt_s) {
  constexpr double kShare = 0.25;           // of the last step in the mean: a new rate of frames is usual after some
  if (!(dt_s < kTwistLasts_s)) return 1.0;  // a gap is no usual step
  usual_s_ = usual_s_ > 0.0 ? usual_s_ + kShare * (dt_s - usual_s_) : dt_s;
  const double known = 2.0 * dt_s * dt_s / (dt_s * dt_s + usual_s_ * usual_s_);
  return known < 1.0 ? known : 1.0;
}

void MotionModel::learn(const Course& last, const RoadAxes& axes, const MotionSettings& settings,
                        const MotionStep& step, double dt_s) {
  const double known = tells(dt_s);
  Twist now = {step.m / dt_s, step.rad / dt_s};
  if (!step.is_along_known) {
    const Eigen::Vector3d axis = last.pose.R.transpose() * axes.along;
    now.velocity_m_s += axis * axis.dot(twist_.velocity_m_s - now.velocity_m_s);
  }
  if (dt_s < kTwistLasts_s) {
    const Six rate = in_road(last.pose, axes, now);
    scan_motion_.learn(rate, step.variance / (dt_s * dt_s), known);
    if (!step.is_along_known) scan_motion_.set_along(rate[POSE_WALL_MOTION_ALONG], step.slip_m / dt_s);
    now.turn_rad_s = in_base(last.pose, axes, shrunk_turn(rate, step.bounds.sigma / dt_s)).turn_rad_s;
  } else {
    forget_rates(settings);
  }
  // Half of this frame's step: single steps are noisy, and machines are heavy.
  const double share = last.frames < 2 ? 1.0 : 0.5 * known;
  twist_.velocity_m_s += share * (now.velocity_m_s - twist_.velocity_m_s);
  twist_.turn_rad_s += share * (now.turn_rad_s - twist_.turn_rad_s);
}

Twist MotionModel::rates(const Course& now) const {
  return in_base(now.pose, now.axes, scan_motion_.rate());
}

}  // namespace pose_wall::motion

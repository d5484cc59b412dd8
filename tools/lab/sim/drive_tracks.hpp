// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How a machine on two tracks moves over ground that gives way, and what its odometry makes of it.
//
// The tracks follow their commands with a lag and a limited acceleration. On the ground each loses a share of its speed
// (slip), which depends on the place. To turn, the tracks scrape sideways: the machine turns as if they were
// turn_resistance times as far apart as they are (J. L. Martinez et al., "Approximating kinematics for tracked mobile
// robots", Int. J. Robotics Research 24(10), 2005: 1.3 to 2 on hard and loose ground), about a point that lies
// turn_ahead_m before its middle. Odometry knows the speeds of the tracks and takes mean values for all of this.
#pragma once

#include <cstdint>

#include "lab/sim/network.hpp"
#include "lab/sim/network_scan.hpp"

namespace pose_wall::tools::sim {

struct TrackSettings {
  double gauge_m = 0.9;  // between the middles of the tracks
  double track_m = 3.0;  // length on the ground
  double speed_max_mps = 1.0;
  double acceleration_mps2 = 0.6;
  double lag_s = 0.25;
  double slip = 0.04;  // mean share of the tracks' speed that is lost
  double slip_sigma = 0.015;
  double slip_length_m = 3.0;  // from good ground to bad
  double turn_resistance = 1.6;
  double turn_resistance_sigma = 0.12;
  double turn_ahead_m = 0.15;
  // What odometry takes for the means above, and how well the tracks' speeds are measured.
  double odometry_slip = 0.04;
  double odometry_turn_resistance = 1.6;
  double scale_sigma = 0.002;  // drawn once for each track
  double count_m = 0.002;      // a step of the tracks' counters
  // Yaw from a gyroscope in place of the tracks: 0 or 1.
  double gyroscope = 0.0;
  double gyroscope_bias_dps = 0.005;  // standard deviation of a constant
  double gyroscope_noise_dps = 0.05;  // of each step

  static TrackSettings without_slip();
};

struct TrackSpeeds {
  double left_mps = 0.0, right_mps = 0.0;
};

// The exact motion over a time at a constant turning rate: ahead and to the left, in the frame at its beginning.
PlanePose moved(const PlanePose& from, double ahead_mps, double left_mps, double turn_radps, double time_s);

class TrackDrive {
 public:
  // Without a network the ground is even and the same everywhere: only means count. The network must outlive it.
  TrackDrive(const TrackSettings& settings, const Network* network, const PlanePose& start, std::uint64_t seed);

  void step(const TrackSpeeds& command, double time_s);

  const PlanePose& truth() const { return truth_; }
  const PlanePose& odometry() const { return odometry_; }  // begins at the truth
  const TrackSpeeds& tracks() const { return tracks_; }
  double time_s() const { return time_s_; }
  double driven_m() const { return driven_m_; }  // by the middle of the machine, truly
  double turned_rad() const { return turned_rad_; }
  // As the tracks stand on the ground.
  double roll_rad() const { return roll_rad_; }
  double pitch_rad() const { return pitch_rad_; }
  double height_m() const { return height_m_; }

 private:
  double ground(const PlaneNoise& noise, double beside_m) const;
  void count(double time_s, double true_turn_radps);
  void stand();

  TrackSettings settings_;
  const Network* network_;
  PlaneNoise left_ground_, right_ground_, turn_ground_;
  Random random_;
  PlanePose truth_, odometry_;
  TrackSpeeds tracks_;
  double scale_left_, scale_right_, bias_radps_;
  double left_m_ = 0.0, right_m_ = 0.0;                  // of the tracks, truly
  double counted_left_m_ = 0.0, counted_right_m_ = 0.0;  // as far as odometry has them
  double time_s_ = 0.0, driven_m_ = 0.0, turned_rad_ = 0.0;
  double roll_rad_ = 0.0, pitch_rad_ = 0.0, height_m_ = 0.0;
};

}  // namespace pose_wall::tools::sim

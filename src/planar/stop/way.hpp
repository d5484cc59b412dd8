// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The way of base over the ground, and how well that is known between any two moments of the last minutes.
//
// From frame to frame base is reckoned by its speed. Where an odometry measured it, the way is corrected: its errors
// then no longer add up, since each place is known by itself.

#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/math/elementary.hpp"
#include "place/pose2.hpp"
#include "pose_wall.h"

namespace pose_wall::planar {

// Negative where the second was first; stamps may be any numbers.
inline double seconds_between(std::int64_t first_ns, std::int64_t second_ns) {
  return kNanosecond_s * (static_cast<double>(second_ns) - static_cast<double>(first_ns));
}

// What an odometry tells of the motion now.
struct MeasuredMotion {
  double speed_m_s = 0.0, turn_rad_s = 0.0;              // of base along forward, and to the left
  double speed_error_m_s = 0.0, turn_error_rad_s = 0.0;  // they hold the truth
  bool is_known = false;
};

class Way {
 public:
  struct Machine {
    double acceleration_m_s2;  // at most
    double lever_m;            // places are known so far around base
    double radius_m;           // the farthest corner
    double sigmas;             // of an odometry's variances in a bound
    Eigen::Vector2d forward;
  };

  void lay_out(Arena& arena);
  void open(const Machine& machine);
  // Nothing that was placed before compares with what follows.
  void forget();

  // A frame: base moved by `step` in the axes of the frame before, to within error_m at any place around it.
  void go(std::int64_t stamp_ns, std::uint32_t now_ms, const Pose2& step, double error_m);
  // An odometry for a frame that has gone, or for the next one. Others are of no use. False if it is none: a value out
  // of its range.
  bool note(const pose_wall_odometry& odometry, std::int64_t stamp_ns);

  const Pose2& base() const { return base_; }
  // By how much a place seen at one moment may be elsewhere at a later one, at most. Infinite where that is not known.
  float error_m(std::uint32_t first_ms, std::uint32_t second_ms) const;
  // The same until now.
  float error_m(std::uint32_t first_ms) const;

  // Speed and turn over that part of the last second that tells most.
  MeasuredMotion motion(std::int64_t now_ns) const;

 private:
  static constexpr std::uint32_t kFrames = 32;  // frames that an odometry may be for, and that tell the speed
  // A moment of the way, in steps of kBucket_ms: longer than the longest memory.
  static constexpr std::uint32_t kBuckets = 4096, kBucket_ms = 256;

  // What an error adds up from: places, and turns by the lever.
  struct Certainty {
    double variance_m2 = 0.0, variance_rad2 = 0.0;  // never fall
    double drift_m = 0.0;                           // likewise, with that of turns
    double own_m = 0.0;                             // of the moment by itself
  };
  struct Bucket {
    Certainty first;  // but own_m: the most
    std::uint32_t number;
    mutable std::uint32_t known_ms;  // error_m holds until this moment
    mutable float error_m;
  };
  // An odometry's place, and what its errors are: of this frame by itself, and since its run began.
  struct Place {
    std::uint64_t run = 0;  // 0: none
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    double level_m = 0.0, level_rad = 0.0, variance_m2 = 0.0, variance_rad2 = 0.0, drift_m = 0.0, drift_rad = 0.0;
  };
  struct Frame {
    std::int64_t stamp_ns;
    Pose2 base;
    double reckoned_m;  // errors of reckoning until then
    Place place;
  };

  static bool read(const pose_wall_odometry& odometry, Place* place);
  double error_of(const Certainty& first, const Certainty& second) const;
  Certainty certainty_of(const Place& place) const;
  void measure(std::uint32_t frame, const Place& place);
  void leave_odometry();
  void remember();
  MeasuredMotion motion_since(const Frame& before, const Frame& last, double age_s) const;

  Machine machine_{};
  Span<Frame> frames_;
  Span<Bucket> buckets_;
  std::uint32_t count_ = 0;     // of frames since all was forgotten; the newest is the last
  std::uint32_t measured_ = 0;  // count at the newest frame that an odometry measured, with it; 0: none
  std::uint32_t now_ms_ = 0;
  Pose2 base_;
  Certainty now_;
  double reckoned_m_ = 0.0;
  Place waiting_;  // for the next frame
  std::int64_t waiting_ns_ = 0;
};

}  // namespace pose_wall::planar

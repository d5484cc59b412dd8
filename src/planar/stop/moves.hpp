// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the machine does and may do: what was given, and what an odometry tells, as the sweep and the way take it.

#pragma once

#include <cstdint>

#include "lidar/mount.hpp"
#include "planar/stop/settings.hpp"
#include "planar/stop/sweep.hpp"
#include "planar/stop/way.hpp"

namespace pose_wall::planar {

class Moves {
 public:
  void lay_out(Arena& arena) { way_.lay_out(arena); }
  // radius_m: of the footprint. sigmas: of an odometry's variances in a bound.
  void open(const StopSettings& settings, const Mount& mount, double radius_m, double sigmas);
  void forget();
  bool note(const pose_wall_odometry& odometry, std::int64_t stamp_ns) { return way_.note(odometry, stamp_ns); }

  // The motion of a frame. What was measured is the caller's, or else the odometry's.
  void take(const pose_wall_planar_stop_motion& given, std::int64_t stamp_ns);
  // Base has gone on to this frame since the last one.
  void go(std::int64_t stamp_ns, std::uint32_t now_ms, double seconds);

  bool is_known() const { return now_.is_known; }
  // What was measured, or NaN.
  void tell(pose_wall_planar_stop_result* result) const;
  SweepMotion sweep() const;
  // Speed of the footprint's fastest point, and the error that a reading of it is forgiven: the settings' alone.
  double rim_m_s() const;
  double rim_error_m_s(double rim_m_s) const;
  const Way& way() const { return way_; }

 private:
  enum Kind { kMeasured, kCommanded, kKinds };
  // In speeds along forward and turns, with errors of the measured one beside the settings' share.
  struct Motion {
    double speed_m_s[kKinds], turn_rad_s[kKinds];
    double speed_error_m_s, turn_error_rad_s;
    bool given[kKinds], is_known;
    bool may_stand;  // the measured motion is none but for its errors
  };
  void lag_behind(double seconds);
  static bool is_sound(double speed_m_s, double turn_rad_s);
  static bool moves(const Motion& motion, int kind);
  double rim_of(double speed_m_s, double turn_rad_s) const;

  StopSettings settings_;
  Eigen::Vector2d forward_;
  double radius_m_ = 1.0;
  Way way_;
  Motion now_{}, last_{};
  // Between these the machine may be that is told its speed: of its fastest point. So long it has not got there.
  double fast_m_s_ = 0.0, slow_m_s_ = 0.0, changing_s_ = 0.0;
};

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// One frame: floor, sight, places, sweep, verdict.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "lidar/seen_clouds.hpp"
#include "planar/stop/moves.hpp"
#include "planar/stop/places.hpp"
#include "planar/stop/settings.hpp"
#include "planar/stop/sight.hpp"
#include "planar/stop/sweep.hpp"

namespace pose_wall::planar {

class Stop {
 public:
  void lay_out(Arena& arena);
  // sigmas: of an odometry's variances in a bound. settings_crc32: of settings and config, for the results.
  void open(const StopSettings& settings, const Mount& mount, double sigmas, std::uint32_t settings_crc32);
  void reset();
  void confirm();
  bool note(const pose_wall_odometry& odometry, std::int64_t stamp_ns) { return moves_.note(odometry, stamp_ns); }
  void process(const pose_wall_cloud& cloud, const pose_wall_planar_stop_motion& motion, std::int64_t now_ns,
               pose_wall_planar_stop_result* result);
  void tick(std::int64_t now_ns, pose_wall_planar_stop_result* result);

 private:
  void forget();
  std::uint32_t heed_clock(std::int64_t now_ns);
  void heed_stamp(std::int64_t stamp_ns);
  std::uint32_t frame_reasons(const pose_wall_cloud& cloud, std::int64_t now_ns);
  void see(const Ground& ground, pose_wall_planar_stop_result* result);
  void judge(const SweepMotion& sweep_motion, pose_wall_planar_stop_result* result);
  void tell_nearest(const Hazard& hazard, pose_wall_planar_stop_result* result) const;
  void decide(std::uint32_t fatal, std::int64_t now_ns, pose_wall_planar_stop_result* result);
  pose_wall_planar_stop_result begun(std::int64_t now_ns) const;

  StopSettings settings_;
  Mount mount_;
  Sight sight_;
  Places places_;
  Sweep sweep_;
  Span<Hazard> hazards_;
  FloorLooks* looks_;
  CloudPrint* print_;

  Moves moves_;
  std::int64_t first_ns_, last_ns_, clear_since_ns_;
  RepeatGuard repeat_guard_;
  std::uint64_t frames_;
  std::uint32_t now_ms_, heartbeat_, settings_crc32_;
  bool is_stopped_, is_clear_;
  std::int64_t now_ns_, back_ns_;    // the latest time of a call; the frame before, where its stamp went back
  std::uint32_t clock_stood_calls_;  // in a row that did not bring a later time
  bool has_now_, went_back_;
  pose_wall_planar_stop_result last_;
};

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/tracker.hpp"

namespace pose_wall::planar::route {
namespace {

struct Row {
  double pose_wall_planar_track_settings::*member;
  double least, most;
  pose_wall_planar_fault fault;
};

#define ROW(member, least, most, text)                       \
  {                                                          \
    &pose_wall_planar_track_settings::member, least, most, { \
#member, #member " must be from " text                 \
    }                                                        \
  }

constexpr Row kRows[] = {
    ROW(speed_max_m_s, 0.02, 5.0, "0.02 to 5"),
    ROW(speed_min_m_s, 0.01, 5.0, "0.01 to speed_max_m_s"),
    ROW(speed_change_m_s2, 0.02, 5.0, "0.02 to 5"),
    ROW(turn_max_rad_s, 0.02, 3.0, "0.02 to 3"),
    ROW(turn_change_rad_s2, 0.05, 20.0, "0.05 to 20"),
    ROW(track_distance_m, 0.2, 10.0, "0.2 to 10"),
    ROW(settle_m, 0.5, 20.0, "0.5 to 20"),
    ROW(delay_s, 0.0, 1.0, "0 to 1"),
    ROW(lag_s, 0.0, 1.0, "0 to 1"),
    ROW(half_width_m, 0.0, 20.0, "0 to 20"),
    ROW(slow_below_m, 0.0, 10.0, "0 to 10"),
    ROW(stop_within_m, 0.005, 1.0, "0.005 to 1"),
    ROW(stop_within_rad, 0.002, 0.5, "0.002 to 0.5"),
    ROW(off_path_m, 0.05, 10.0, "0.05 to 10"),
    ROW(off_path_rad, 0.05, 1.5, "0.05 to 1.5"),
    ROW(pose_level_max_m, 0.001, 100.0, "0.001 to 100"),
    ROW(pose_age_max_s, 0.02, 10.0, "0.02 to 10"),
};
#undef ROW

constexpr pose_wall_planar_fault kPath = {"path_max", "path_max must be from 2 to 1000000"};
constexpr pose_wall_planar_fault kSlowest = {"speed_min_m_s", "speed_min_m_s must be from 0.01 to speed_max_m_s"};

}  // namespace

const pose_wall_planar_fault* fault_of(const pose_wall_planar_track_settings& settings) {
  if (!(settings.path_max >= 2 && settings.path_max <= 1000000)) return &kPath;
  for (const Row& row : kRows) {
    const double value = settings.*row.member;
    if (!(value >= row.least && value <= row.most)) return &row.fault;
  }
  return settings.speed_min_m_s <= settings.speed_max_m_s ? nullptr : &kSlowest;
}

}  // namespace pose_wall::planar::route

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/settings.hpp"

#include <cstddef>
#include <cstring>

#include "part/struct_sizes.hpp"

namespace pose_wall::planar {
namespace {

// One member, its range, and the rule in words.
struct Row {
  std::size_t offset;
  double least, most;
  pose_wall_planar_fault fault;
};

#define POSE_WALL_STOP_ROW(member, least, most)             \
  {                                                         \
    offsetof(StopSettings, member), least, most, {          \
#member, #member " must be from " #least " to " #most \
    }                                                       \
  }

constexpr Row kRows[] = {POSE_WALL_STOP_ROW(floor_z_m, -10, 10),
                         POSE_WALL_STOP_ROW(top_m, 0.5, 6),
                         POSE_WALL_STOP_ROW(tall_m, 0.5, 2),
                         POSE_WALL_STOP_ROW(thing_height_m, 0.1, 1),
                         POSE_WALL_STOP_ROW(thing_width_m, 0.2, 1),
                         POSE_WALL_STOP_ROW(floor_band_m, 0.03, 0.5),
                         POSE_WALL_STOP_ROW(slope_max_rad, 0, 0.35),
                         POSE_WALL_STOP_ROW(kink_max_rad, 0.01, 0.35),
                         POSE_WALL_STOP_ROW(speed_max_m_s, 0.05, 3),
                         POSE_WALL_STOP_ROW(turn_max_rad_s, 0.01, 2),
                         POSE_WALL_STOP_ROW(deceleration_m_s2, 0.1, 10),
                         POSE_WALL_STOP_ROW(latency_s, 0, 2),
                         POSE_WALL_STOP_ROW(stale_s, 0.02, 1),
                         POSE_WALL_STOP_ROW(scan_s, 0, 0.5),
                         POSE_WALL_STOP_ROW(delay_s, 0.1, 2),
                         POSE_WALL_STOP_ROW(slack_s, 0, 2),
                         POSE_WALL_STOP_ROW(restart_s, 0, 60),
                         POSE_WALL_STOP_ROW(restart_speed_m_s, 0.01, 1),
                         POSE_WALL_STOP_ROW(approach_m_s, 0, 3),
                         POSE_WALL_STOP_ROW(settle_s, 0.2, 60),
                         POSE_WALL_STOP_ROW(creep_m_s, 0, 0.3),
                         POSE_WALL_STOP_ROW(memory_s, 0.1, 600),
                         POSE_WALL_STOP_ROW(drift_max_m, 0.02, 0.5),
                         POSE_WALL_STOP_ROW(confirm_m, 0, 3),
                         POSE_WALL_STOP_ROW(protection_m, 0.02, 1),
                         POSE_WALL_STOP_ROW(speed_error_ratio, 0, 0.5),
                         POSE_WALL_STOP_ROW(speed_error_m_s, 0, 0.5),
                         POSE_WALL_STOP_ROW(turn_error_rad_s, 0, 0.5)};
#undef POSE_WALL_STOP_ROW

double member_of(const StopSettings& settings, std::size_t offset) {
  double value;
  std::memcpy(&value, reinterpret_cast<const unsigned char*>(&settings) + offset, sizeof(value));
  return value;
}

// Counter-clockwise, strictly convex around base, within reach, and with no short edge.
bool is_footprint(const StopSettings& s) {
  constexpr double kFarthest_m = 5.0, kShortest_m = 0.1;  // the places around the machine reach 8 m
  if (!(s.corners >= 3 && s.corners <= POSE_WALL_PLANAR_STOP_CORNERS_MAX)) return false;
  for (std::uint32_t k = 0; k < s.corners; ++k) {
    const double *a = s.corner_m[k], *b = s.corner_m[(k + 1) % s.corners], *c = s.corner_m[(k + 2) % s.corners];
    const double ex = b[0] - a[0], ey = b[1] - a[1], length2 = ex * ex + ey * ey;
    const bool is_near = a[0] * a[0] + a[1] * a[1] <= kFarthest_m * kFarthest_m;
    const bool turns_left = ex * (c[1] - b[1]) - ey * (c[0] - b[0]) > 1e-6;
    const bool holds_base = ex * -a[1] - ey * -a[0] > 1e-6;
    if (!(is_near && turns_left && holds_base && length2 >= kShortest_m * kShortest_m)) return false;
  }
  return true;
}

std::int32_t refuse(pose_wall_planar_fault* fault, const char* member, const char* rule) {
  if (fault != nullptr) {
    fault->member = member;
    fault->rule = rule;
  }
  return POSE_WALL_E_VALUE_RANGE;
}

}  // namespace

StopSettings default_stop_settings() {
  StopSettings s{};
  s.struct_size = sizeof(s);
  set_rectangle(&s, -2.25, 2.25, -0.6, 0.6);
  s.floor_z_m = 0.0, s.top_m = 1.8, s.tall_m = 1.4;
  s.thing_height_m = 0.3, s.thing_width_m = 0.3, s.floor_band_m = 0.13;
  s.slope_max_rad = 0.12, s.kink_max_rad = 0.08;
  s.speed_max_m_s = 1.0, s.turn_max_rad_s = 0.4, s.deceleration_m_s2 = 1.0;
  s.latency_s = 0.2, s.stale_s = 0.25, s.scan_s = 0.1, s.delay_s = 0.3, s.slack_s = 0.35;
  s.restart_s = 1.0, s.restart_speed_m_s = 0.08;
  s.approach_m_s = 1.6, s.settle_s = 2.0, s.creep_m_s = 0.1;
  s.memory_s = 60.0, s.drift_max_m = 0.3, s.confirm_m = 2.5, s.protection_m = 0.1;
  s.speed_error_ratio = 0.03, s.speed_error_m_s = 0.002, s.turn_error_rad_s = 0.002;
  return s;
}

void set_rectangle(StopSettings* s, double x_min_m, double x_max_m, double y_min_m, double y_max_m) {
  const double corners_m[4][2] = {{x_min_m, y_min_m}, {x_max_m, y_min_m}, {x_max_m, y_max_m}, {x_min_m, y_max_m}};
  s->corners = 4;
  for (std::uint32_t k = 0; k < POSE_WALL_PLANAR_STOP_CORNERS_MAX; ++k) {
    for (int axis = 0; axis < 2; ++axis) s->corner_m[k][axis] = k < 4 ? corners_m[k][axis] : 0.0;
  }
}

std::int32_t check_stop_settings(const StopSettings& settings, pose_wall_planar_fault* fault) {
  if (const std::int32_t size = pose_wall::check_struct(settings); size != POSE_WALL_OK) return size;
  if (!is_footprint(settings)) {
    return refuse(fault, "corner_m", "corner_m must be 3 to 12 corners within 5 m, convex and counter-clockwise");
  }
  for (const Row& row : kRows) {
    const double value = member_of(settings, row.offset);
    if (!(value >= row.least && value <= row.most)) return refuse(fault, row.fault.member, row.fault.rule);
  }
  constexpr double kBandLeast_m = 0.05;  // between floor and thing: rays in it show that a place is free
  if (!(settings.thing_height_m - settings.floor_band_m >= kBandLeast_m)) {
    return refuse(fault, "floor_band_m", "floor_band_m must be 0.05 below thing_height_m");
  }
  if (!(settings.tall_m >= settings.thing_height_m && settings.top_m >= settings.tall_m)) {
    return refuse(fault, "tall_m", "tall_m must be from thing_height_m to top_m");
  }
  return POSE_WALL_OK;
}

}  // namespace pose_wall::planar

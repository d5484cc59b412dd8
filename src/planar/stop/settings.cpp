// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/settings.hpp"

namespace pose_wall::planar {
namespace {

constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_stop_settings, __VA_ARGS__)
#include "pose_wall_planar_stop_settings.def"
};

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

}  // namespace

SettingRows StopTable::rows() {
  return rows_of(kRows);
}

void set_rectangle(StopSettings* s, double x_min_m, double x_max_m, double y_min_m, double y_max_m) {
  const double corners_m[4][2] = {{x_min_m, y_min_m}, {x_max_m, y_min_m}, {x_max_m, y_max_m}, {x_min_m, y_max_m}};
  s->corners = 4;
  for (std::uint32_t k = 0; k < POSE_WALL_PLANAR_STOP_CORNERS_MAX; ++k) {
    for (int axis = 0; axis < 2; ++axis) s->corner_m[k][axis] = k < 4 ? corners_m[k][axis] : 0.0;
  }
}

void StopTable::set_others() {
  set_rectangle(this, -2.25, 2.25, -0.6, 0.6);  // the roadheader's 4.5 x 1.2 m
}

// Constants of their own: a pair that is made here lies in memory that could be written to (GCC 12.2, ARMv7).
constexpr SettingFault kFootprint = {"corner_m",
                                     "corner_m must be 3 to 12 corners within 5 m, convex and counter-clockwise"};
constexpr SettingFault kBand = {"floor_band_m", "floor_band_m must be 0.05 below thing_height_m"};
constexpr SettingFault kTall = {"tall_m", "tall_m must be from thing_height_m to top_m"};

SettingFault StopTable::broken_rule() const {
  if (!is_footprint(*this)) return kFootprint;
  constexpr double kBandLeast_m = 0.05;  // between floor and thing: rays in it show that a place is free
  if (!(thing_height_m - floor_band_m >= kBandLeast_m)) return kBand;
  if (!(tall_m >= thing_height_m && top_m >= tall_m)) return kTall;
  return {};
}

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/skew.hpp"

#include "base/math/finite.hpp"
#include "lidar/cloud_reader.hpp"

namespace pose_wall {
namespace {

struct Times {
  double first = 0.0, last = 0.0;
  bool any = false;
};

Times times_of(const pose_wall_cloud& cloud, bool swap) {
  Times times;
  for (std::uint32_t row = 0; row < rows_of(cloud); ++row) {
    const unsigned char* point = row_of(cloud, row);
    for (std::uint32_t column = 0; column < cloud.width; ++column, point += cloud.point_step) {
      const double time = read_number(point, cloud.time, swap);
      if (!is_finite(time)) continue;
      if (!times.any || time < times.first) times.first = time;
      if (!times.any || time > times.last) times.last = time;
      times.any = true;
    }
  }
  return times;
}

}  // namespace

Skew::Skew(const pose_wall_cloud& cloud, const pose_wall_odometry* odometry) : cloud_(cloud), swap_(needs_swap(cloud)) {
  if (odometry == nullptr || cloud.time.type == POSE_WALL_FIELD_NONE) return;
  const Times times = times_of(cloud, swap_);
  unit_s_ = time_unit_s(times.last - times.first);
  zero_ = time_of_stamp(times.first, times.last, unit_s_);
  scan_s_ = (times.last - zero_) * unit_s_;
  for (int k = 0; k < 3; ++k) {
    velocity_[k] = static_cast<float>(odometry->velocity_m_s[k]);
    turn_[k] = static_cast<float>(odometry->turn_rate_rad_s[k]);
  }
}

float Skew::seconds(const unsigned char* point) const {
  const double time = read_number(point, cloud_.time, swap_);
  return is_finite(time) ? static_cast<float>((time - zero_) * unit_s_) : 0.0F;
}

FourPlaces Skew::taken_out(const FourPlaces& base, FourFloats time_s) const {
  const FourPlaces around = turned(base);
  const FourPlaces speed = {around.x + velocity_[0], around.y + velocity_[1], around.z + velocity_[2]};
  const FourPlaces bend = turned(speed);
  const FourFloats half_s2 = 0.5F * time_s * time_s;
  return {base.x + time_s * speed.x + half_s2 * bend.x, base.y + time_s * speed.y + half_s2 * bend.y,
          base.z + time_s * speed.z + half_s2 * bend.z};
}

}  // namespace pose_wall

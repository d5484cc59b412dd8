// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/rays.hpp"

namespace pose_wall::planar {

Rays::Rays(const pose_wall_cloud& cloud, const Mount& mount)
    : cloud_(cloud),
      reader_(cloud),
      points_(static_cast<std::uint64_t>(cloud.width) * rows_of(cloud)),
      near2_(static_cast<float>(mount.range_min_m * mount.range_min_m)),
      far2_(static_cast<float>(mount.range_max_m * mount.range_max_m)),
      body_(mount.body, cloud, mount.sensor_base_m) {
  for (int k = 0; k < 9; ++k) R_[k] = static_cast<float>(mount.R_base_lidar(k / 3, k % 3));
}

bool Rays::one(std::uint64_t index, float* x, float* y, float* z) const {
  const FourPlaces raw = reader_.four_of_row(point_at(index), 1);
  FourTruths those = first_of_four(1) & are_in_range(raw);
  const FourPlaces at = in_base(raw, &those);
  *x = at.x[0], *y = at.y[0], *z = at.z[0];
  return those[0] != 0;
}

}  // namespace pose_wall::planar

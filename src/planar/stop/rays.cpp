// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/rays.hpp"

namespace pose_wall::planar {
Rays::Rays(const pose_wall_cloud& cloud, const Mount& mount)
    : cloud_(cloud),
      swap_(needs_swap(cloud)),
      plain_(is_plain_xyz32(cloud)),
      points_(static_cast<std::uint64_t>(cloud.width) * rows_of(cloud)),
      near2_(static_cast<float>(mount.range_min_m * mount.range_min_m)),
      far2_(static_cast<float>(mount.range_max_m * mount.range_max_m)) {
  for (int k = 0; k < 9; ++k) R_[k] = static_cast<float>(mount.R_base_lidar(k / 3, k % 3));
  for (const Box& box : BodyBoxes(mount.body, cloud)) {
    const double edges[6] = {box.x_min, box.x_max, box.y_min, box.y_max, box.z_min, box.z_max};
    for (int k = 0; k < 6; ++k) body_[boxes_][k] = static_cast<float>(edges[k] - mount.sensor_base_m(k / 2));
    ++boxes_;
  }
}

FourPlaces Rays::four_of(const unsigned char* point, std::uint32_t left) const {
  FourPlaces p{};
  for (std::uint32_t lane = 0; lane < kFour && lane < left; ++lane) {
    const unsigned char* const at = point + std::size_t{lane} * cloud_.point_step;
    p.x[lane] = number(at, cloud_.x);
    p.y[lane] = number(at, cloud_.y);
    p.z[lane] = number(at, cloud_.z);
  }
  return p;
}

bool Rays::one(std::uint64_t index, float* x, float* y, float* z) const {
  const FourPlaces raw = four_of(point_at(index), 1);
  FourTruths those = first_of_four(1) & are_in_range(raw);
  const FourPlaces at = in_base(raw, &those);
  *x = at.x[0], *y = at.y[0], *z = at.z[0];
  return those[0] != 0;
}

}  // namespace pose_wall::planar

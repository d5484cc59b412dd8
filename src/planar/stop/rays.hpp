// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The returns of a cloud, four at a time, about the sensor and in the axes of base.

#pragma once

#include <cstdint>

#include "base/simd/four_floats.hpp"
#include "lidar/body_boxes.hpp"
#include "lidar/mount.hpp"
#include "lidar/point_reader.hpp"

namespace pose_wall::planar {

class Rays {
 public:
  Rays(const pose_wall_cloud& cloud, const Mount& mount)
      : cloud_(cloud),
        reader_(cloud),
        points_(static_cast<std::uint64_t>(cloud.width) * rows_of(cloud)),
        near2_(static_cast<float>(mount.range_min_m * mount.range_min_m)),
        far2_(static_cast<float>(mount.range_max_m * mount.range_max_m)),
        body_(mount.body, cloud, mount.sensor_base_m) {
    for (int k = 0; k < 9; ++k) R_[k] = static_cast<float>(mount.R_base_lidar(k / 3, k % 3));
  }

  std::uint64_t points() const { return points_; }

  // visit(raw, returns, x, y, fall, those). Raw points are as the cloud has them, returns are those in range. The
  // others are about the sensor in base's axes; fall is how far they lie below a plane through it with these slopes.
  // Those are the returns that are not of the machine.
  template <typename Visit>
  void each_four(float slope_x, float slope_y, const Visit& visit) const {
    float fall[3];
    for (int k = 0; k < 3; ++k) fall[k] = slope_x * R_[k] + slope_y * R_[3 + k] - R_[6 + k];
    for (std::uint32_t row = 0; row < rows_of(cloud_); ++row) {
      const unsigned char* point = row_of(cloud_, row);
      for (std::uint32_t k = 0; k < cloud_.width; k += kFour) {
        const std::uint32_t left = cloud_.width - k;
        const FourPlaces raw = reader_.four_of_row(point, left);
        const FourTruths returns = first_of_four(left) & are_in_range(raw);
        FourTruths those = returns;
        const FourPlaces at = in_base(raw, &those);
        visit(raw, returns, at.x, at.y, fall[0] * raw.x + fall[1] * raw.y + fall[2] * raw.z, those);
        point += std::size_t{kFour} * cloud_.point_step;
      }
    }
  }

  // One point, by its number: false if it is no return.
  bool one(std::uint64_t index, float* x, float* y, float* z) const {
    const FourPlaces raw = reader_.four_of_row(point_at(index), 1);
    FourTruths those = first_of_four(1) & are_in_range(raw);
    const FourPlaces at = in_base(raw, &those);
    *x = at.x[0], *y = at.y[0], *z = at.z[0];
    return those[0] != 0;
  }

 private:
  const unsigned char* point_at(std::uint64_t index) const {
    return row_of(cloud_, static_cast<std::uint32_t>(index / cloud_.width)) +
           (index % cloud_.width) * cloud_.point_step;
  }

  FourTruths are_in_range(const FourPlaces& p) const {
    const FourFloats r2 = p.x * p.x + p.y * p.y + p.z * p.z;
    return (r2 >= near2_) & (r2 <= far2_);
  }

  FourPlaces in_base(const FourPlaces& p, FourTruths* those) const {
    const FourPlaces at = {R_[0] * p.x + R_[1] * p.y + R_[2] * p.z, R_[3] * p.x + R_[4] * p.y + R_[5] * p.z,
                           R_[6] * p.x + R_[7] * p.y + R_[8] * p.z};
    *those &= ~body_.hold(at);
    return at;
  }

  const pose_wall_cloud& cloud_;
  PointReader reader_;
  std::uint64_t points_;
  float R_[9];
  float near2_, far2_;
  BodyBoxes body_;  // about the sensor
};

}  // namespace pose_wall::planar

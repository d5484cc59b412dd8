// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// x, y and z of a cloud's points as floats, the common layouts without a switch a field.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/simd/four_floats.hpp"
#include "lidar/cloud_reader.hpp"

namespace pose_wall {

class PointReader {
 public:
  explicit PointReader(const pose_wall_cloud& cloud)
      : cloud_(cloud), swap_(needs_swap(cloud)), plain_(is_plain_xyz32(cloud)), in_a_row_(is_xyz32_in_a_row(cloud)) {}

  bool swap() const { return swap_; }

  void one(const unsigned char* point, float* x, float* y, float* z) const {
    *x = coordinate(point, cloud_.x), *y = coordinate(point, cloud_.y), *z = coordinate(point, cloud_.z);
  }

  // Four points that may lie anywhere.
  FourPlaces four(const unsigned char* const* points) const {
    if (in_a_row_) return plain_four(points, cloud_.x.offset);
    FourPlaces four;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) put(points[lane], lane, &four);
    return four;
  }

  // Four side by side; beyond the first `count` of them zero.
  FourPlaces four_of_row(const unsigned char* point, std::uint32_t count) const {
    if (in_a_row_ && count >= kFour) return plain_four(point + cloud_.x.offset, cloud_.point_step);
    FourPlaces four{};
    for (std::uint32_t lane = 0; lane < kFour && lane < count; ++lane) {
      put(point + std::size_t{lane} * cloud_.point_step, lane, &four);
    }
    return four;
  }

  // `count` of them side by side.
  void row(const unsigned char* point, std::uint32_t count, float* x, float* y, float* z) const {
    const std::size_t step = cloud_.point_step;
    std::uint32_t k = 0;
    for (; in_a_row_ && k + kFour <= count; k += kFour, point += kFour * step) {
      const FourPlaces four = plain_four(point + cloud_.x.offset, step);
      store_four(four.x, &x[k]);
      store_four(four.y, &y[k]);
      store_four(four.z, &z[k]);
    }
    for (; k < count; ++k, point += step) one(point, &x[k], &y[k], &z[k]);
  }

 private:
  float coordinate(const unsigned char* point, const pose_wall_field& field) const {
    if (!plain_) return to_float(read_field(point, field, swap_));
    float value;
    std::memcpy(&value, point + field.offset, sizeof(value));
    return value;
  }
  void put(const unsigned char* point, std::uint32_t lane, FourPlaces* four) const {
    float x, y, z;
    one(point, &x, &y, &z);
    four->x[lane] = x, four->y[lane] = y, four->z[lane] = z;
  }

  const pose_wall_cloud& cloud_;
  bool swap_, plain_, in_a_row_;
};

}  // namespace pose_wall

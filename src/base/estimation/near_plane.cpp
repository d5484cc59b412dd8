// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/near_plane.hpp"

namespace pose_wall {

FourTruths Slab::may_meet(const BoundedPoints& points, std::uint32_t block) const {
  // Sums of four products of numbers up to a thousand are rounded by less than a millimetre, in floats.
  constexpr float kRounding_m = 0.01F;
  const FourFloats r = distances_.of(load_four(&points.centre_x[block]), load_four(&points.centre_y[block]),
                                     load_four(&points.centre_z[block]));
  const FourFloats reach = distances_.reach_of(load_four(&points.half_x[block]), load_four(&points.half_y[block]),
                                               load_four(&points.half_z[block]));
  return (r + reach >= low_m_ - kRounding_m) & (r - reach <= high_m_ + kRounding_m);
}

bool BlocksIn::next(std::uint32_t* begin, std::uint32_t* end) {
  for (const std::uint32_t blocks = points_.blocks(); block_ < blocks; ++block_) {
    const std::uint32_t lane = block_ % kFour;
    if (lane == 0) {
      meet_ = first_of_four(blocks - block_) & slab_.may_meet(points_, block_);
      if (!any_of(meet_)) {
        block_ += kFour - 1;
        continue;
      }
    }
    if (meet_[lane] == 0) continue;
    *begin = block_++ * BoundedPoints::kBlock;
    *end = *begin + BoundedPoints::kBlock < points_.count ? *begin + BoundedPoints::kBlock : points_.count;
    return true;
  }
  return false;
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/containers/bounded_points.hpp"

namespace pose_wall {
namespace {

// Of the values from begin on, fours of them.
void bound_row(const float* begin, std::uint32_t fours, float* centre, float* half) {
  FourFloats least = load_four(begin), most = least;
  for (std::uint32_t k = 1; k < fours; ++k) {
    const FourFloats x = load_four(begin + k * kFour);
    least = smaller_of(least, x);
    most = larger_of(most, x);
  }
  const float from = -largest_of(-least), to = largest_of(most);
  *centre = 0.5F * (from + to);
  *half = 0.5F * (to - from);
}

}  // namespace

void BoundedPoints::lay_out(Arena& arena, std::uint32_t capacity) {
  PointSet::lay_out(arena, capacity);
  for (Span<float>* row : {&centre_x, &centre_y, &centre_z, &half_x, &half_y, &half_z}) {
    *row = arena.take<float>((capacity + kBlock - 1) / kBlock + kFour);
  }
}

void BoundedPoints::bound() {
  if (count == 0) return;
  // The last one again and again, up to a whole four.
  for (std::uint32_t k = count; k % kFour != 0; ++k) copy(k, count - 1);
  for (std::uint32_t block = 0; block < blocks(); ++block) {
    const std::uint32_t begin = block * kBlock, left = (count - begin + kFour - 1) / kFour;
    const std::uint32_t fours = left < kBlock / kFour ? left : kBlock / kFour;
    bound_row(&x[begin], fours, &centre_x[block], &half_x[block]);
    bound_row(&y[begin], fours, &centre_y[block], &half_y[block]);
    bound_row(&z[begin], fours, &centre_z[block], &half_z[block]);
  }
}

}  // namespace pose_wall

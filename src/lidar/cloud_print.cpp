// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lidar/cloud_print.hpp"
#include "base/math/fnv1a.hpp"

namespace pose_wall {

std::uint32_t CloudPrint::returns() const {
  std::uint32_t sum = 0;
  for (std::uint32_t s = 0; s < kSectors; ++s) sum += returns(s);
  return sum;
}

std::uint64_t CloudPrint::whole() const {
  std::uint64_t whole = kFnv1aOfNothing;
  for (std::uint32_t s = 0; s < kSectors; ++s) whole = fnv1a_with(whole, sum_[s]);
  return whole;
}

}  // namespace pose_wall

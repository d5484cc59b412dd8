// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lidar/cloud_print.hpp"

namespace pose_wall {

std::uint32_t CloudPrint::returns() const {
  std::uint32_t sum = 0;
  for (std::uint32_t s = 0; s < kSectors; ++s) sum += returns(s);
  return sum;
}

std::uint64_t CloudPrint::whole() const {
  std::uint64_t whole = 0xCBF29CE484222325ULL;  // FNV-1a by words
  for (std::uint32_t s = 0; s < kSectors; ++s) whole = (whole ^ sum_[s]) * 0x100000001B3ULL;
  return whole;
}

}  // namespace pose_wall

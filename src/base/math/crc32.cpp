// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/math/crc32.hpp"

namespace pose_wall {

void Crc32::add_low_bits(std::uint32_t word, int bits) {
  crc_ ^= word;  // bits go in from the low end: four bytes, low byte first, can be put in at once
  for (int bit = 0; bit < bits; ++bit) crc_ = (crc_ >> 1U) ^ ((crc_ & 1U) != 0 ? polynomial_ : 0U);
}

}  // namespace pose_wall

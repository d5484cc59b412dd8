// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

namespace pose_wall {

// How many are set.
inline int bits_in(std::uint64_t word) {
  int bits = 0;
  for (; word != 0; word &= word - 1) ++bits;
  return bits;
}

// Whether so many are set, or more; 1 at least.
inline bool has_bits(std::uint64_t word, int least) {
  for (; least > 1; --least) word &= word - 1;
  return word != 0;
}

}  // namespace pose_wall

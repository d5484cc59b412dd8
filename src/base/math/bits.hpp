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

// The highest bit that is set; word: not zero. By halves, since not every processor can do it for a whole word without
// a library.
inline std::uint32_t highest_bit(std::uint64_t word) {
  const auto high = static_cast<std::uint32_t>(word >> 32), low = static_cast<std::uint32_t>(word);
  return high != 0 ? 63U - static_cast<std::uint32_t>(__builtin_clz(high))
                   : 31U - static_cast<std::uint32_t>(__builtin_clz(low));
}

// Whether so many are set, or more; 1 at least.
inline bool has_bits(std::uint64_t word, int least) {
  for (; least > 1; --least) word &= word - 1;
  return word != 0;
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// FNV-1a, for bytes and words that come in parts (Fowler, Noll and Vo; the numbers are theirs).

#pragma once

#include <cstdint>

namespace pose_wall {

// Each step maps different sums to different ones, whether it takes a byte or a word: no change of a single one goes
// unnoticed.
constexpr std::uint64_t kFnv1aOfNothing = 0xCBF29CE484222325ULL;
constexpr std::uint64_t fnv1a_with(std::uint64_t sum, std::uint64_t next) {
  constexpr std::uint64_t kPrime = 0x100000001B3ULL;  // of the sum of 64 bits
  return (sum ^ next) * kPrime;
}

// sum: of what came before.
inline std::uint64_t fnv1a(const void* bytes, std::uint64_t count, std::uint64_t sum = kFnv1aOfNothing) {
  const auto* const from = static_cast<const unsigned char*>(bytes);
  for (std::uint64_t k = 0; k < count; ++k) sum = fnv1a_with(sum, from[k]);
  return sum;
}

}  // namespace pose_wall

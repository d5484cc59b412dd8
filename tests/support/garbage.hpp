// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Numbers that garbage is made of.

#pragma once

#include <cstdint>
#include <cstring>
#include <random>

namespace pose_wall::test {

// Infinities and what is no number among them.
inline float any_bits(std::mt19937* random) {
  const auto bits = static_cast<std::uint32_t>((*random)());
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

inline float within(std::mt19937* random, float reach) {
  return std::uniform_real_distribution<float>(-reach, reach)(*random);
}

}  // namespace pose_wall::test

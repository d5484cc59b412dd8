// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Numbers that may be none: NaN and infinity.

#pragma once

#include <cstdint>
#include <cstring>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "pose_wall relies on NaN and infinity: do not build it with -ffast-math or -ffinite-math-only"
#endif

// -ffp-contract=off does not bind the vectoriser of GCC there (tools/cmake/pose_wall_compile.cmake).
#if defined(__GNUC__) && !defined(__clang__) && !defined(POSE_WALL_UNFUSED) && \
    (defined(__ARM_FEATURE_COMPLEX) || defined(__ARM_FEATURE_SVE))
#error "GCC would fuse complex products here: give -march or -mcpu in CMAKE_CXX_FLAGS, where the build can see them"
#endif

namespace pose_wall {

// By the bits, so that no compiler flag can take the test away.
inline bool is_finite(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return (bits & 0x7FF0000000000000ULL) != 0x7FF0000000000000ULL;
}

inline double not_a_number() {
  const std::uint64_t bits = 0x7FF8000000000000ULL;  // the same bits on every machine
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// b where a is not a number.
constexpr double larger(double a, double b) {
  return a > b ? a : b;
}

// The number itself, or the end of the range that it lies beyond. Not a number becomes `most`.
inline double clamped(double number, double least, double most) {
  if (number < least) return least;
  return number < most ? number : most;
}

}  // namespace pose_wall

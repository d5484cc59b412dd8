// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Four floats computed together: one register of NEON and of SSE. A vector type of GCC and Clang, not of one processor
// (but for any_of()). Each lane equals the same sum of single floats, so all machines agree to the bit.

#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__arm__) && defined(__ARM_NEON) && defined(__clang__)
#error "ARMv7's NEON takes numbers near zero for zero and Clang computes with it: please build by GCC or without NEON"
#endif

namespace pose_wall {

using FourFloats = float __attribute__((vector_size(16)));
constexpr std::uint32_t kFour = 4;  // floats of a register of NEON and of SSE

struct FourPlaces {
  FourFloats x, y, z;
};

inline FourFloats all_four(float x) {
  return FourFloats{x, x, x, x};
}

inline FourFloats load_four(const float* from) {
  FourFloats four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

inline FourFloats smaller_of(FourFloats a, FourFloats b) {
  return a < b ? a : b;
}

inline FourFloats larger_of(FourFloats a, FourFloats b) {
  return a > b ? a : b;
}

inline float largest_of(FourFloats four) {
  const float a = four[0] > four[1] ? four[0] : four[1], b = four[2] > four[3] ? four[2] : four[3];
  return a > b ? a : b;
}

using FourInts = std::int32_t __attribute__((vector_size(16)));
using FourWords = std::uint32_t __attribute__((vector_size(16)));
// Of a comparison: all ones where it holds, or zero. `truths ? a : b` takes lane by lane.
using FourTruths = FourInts;

inline FourInts all_four_ints(std::int32_t x) {
  return FourInts{x, x, x, x};
}

// How many were counted, lane by lane.
inline std::uint32_t sum_of_lanes(FourInts counts) {
  return static_cast<std::uint32_t>(counts[0] + counts[1] + counts[2] + counts[3]);
}

template <typename Four, typename Lane>
void store_four(Four four, Lane* to) {
  std::memcpy(to, &four, sizeof(four));
}

// Cut off towards zero. Below 2^31.
inline FourInts cut_off(FourFloats four) {
  return __builtin_convertvector(four, FourInts);
}

inline FourFloats root_of(FourFloats four) {
  for (std::uint32_t lane = 0; lane < kFour; ++lane) four[lane] = std::sqrt(four[lane]);
  return four;
}

inline FourFloats magnitude_of(FourFloats four) {
  constexpr std::int32_t kAllButSign = 0x7FFFFFFF;  // IEEE 754: the highest bit is the sign
  FourInts bits;
  std::memcpy(&bits, &four, sizeof(bits));
  bits &= FourInts{kAllButSign, kAllButSign, kAllButSign, kAllButSign};
  std::memcpy(&four, &bits, sizeof(four));
  return four;
}

// As many as a, with the sign of b turned into them: a where b is positive, -a where it is negative.
inline FourFloats signed_by(FourFloats a, FourFloats b) {
  constexpr std::int32_t kSign = INT32_MIN;  // IEEE 754: the highest bit
  FourInts to, from;
  std::memcpy(&to, &a, sizeof(to));
  std::memcpy(&from, &b, sizeof(from));
  to ^= from & FourInts{kSign, kSign, kSign, kSign};
  std::memcpy(&a, &to, sizeof(a));
  return a;
}

using FourShorts = std::int16_t __attribute__((vector_size(8)));
// Of integers that fit, and of truths.
inline FourShorts shorts_of(FourInts four) {
  return __builtin_convertvector(four, FourShorts);
}

// Of truths only: each processor looks at as few of a lane's bits as it can.
inline bool any_of(FourTruths truths) {
#ifdef __SSE2__
  return __builtin_ia32_movmskps(reinterpret_cast<FourFloats>(truths)) != 0;
#else
  const FourShorts halves = shorts_of(truths);
  std::uint64_t bits;
  std::memcpy(&bits, &halves, sizeof(bits));
  return bits != 0;
#endif
}

// Of truths only: bit k for lane k.
inline std::uint32_t bits_of(FourTruths truths) {
#ifdef __SSE2__
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<FourFloats>(truths)));
#else
  return static_cast<std::uint32_t>((truths[0] & 1) | (truths[1] & 2) | (truths[2] & 4) | (truths[3] & 8));
#endif
}

inline FourTruths first_of_four(std::uint32_t count) {
  return FourInts{0, 1, 2, 3} < static_cast<std::int32_t>(count);
}

// visit(first index, which of the four count): from begin to end, in rows that go on for a four behind the last end.
template <typename Visit>
void for_each_four(std::uint32_t begin, std::uint32_t end, const Visit& visit) {
  // One loop for whole fours and the rest: two would hold the visit twice.
  for (std::uint32_t k = begin; k < end; k += kFour) visit(k, first_of_four(end - k));
}
template <typename Visit>
void for_each_four(std::uint32_t count, const Visit& visit) {
  for_each_four(0, count, visit);
}

// In a fixed order.
inline double sum_of_lanes(FourFloats four) {
  return (static_cast<double>(four[0]) + static_cast<double>(four[1])) +
         (static_cast<double>(four[2]) + static_cast<double>(four[3]));
}

// Lanes of a, 0 to 3, and of b, 4 to 7.
template <int kFirst, int kSecond, int kThird, int kFourth, typename Four>
Four picked(Four a, Four b) {
#ifdef __clang__
  return __builtin_shufflevector(a, b, kFirst, kSecond, kThird, kFourth);
#else
  return __builtin_shuffle(a, b, FourInts{kFirst, kSecond, kThird, kFourth});
#endif
}

// Of four rows of four the columns.
template <typename Four>
void transpose(Four a, Four b, Four c, Four d, Four* columns) {
  const Four ab01 = picked<0, 4, 1, 5>(a, b), ab23 = picked<2, 6, 3, 7>(a, b);
  const Four cd01 = picked<0, 4, 1, 5>(c, d), cd23 = picked<2, 6, 3, 7>(c, d);
  columns[0] = picked<0, 1, 4, 5>(ab01, cd01);
  columns[1] = picked<2, 3, 6, 7>(ab01, cd01);
  columns[2] = picked<0, 1, 4, 5>(ab23, cd23);
  columns[3] = picked<2, 3, 6, 7>(ab23, cd23);
}

// Of four at once, as floats: the lanes of a, of b, of c and of d, in the order (0 + 2) + (1 + 3).
inline FourFloats four_sums_of_lanes(FourFloats a, FourFloats b, FourFloats c, FourFloats d) {
  const FourFloats ab = picked<0, 4, 1, 5>(a, b) + picked<2, 6, 3, 7>(a, b);
  const FourFloats cd = picked<0, 4, 1, 5>(c, d) + picked<2, 6, 3, 7>(c, d);
  return picked<0, 1, 4, 5>(ab, cd) + picked<2, 3, 6, 7>(ab, cd);
}

}  // namespace pose_wall

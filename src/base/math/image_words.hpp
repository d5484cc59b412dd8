// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From numbers to the words of a process image, and the sum over them. For the images of the engine and of motion.

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/math/crc32.hpp"
#include "base/math/elementary.hpp"

namespace pose_wall {

// The units of an image's integers, by tools/plc/image.def and the motion image:
constexpr double kMilliDegreesPerRadian = 180000.0 / kPi;
constexpr double kMillimetresPerMetre = 1000.0;
constexpr double kMillisecondsPerSecond = 1000.0;
constexpr double kNanosecondsPerSecond = 1e9;
constexpr std::uint32_t kMillisecondsNotKnown = 0xFFFFFFFFU;  // as the images document it

inline double within(double value, double limit) {
  if (value > limit) return limit;
  return value < -limit ? -limit : value;
}

constexpr double kIntegerMax = 2147483647.0;  // 2^31 - 1, of an int32; -2^31 is left out

inline std::int32_t nearest_integer(double value) {
  return static_cast<std::int32_t>(within(std::floor(value + 0.5), kIntegerMax));
}

inline std::int32_t integer_above(double value) {
  return static_cast<std::int32_t>(within(std::ceil(value), kIntegerMax));
}

inline std::uint32_t milliseconds_above(double seconds) {
  constexpr double kUnsignedMax = 4294967295.0;  // kMillisecondsNotKnown as a number
  const double milliseconds = std::ceil(seconds * kMillisecondsPerSecond);
  return milliseconds >= 0.0 && milliseconds < kUnsignedMax ? static_cast<std::uint32_t>(milliseconds)
                                                            : kMillisecondsNotKnown;
}

inline std::uint32_t latency_ms(std::int64_t latency_ns) {
  return latency_ns >= 0 ? milliseconds_above(static_cast<double>(latency_ns) / kNanosecondsPerSecond)
                         : kMillisecondsNotKnown;
}

// Of all words but the sum's own.
inline std::uint32_t crc_of_words(const void* image, std::size_t bytes, std::size_t crc_word,
                                  std::uint32_t polynomial) {
  const auto* from = static_cast<const unsigned char*>(image);
  Crc32 crc(polynomial);
  for (std::size_t i = 0; i < bytes / sizeof(std::uint32_t); ++i) {
    std::uint32_t word;
    std::memcpy(&word, from + i * sizeof(word), sizeof(word));
    if (i != crc_word) crc.add_word(word);
  }
  return crc.value();
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From numbers to the words of a process image, and the sum over them. For all images.

#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/math/crc32.hpp"
#include "base/math/elementary.hpp"
#include "part/status.hpp"
#include "pose_wall.h"

namespace pose_wall {

// The units of an image's integers, by tools/apps/plc/image.def and the motion image:
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

// What every image tells of its library and of its frame's time.
template <typename Image>
void put_version_and_stamp(std::int64_t stamp_ns, Image* image) {
  const auto stamp = static_cast<std::uint64_t>(stamp_ns);
  image->library_version = POSE_WALL_VERSION_MAJOR * 65536U + POSE_WALL_VERSION_MINOR * 256U + POSE_WALL_VERSION_PATCH;
  image->stamp_low = static_cast<std::uint32_t>(stamp & 0xFFFFFFFFU);
  image->stamp_high = static_cast<std::uint32_t>(stamp >> 32U);
}

// Of all words but the one that holds it.
template <typename Image>
std::uint32_t image_crc(const Image& image, std::uint32_t Image::*member, std::uint32_t polynomial) {
  const auto* const begin = reinterpret_cast<const unsigned char*>(&image);
  const auto* const without = reinterpret_cast<const unsigned char*>(&(image.*member));
  Crc32 crc(polynomial);
  for (const unsigned char* at = begin; at != begin + sizeof(image); at += sizeof(std::uint32_t)) {
    std::uint32_t word;
    std::memcpy(&word, at, sizeof(word));
    if (at != without) crc.add_word(word);
  }
  return crc.value();
}

// A caller's image, by its version and its sum.
template <typename Image>
std::int32_t check_image(const Image* image, std::uint32_t version, std::uint32_t Image::*member,
                         std::uint32_t polynomial) {
  if (image == nullptr) return POSE_WALL_E_NULL;
  if (image->struct_size != sizeof(*image) || image->version != version) return POSE_WALL_E_IMAGE_VERSION;
  return ok_if(image->*member == image_crc(*image, member, polynomial), POSE_WALL_E_IMAGE_CRC);
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Tells a cloud from all others by the bits of its points, sector by sector of azimuth about the sensor. The noise of
// real ranges never repeats, so equal prints mean that somebody delivered the same points again.

#pragma once

#include <cstdint>

#include "base/simd/four_floats.hpp"
#include "pose_wall.h"

namespace pose_wall {

class CloudPrint {
 public:
  // Of 1.3 degrees along the axes and 2.5 between them, since their edges lie evenly on a square. So a stretch of 10
  // degrees holds at least 7.5 in whole sectors: 600 shots of a VLP-16 at 10 Hz.
  static constexpr std::uint32_t kSectors = 180;

  void clear();
  // In the sensor's frame and any order. Zero, endless and no numbers are no returns.
  void add_four(const FourPlaces& p) { add_some(p, kFour); }
  void add_some(const FourPlaces& p, std::uint32_t count);

  // Below 2^20.
  std::uint32_t returns(std::uint32_t sector) const { return static_cast<std::uint32_t>(sum_[sector] & kCounts); }
  std::uint32_t returns() const;
  std::uint32_t of(std::uint32_t sector) const;
  std::uint64_t whole() const;

 private:
  static constexpr std::uint64_t kCounts = 0xFFFFF;  // the lowest bits of a sum count its returns

  std::uint64_t sum_[kSectors + 1] = {};  // the last one is of points without an azimuth
};

// Reads all points of a cloud that check_cloud() takes.
void print_cloud(const pose_wall_cloud& cloud, CloudPrint* print);

// Four points at once: the vector part of the print, for those who have the points at hand.
inline FourInts sectors_of(const FourPlaces& p) {
  constexpr float kFar_m = 1e9F;                          // no range of any sensor
  constexpr float kOfSide = CloudPrint::kSectors / 4.0F;  // sectors of a quarter turn
  const FourFloats zero = all_four(0.0F), sum = magnitude_of(p.x) + magnitude_of(p.y);
  const FourTruths has = (sum > zero) & (sum < all_four(kFar_m)) & (magnitude_of(p.z) < all_four(kFar_m));
  const FourFloats along = has ? p.y : zero, whole = has ? sum : all_four(1.0F);
  const FourFloats t = along / whole;  // from -1 to 1 on either side of the y axis
  const FourFloats at = p.x < zero ? all_four(3.0F) - t : all_four(1.0F) + t;
  const FourInts sector = cut_off(at * all_four(kOfSide));
  const FourInts last = all_four_ints(CloudPrint::kSectors - 1);
  return has ? (sector < last ? sector : last) : all_four_ints(CloudPrint::kSectors);
}

inline void CloudPrint::add_some(const FourPlaces& p, std::uint32_t count) {
  const FourInts sector = sectors_of(p);
  FourWords x, y, z;
  std::memcpy(&x, &p.x, sizeof(x));
  std::memcpy(&y, &p.y, sizeof(y));
  std::memcpy(&z, &p.z, sizeof(z));
  for (std::uint32_t lane = 0; lane < count; ++lane) {
    // Odd numbers that spread each bit over the higher ones (the golden ratio, and a mixer of SplitMix64's family).
    std::uint64_t word = (static_cast<std::uint64_t>(x[lane]) << 32 | y[lane]) * 0x9E3779B97F4A7C15ULL ^ z[lane];
    word *= 0xD6E8FEB86659FD93ULL;
    sum_[sector[lane]] += (word & ~kCounts) + 1;
  }
}

}  // namespace pose_wall

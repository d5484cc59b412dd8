// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Tells a cloud from all others by the bits of its points, sector by sector of azimuth about the sensor. The noise of
// real ranges never repeats, so equal prints mean that somebody delivered the same points again. Each part of the
// product adds returns as it reads them, by the sensor's own azimuth.

#pragma once

#include <cstdint>
#include <cstring>

#include "base/math/fnv1a.hpp"
#include "base/math/golden_ratio.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// A number for each point. Of equal bits it is equal, and any single bit changes it.
inline FourWords words_of(const FourPlaces& p) {
  // Odd, so that each bit spreads over the higher ones, as the golden ratio is: the two of C. Wellons' hash lowbias32.
  // Shifts bring the high bits down, or changes of two points might cancel in a sum.
  constexpr std::uint32_t kMixer = 0x7FEB352DU, kOther = 0x846CA68BU;
  constexpr int kDown = 15;  // of that hash, too
  FourWords x, y, z;
  std::memcpy(&x, &p.x, sizeof(x));
  std::memcpy(&y, &p.y, sizeof(y));
  std::memcpy(&z, &p.z, sizeof(z));
  FourWords word = x * kGoldenTurn32 + y;
  word ^= word >> kDown;
  word = word * kMixer + z * kOther;
  return word ^ word >> kDown;
}

class CloudPrint {
 public:
  // Of about 1.4 degrees; from 0.9 to 1.8 where they lie evenly on a square. So a stretch of 10 degrees holds at least
  // four whole sectors: 7 degrees, 560 shots of a VLP-16 at 10 Hz.
  static constexpr std::uint32_t kSectors = 256;

  void clear() { *this = CloudPrint{}; }
  void add(std::uint32_t sector, std::uint32_t word) { sum_[sector] += std::uint64_t{word} << kCountBits | 1U; }
  // Those of four points.
  void add_four(FourInts sectors, FourWords words, FourTruths those) {
    const FourInts to = those ? sectors : all_four_ints(kSectors);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) add(static_cast<std::uint32_t>(to[lane]), words[lane]);
  }

  std::uint32_t returns(std::uint32_t sector) const { return static_cast<std::uint32_t>(sum_[sector]); }
  std::uint32_t returns() const {
    std::uint32_t sum = 0;
    for (std::uint32_t s = 0; s < kSectors; ++s) sum += returns(s);
    return sum;
  }
  std::uint32_t of(std::uint32_t sector) const { return static_cast<std::uint32_t>(sum_[sector] >> kCountBits); }
  std::uint64_t whole() const {
    std::uint64_t whole = kFnv1aOfNothing;
    for (std::uint32_t s = 0; s < kSectors; ++s) whole = fnv1a_with(whole, sum_[s]);
    return whole;
  }

 private:
  static constexpr int kCountBits = 32;  // the lower half of a sum counts its returns

  std::uint64_t sum_[kSectors + 1] = {};  // the last one is of all that is no return
};

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lidar/seen_clouds.hpp"

#include "base/math/elementary.hpp"

namespace pose_wall {
namespace {

// In floating point: the difference of two arbitrary stamps need not fit an int64.
double age_s(std::int64_t stamp_ns, std::int64_t first_ns) {
  return (static_cast<double>(stamp_ns) - static_cast<double>(first_ns)) * kNanosecond_s;
}

}  // namespace

Repeat SeenClouds::keep(std::uint64_t print, std::int64_t stamp_ns) {
  for (const SeenCloud& seen : cloud) {
    if (seen.print == print) return {true, age_s(stamp_ns, seen.stamp_ns)};
  }
  for (std::uint32_t k = kCount - 1; k > 0; --k) cloud[k] = cloud[k - 1];
  cloud[0] = {print, stamp_ns};
  return {};
}

Repeat SeenSectors::keep(const CloudPrint& now, std::int64_t at_ns) {
  constexpr std::uint32_t kFours = kCount / kFour;  // registers that hold the prints of one sector
  // A run may go on across the first sector.
  constexpr std::uint32_t kAround = CloudPrint::kSectors + CloudPrint::kSectors / 4;
  FourInts run[kFours] = {}, longest[kFours] = {};
  for (std::uint32_t k = 0; k < kAround; ++k) {
    const std::uint32_t sector = k % CloudPrint::kSectors, returns = now.returns(sector);
    if (returns == 0) continue;
    const FourInts this_one = all_four_ints(static_cast<std::int32_t>(now.of(sector)));
    const FourInts more = all_four_ints(static_cast<std::int32_t>(returns));
    for (std::uint32_t four = 0; four < kFours; ++four) {
      FourInts seen;
      std::memcpy(&seen, &print[sector][four * kFour], sizeof(seen));
      run[four] = (run[four] + more) & (seen == this_one);
      // Of two sectors at least: one alone, of 32 bits, is another one's by chance once in 5 days at 10 Hz.
      const FourTruths is_longest = (run[four] > more) & (run[four] > longest[four]);
      longest[four] = is_longest ? run[four] : longest[four];
    }
  }
  Repeat repeat;
  std::int64_t first_ns = at_ns;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    if (static_cast<std::uint32_t>(longest[k / kFour][k % kFour]) < kReturnsLeast) continue;
    const double age = age_s(at_ns, stamp_ns[k]);
    const bool is_older = age < 0.0 || (repeat.age_s >= 0.0 && age > repeat.age_s);
    if (!repeat.is_one || is_older) repeat = {true, age}, first_ns = stamp_ns[k];
  }
  for (std::uint32_t sector = 0; sector < CloudPrint::kSectors; ++sector) {
    print[sector][next] = now.returns(sector) > 0 ? now.of(sector) : 0;
  }
  stamp_ns[next] = first_ns;
  next = (next + 1) % kCount;
  return repeat;
}

Repeat RepeatGuard::keep(const CloudPrint& now, std::int64_t stamp_ns) {
  if (now.returns() < SeenClouds::kReturnsLeast) return {};
  const Repeat whole = clouds.keep(now.whole(), stamp_ns);
  return whole.is_one ? whole : sectors.keep(now, stamp_ns);
}

}  // namespace pose_wall

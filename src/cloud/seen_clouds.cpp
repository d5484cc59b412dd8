// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "cloud/seen_clouds.hpp"

#include "base/math/elementary.hpp"

namespace pose_wall {

Repeat SeenClouds::keep(std::uint64_t fingerprint, std::int64_t stamp_ns) {
  for (const SeenCloud& seen : cloud) {
    if (seen.fingerprint != fingerprint) continue;
    // In floating point: the difference of two arbitrary stamps need not fit an int64.
    return {true, (static_cast<double>(stamp_ns) - static_cast<double>(seen.stamp_ns)) * kNanosecond_s};
  }
  for (std::uint32_t k = kCount - 1; k > 0; --k) cloud[k] = cloud[k - 1];
  cloud[0] = {fingerprint, stamp_ns};
  return {};
}

}  // namespace pose_wall

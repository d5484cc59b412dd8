// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The golden ratio as a share of a machine word's range: its multiples spread evenly, whatever their number (Knuth, The
// Art of Computer Programming, volume 3, section 6.4).

#pragma once

#include <cstdint>

namespace pose_wall {

constexpr std::uint32_t kGoldenTurn32 = 0x9E3779B9U;            // 2^32 over the golden ratio, odd
constexpr std::uint64_t kGoldenTurn64 = 0x9E3779B97F4A7C15ULL;  // 2^64 over the golden ratio, odd

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stamps and clocks count nanoseconds.

#pragma once

#include <cstdint>

namespace pose_wall {

// By definition, in whole nanoseconds:
constexpr std::int64_t kMillisecond_ns = 1000000;
constexpr std::int64_t kSecond_ns = 1000 * kMillisecond_ns;
constexpr std::int64_t kMinute_ns = 60 * kSecond_ns;
constexpr std::int64_t kHour_ns = 60 * kMinute_ns;

}  // namespace pose_wall

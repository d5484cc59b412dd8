// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stamps and clocks are untrusted numbers: their sums and differences end at the ends of time and do not wrap around.

#pragma once

#include <cstdint>

namespace pose_wall::runtime {

inline std::int64_t sum(std::int64_t a, std::int64_t b) {
  std::int64_t out;
  if (!__builtin_add_overflow(a, b, &out)) return out;
  return b > 0 ? INT64_MAX : INT64_MIN;
}

inline std::int64_t difference(std::int64_t a, std::int64_t b) {
  std::int64_t out;
  if (!__builtin_sub_overflow(a, b, &out)) return out;
  return b < 0 ? INT64_MAX : INT64_MIN;
}

}  // namespace pose_wall::runtime

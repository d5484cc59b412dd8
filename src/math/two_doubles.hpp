// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Two doubles that are worked on together; see four_floats.hpp.

#pragma once

#include <cstdint>
#include <cstring>

namespace pose_wall {

using TwoDoubles = double __attribute__((vector_size(16)));
constexpr std::uint32_t kTwo = 2;

inline TwoDoubles load_two(const double* from) {
  TwoDoubles two;
  std::memcpy(&two, from, sizeof(two));
  return two;
}

}  // namespace pose_wall

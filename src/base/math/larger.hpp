// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

namespace pose_wall {

// b where a is not a number.
constexpr double larger(double a, double b) {
  return a > b ? a : b;
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

namespace pose_wall::planar::route {

// The number itself, or the end of the range that it lies beyond. Not a number becomes `most`.
inline double clamped(double number, double least, double most) {
  if (number < least) return least;
  return number < most ? number : most;
}

}  // namespace pose_wall::planar::route

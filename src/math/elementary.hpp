// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Elementary functions of our own: the C libraries of x86-64 and AArch64 differ in the last bit of atan2 and others,
// and the engine's results have to be the same bits on both. Accurate to about 1e-15; tested against the C library.

#pragma once

namespace pose_wall {

constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double degrees) {
  return degrees * (kPi / 180.0);
}

// Angles of a config: |x| up to a few turns.
double sine(double x);
double cosine(double x);

// In (-pi, pi]; 0 for (0, 0).
double arc_tangent2(double y, double x);

// Natural logarithm of a positive, normal number.
double natural_log(double x);

// exp(x) for x in [-700, 700].
double exponential(double x);

}  // namespace pose_wall

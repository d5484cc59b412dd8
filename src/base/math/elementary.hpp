// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Elementary functions of our own: the C libraries of x86-64 and AArch64 differ in the last bit of atan2 and others,
// and the engine's results have to be the same bits on both. The bounds of their errors hold against the C library, by
// a test.

#pragma once

namespace pose_wall {

constexpr double kPi = 3.14159265358979323846;  // to more digits than a double holds
constexpr double kNanosecond_s = 1e-9;          // the unit of stamps

constexpr double radians(double degrees) {
  return degrees * (kPi / 180.0);
}

// Angles of a config: within 1e-14 for |x| up to 50; for |x| up to pi/4 the sine also within 2e-15 of itself.
double sine(double x);
double cosine(double x);

// In (-pi, pi], within 2e-15 of the angle itself; 0 for (0, 0).
double arc_tangent2(double y, double x);

// Natural logarithm of a positive, normal number, within 2e-15 of itself or 1e-16.
double natural_log(double x);

// exp(x) for x in [-700, 700], within 2e-15 + 2e-16 |x| of itself.
double exponential(double x);

}  // namespace pose_wall

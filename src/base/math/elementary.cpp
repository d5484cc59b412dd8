// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/math/elementary.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pose_wall {
namespace {

constexpr double kLn2High = 6.93147180369123816490e-01;  // upper bits of ln 2: k * kLn2High is exact
constexpr double kLn2Low = 1.90821492927058770002e-10;   // what they leave of it

// c[0] + c[1] x + ... by Horner's rule: a product and a sum a term, and no division. Unrolled term by term, since a
// loop takes as much again.
template <std::size_t kFirst = 0, std::size_t kTerms>
inline double polynomial(const double (&c)[kTerms], double x) {
  if constexpr (kFirst + 1 == kTerms) {
    return c[kFirst];
  } else {
    return polynomial<kFirst + 1>(c, x) * x + c[kFirst];
  }
}

constexpr double factorial(int n) {
  double product = 1.0;
  for (int k = 2; k <= n; ++k) product *= k;
  return product;
}

// Taylor series on [-pi/4, pi/4]; the first dropped term is below 1e-17.
double sine_series(double x) {
  const double x2 = x * x;
  double term = x;
  double sum = x;
  for (int k = 2; k <= 18; k += 2) {
    term *= -x2 / static_cast<double>(k * (k + 1));
    sum += term;
  }
  return sum;
}

double cosine_series(double x) {
  const double x2 = x * x;
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; k <= 17; k += 2) {
    term *= -x2 / static_cast<double>(k * (k + 1));
    sum += term;
  }
  return sum;
}

// Odd Taylor series; for |x| <= tan(pi/16) the first dropped term is below 1e-18.
double arc_tangent_series(double x) {
  const double x2 = x * x;
  double power = x;
  double sum = x;
  for (int k = 3; k <= 23; k += 2) {
    power *= -x2;
    sum += power / static_cast<double>(k);
  }
  return sum;
}

// atan of x in [0, 1]: atan(x) = 2 atan(x / (1 + sqrt(1 + x^2))), twice.
double arc_tangent_unit(double x) {
  x = x / (1.0 + std::sqrt(1.0 + x * x));
  x = x / (1.0 + std::sqrt(1.0 + x * x));
  return 4.0 * arc_tangent_series(x);
}

struct Quadrant {
  int index;         // 0..3
  double remainder;  // in [-pi/4, pi/4]
};

Quadrant reduce(double x) {
  constexpr double kHalfPiHigh = 1.57079632673412561417;     // upper bits of pi/2: 2^20 times it is exact
  constexpr double kHalfPiLow = 6.07710050650619224932e-11;  // what they leave of it
  const double turns = std::floor(x * (2.0 / kPi) + 0.5);
  const int quarter = static_cast<int>(static_cast<std::int64_t>(turns) & 3);
  return {quarter, (x - turns * kHalfPiHigh) - turns * kHalfPiLow};
}

}  // namespace

double sine(double x) {
  const Quadrant q = reduce(x);
  const double magnitude = (q.index & 1) != 0 ? cosine_series(q.remainder) : sine_series(q.remainder);
  return (q.index & 2) != 0 ? -magnitude : magnitude;
}

double cosine(double x) {
  const Quadrant q = reduce(x);
  const double magnitude = (q.index & 1) != 0 ? sine_series(q.remainder) : cosine_series(q.remainder);
  return q.index == 1 || q.index == 2 ? -magnitude : magnitude;
}

double arc_tangent2(double y, double x) {
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  if (ax == 0.0 && ay == 0.0) return 0.0;
  double angle = ay <= ax ? arc_tangent_unit(ay / ax) : 0.5 * kPi - arc_tangent_unit(ax / ay);
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

double natural_log(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof(bits));
  int exponent = static_cast<int>(bits >> 52) - 1023;
  bits = (bits & 0x000FFFFFFFFFFFFFULL) | 0x3FF0000000000000ULL;
  double mantissa;
  std::memcpy(&mantissa, &bits, sizeof(mantissa));
  if (mantissa > 1.4142135623730951) {
    mantissa *= 0.5;
    ++exponent;
  }
  // log(m) = 2 atanh(s), s = (m - 1) / (m + 1), |s| <= 0.1716.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  // Of atanh; the first dropped term is below 1e-18.
  static constexpr double kC[] = {1.0,        1.0 / 3.0,  1.0 / 5.0,  1.0 / 7.0,  1.0 / 9.0, 1.0 / 11.0,
                                  1.0 / 13.0, 1.0 / 15.0, 1.0 / 17.0, 1.0 / 19.0, 1.0 / 21.0};
  const double sum = s * polynomial(kC, s * s);
  return static_cast<double>(exponent) * kLn2High + (static_cast<double>(exponent) * kLn2Low + 2.0 * sum);
}

double exponential(double x) {
  // Taylor series on half of ln 2 to each side; the first dropped term is below 1e-17.
  static constexpr double kC[] = {1.0,
                                  1.0,
                                  1.0 / factorial(2),
                                  1.0 / factorial(3),
                                  1.0 / factorial(4),
                                  1.0 / factorial(5),
                                  1.0 / factorial(6),
                                  1.0 / factorial(7),
                                  1.0 / factorial(8),
                                  1.0 / factorial(9),
                                  1.0 / factorial(10),
                                  1.0 / factorial(11),
                                  1.0 / factorial(12),
                                  1.0 / factorial(13)};
  // Counted from below every exponent, so that cutting off the fraction rounds down; it is also the exponent's bias.
  constexpr double kBias = 1023.0;
  const auto biased = static_cast<std::int64_t>(x * (1.0 / (kLn2High + kLn2Low)) + (kBias + 0.5));
  const double k = static_cast<double>(biased) - kBias;
  const double r = (x - k * kLn2High) - k * kLn2Low;
  const std::uint64_t bits = static_cast<std::uint64_t>(biased) << 52;
  double scale;
  std::memcpy(&scale, &bits, sizeof(scale));
  return polynomial(kC, r) * scale;
}

}  // namespace pose_wall

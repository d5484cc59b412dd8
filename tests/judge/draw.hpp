// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Random numbers that are the same on every machine and with every standard library.

#pragma once

#include <cmath>
#include <cstdint>

namespace pose_wall::judge {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(mixed(seed)) {}

  // SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, OOPSLA 2014).
  std::uint64_t bits() { return mixed(state_ += 0x9E3779B97F4A7C15U); }

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1.0p-53);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  int whole(int low, int high) { return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1)); }
  // Standard normal, by Box and Muller.
  double normal() { return std::sqrt(-2.0 * std::log(uniform(1e-300, 1.0))) * std::cos(uniform(0.0, 2.0 * kPi)); }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace pose_wall::judge

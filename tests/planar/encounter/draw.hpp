// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Seeded draws for encounters: the same on every machine.

#pragma once

#include <cmath>

#include "base/math/random.hpp"

namespace pose_wall::test {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  double within(double least, double most) { return least + (most - least) * share(); }
  double share() { return static_cast<double>(random_.next() >> 11U) * 0x1p-53; }
  bool happens(double probability) { return share() < probability; }
  std::uint32_t below(std::uint32_t bound) { return random_.below(bound); }
  // Close to a normal one, and never beyond 3.5 sigma: the sum of four uniform ones.
  double normal() { return (share() + share() + share() + share() - 2.0) * 1.7320508; }
  // The same from one word, for ranges.
  float quick_normal() {
    const std::uint64_t word = random_.next();
    const auto part = [&](unsigned shift) { return static_cast<float>((word >> shift) & 0xFFFFU); };
    return (part(0) + part(16) + part(32) + part(48) - 131070.0F) * (1.7320508F / 65535.0F);
  }
  float quick_share() { return static_cast<float>(random_.next() >> 40U) * 0x1p-24F; }

 private:
  Random random_;
};

}  // namespace pose_wall::test

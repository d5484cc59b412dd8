// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Smooth noise over the whole plane that never repeats: what a place looks like depends on the place and the seed
// alone, so a machine that comes back finds the same rock.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "lab/sim/random.hpp"

namespace pose_wall::tools::sim {

// In the plane of the network, m. Not aligned: its layout is the same whatever vector units a user compiles for.
using Place = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;

class PlaneNoise {
 public:
  // Mean 0, standard deviation 1 over the plane; its correlation falls to half within about half a length.
  PlaneNoise(std::uint64_t seed, double length_m) : seed_(mix(seed ^ 0x9015eu)), per_m_(1.0 / length_m) {}

  double at(const Place& p) const {
    const double u = p.x() * per_m_, v = p.y() * per_m_;
    const double i = std::floor(u), j = std::floor(v);
    const double a = smooth(u - i), b = smooth(v - j);
    const auto x = static_cast<std::int64_t>(i), y = static_cast<std::int64_t>(j);
    const double low = node(x, y) + (node(x + 1, y) - node(x, y)) * a;
    const double high = node(x, y + 1) + (node(x + 1, y + 1) - node(x, y + 1)) * a;
    return kToSigma1 * (low + (high - low) * b);
  }

 private:
  // Nodes are even in [-1, 1], variance 1/3. Between nodes the sums of squares of the weights have the mean
  // (1 - 2 (1/2 - 181/462))^2: the variance of the field is a little below that of the nodes.
  static constexpr double kWeights = 1.0 - 2.0 * (0.5 - 181.0 / 462.0);
  static constexpr double kToSigma1 = 1.7320508075688772 / kWeights;

  static double smooth(double x) { return x * x * x * (x * (x * 6.0 - 15.0) + 10.0); }

  double node(std::int64_t x, std::int64_t y) const {
    const auto where = static_cast<std::uint64_t>(x) * 0x8da6b343u ^ static_cast<std::uint64_t>(y) * 0xd8163841u << 20u;
    return static_cast<double>(mix(where ^ seed_) >> 11u) * 0x1.0p-52 - 1.0;
  }

  std::uint64_t seed_;
  double per_m_;
};

}  // namespace pose_wall::tools::sim

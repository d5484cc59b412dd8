// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pose_wall::tools::sim {

// A periodic field of smooth Gaussian noise with mean 0 and variance 1. Its autocorrelation falls to 1/e at
// kCellsPerLength cells, so one tile serves every correlation length: scale the coordinates.
class NoiseTile {
 public:
  static constexpr int kCellsPerLength = 5;
  static constexpr int kColumns = 1024;
  static constexpr int kRows = 256;

  explicit NoiseTile(std::uint64_t seed);

  // Bilinear between lattice points. Coordinates in cells, within +-2^20.
  float at(double u_cells, double v_cells) const {
    constexpr double kToPositive = 1048576.0;
    const double u = u_cells + kToPositive;
    const double v = v_cells + kToPositive;
    const auto i = static_cast<std::uint32_t>(u);
    const auto j = static_cast<std::uint32_t>(v);
    const auto fu = static_cast<float>(u - static_cast<double>(i));
    const auto fv = static_cast<float>(v - static_cast<double>(j));
    const std::size_t i0 = i & (kColumns - 1u);
    const std::size_t i1 = (i + 1u) & (kColumns - 1u);
    const float* const low = &cells_[(j & (kRows - 1u)) * std::size_t{kColumns}];
    const float* const high = &cells_[((j + 1u) & (kRows - 1u)) * std::size_t{kColumns}];
    const float a = low[i0] + (low[i1] - low[i0]) * fu;
    const float b = high[i0] + (high[i1] - high[i0]) * fu;
    return a + (b - a) * fv;
  }

 private:
  std::vector<float> cells_;
};

// The value below which a share of the tile lies; +-infinity for shares 1 and 0.
double normal_quantile(double share);

}  // namespace pose_wall::tools::sim

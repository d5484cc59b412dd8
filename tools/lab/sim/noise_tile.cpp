// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/noise_tile.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "lab/sim/random.hpp"

namespace pose_wall::tools::sim {
namespace {

// White noise smoothed by a Gaussian of standard deviation w has the autocorrelation exp(-r^2 / (4 w^2)).
constexpr double kKernelWidthCells = 0.5 * NoiseTile::kCellsPerLength;
constexpr int kKernelReach = 3 * NoiseTile::kCellsPerLength / 2 + 1;
using Kernel = std::array<float, 2 * kKernelReach + 1>;

// Squares sum to 1, so that white noise keeps its variance.
Kernel make_kernel() {
  Kernel kernel{};
  double sum_of_squares = 0.0;
  for (int k = -kKernelReach; k <= kKernelReach; ++k) {
    const double weight = std::exp(-0.5 * (k / kKernelWidthCells) * (k / kKernelWidthCells));
    const int cell = k + kKernelReach;
    kernel[static_cast<std::size_t>(cell)] = static_cast<float>(weight);
    sum_of_squares += weight * weight;
  }
  for (float& weight : kernel) weight /= static_cast<float>(std::sqrt(sum_of_squares));
  return kernel;
}

void smooth(const std::vector<float>& from, std::vector<float>& to, const Kernel& kernel, bool along_rows) {
  constexpr unsigned kColumnMask = NoiseTile::kColumns - 1;
  constexpr unsigned kRowMask = NoiseTile::kRows - 1;
  for (unsigned j = 0; j <= kRowMask; ++j) {
    for (unsigned i = 0; i <= kColumnMask; ++i) {
      float sum = 0.0f;
      for (unsigned k = 0; k < kernel.size(); ++k) {
        const unsigned shift = k - static_cast<unsigned>(kKernelReach);
        const std::size_t column = along_rows ? (i + shift) & kColumnMask : i;
        const std::size_t row = along_rows ? j : (j + shift) & kRowMask;
        sum += kernel[k] * from[row * NoiseTile::kColumns + column];
      }
      to[std::size_t{j} * NoiseTile::kColumns + i] = sum;
    }
  }
}

}  // namespace

NoiseTile::NoiseTile(std::uint64_t seed) : cells_(std::size_t{kColumns} * kRows) {
  Random random(seed, 0x7011);
  double sum = 0.0;
  for (float& cell : cells_) sum += cell = static_cast<float>(random.gaussian());
  const auto mean = static_cast<float>(sum / static_cast<double>(cells_.size()));
  for (float& cell : cells_) cell -= mean;

  const Kernel kernel = make_kernel();
  std::vector<float> half(cells_.size());
  smooth(cells_, half, kernel, true);
  smooth(half, cells_, kernel, false);
}

double normal_quantile(double share) {
  if (share <= 0.0) return -std::numeric_limits<double>::infinity();
  if (share >= 1.0) return std::numeric_limits<double>::infinity();
  double low = -9.0;
  double high = 9.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace pose_wall::tools::sim

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Numbers that are gathered and told by their quantiles: what a few bad frames cannot move.

#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "io/numbers/quantile.hpp"

namespace pose_wall::tools::doctor {

inline double median(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

// How far each lies from the median of all.
inline std::vector<double> off_median(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> off;
  off.reserve(values.size());
  for (const double value : values) off.push_back(std::fabs(value - middle));
  return off;
}

// Nine in ten values lie within this of their median.
inline double spread90(const std::vector<double>& values) {
  return quantile(off_median(values), 0.9);
}

// Standard deviation of a Gaussian, from the median of what the values are off by.
inline double robust_sigma(const std::vector<double>& values) {
  return 1.4826 * median(off_median(values));
}

inline double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace pose_wall::tools::doctor

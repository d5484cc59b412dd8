// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pose_wall::bench {

// The value that such a share of the others does not exceed, 0 to 1; NaN of nothing.
inline double at_share(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * last + 0.5);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

inline double median(const std::vector<double>& values) {
  return at_share(values, 0.5);
}

}  // namespace pose_wall::bench

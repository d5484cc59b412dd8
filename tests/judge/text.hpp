// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How the judge writes numbers, and what many of them come to.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "judge/draw.hpp"
#include "pose_wall.h"

namespace pose_wall::judge {

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

// Angles in degrees, distances in millimetres.
inline double shown(int quantity, double value) {
  return quantity < POSE_WALL_D_LF ? value / kRadPerDeg : 1000.0 * value;
}

// Of no values: not a number.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace pose_wall::judge

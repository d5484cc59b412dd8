// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <algorithm>
#include <cstddef>

namespace pose_wall::tools::sim {

// The median of some values, the upper one of an even number. Changes their order.
template <typename Values>
auto middle_of(Values* values) {
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

}  // namespace pose_wall::tools::sim

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/steer_tally.hpp"

#include <algorithm>
#include <cmath>

#include "io/numbers/quantile.hpp"
#include "study/results/usability.hpp"

namespace pose_wall::tools {

void SteerTally::add(const Steering& steering) {
  ++frames_;
  for (const SteerValue& value : steering) {
    Quantity& quantity = quantities_[value.quantity];
    quantity.limit = value.limit;
    if (value.may_steer()) {
      ++quantity.may;
      continue;
    }
    ++quantity.causes[value.cause];
    if (value.is_measured && !std::isnan(value.level)) quantity.levels[value.cause].push_back(value.level);
  }
}

Steering SteerTally::steering() const {
  Steering steering;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const Quantity& quantity = quantities_[q];
    SteerValue& value = steering[q];
    value.quantity = q;
    value.limit = quantity.limit;
    value.valid_share = static_cast<double>(quantity.may) / static_cast<double>(frames_);
    if (usability_of(value.valid_share) == Usability::kUsable) continue;
    const auto most = std::max_element(quantity.causes.begin(), quantity.causes.end());
    value.cause = static_cast<std::uint32_t>(most - quantity.causes.begin());
    const std::vector<double>& levels = quantity.levels[value.cause];
    value.is_measured = 2 * levels.size() > *most;
    value.level = quantile(levels, 0.5);
  }
  return steering;
}

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The least share of valid values that a class, or several together, must show.

#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "lab/campaign/plan.hpp"

namespace pose_wall::tools::campaign {

// Roll, pitch, yaw, and the four distances together.
inline constexpr std::size_t kGroups = 4;

// What a measurement showed of one class and group of quantities: valid_shares.def.
struct ValidShare {
  double share;
  double spread;  // standard deviation between runs
};

// A scene as one sensor sees it.
struct ClassShares {
  std::string_view scene;
  std::string_view sensor;
  std::array<ValidShare, kGroups> groups;
};

const std::vector<ClassShares>& valid_shares();
// nullptr for a class without a floor.
const ClassShares* find_valid_shares(std::string_view scene, std::string_view sensor);

// The slack of a floor. A run counts once because its frames share their rock. So few standard deviations because a
// card has some 1300 shares, which the table's own runs measured no better; and one run may be lost.
inline constexpr double kSlackSpreads = 4.0;
inline constexpr double kSlackRuns = 1.0;

// Valid values of one group over some classes, against their floor:
// floor = share - kSlackSpreads * spread / sqrt(runs) - kSlackRuns / runs, share and spread by the classes' values.
class ValidCount {
 public:
  // One class.
  void add(const ValidShare& expected, std::size_t values, std::size_t valid, std::size_t runs);
  void merge(const ValidCount& other);

  std::size_t values() const { return values_; }
  double share() const;  // NaN without values
  double floor() const;  // NaN without values; not below 0
  bool holds() const;    // true without values

 private:
  std::size_t values_ = 0;
  std::size_t valid_ = 0;
  std::size_t runs_ = 0;
  double expected_ = 0.0;  // sum of values * share
  double variance_ = 0.0;  // sum of (values * spread)^2 / runs
};

using ValidCounts = std::array<ValidCount, kGroups>;

// Shorter than its scene asks for: the table's share is of all its phases, and nothing can be asked of some.
bool is_cut(const Run& run);

}  // namespace pose_wall::tools::campaign

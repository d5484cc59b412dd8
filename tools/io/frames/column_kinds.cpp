// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/column_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/frames/field_aliases.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kRingsMost = 128;        // of any sensor that is sold
constexpr double kByteMost = 255.0;            // rings are kept in a byte or more
constexpr double kElevationByRingLeast = 0.5;  // share of the variance; 0.99 and more about a sensor's own axes
constexpr double kStepToSpreadMost = 0.02;     // squared, of neighbours: noise has 1, one ring after the other 0.01
constexpr std::size_t kMoments = 36;           // of a scan: a tenth of a quarter turn each
constexpr std::size_t kPointsAMomentLeast = 10;
constexpr double kAllWaysMost = 0.7;
constexpr double kOneWayLeast = 0.95;  // mean direction of the returns of a moment: 1 where all look one way

struct Sums {
  double count = 0.0, sum = 0.0, squares = 0.0;

  void add(double value) {
    count += 1.0;
    sum += value;
    squares += value * value;
  }
  double of_mean() const { return count > 0.0 ? sum * sum / count : 0.0; }
};

}  // namespace

void ColumnLook::add(double value, double x, double y, double z) {
  const double across = std::hypot(x, y), range = std::hypot(across, z);
  if (!(across > 0.0) || !std::isfinite(range)) return;
  if (!std::isfinite(value)) {
    are_finite_ = false;
    return;
  }
  if (values_.empty()) least_ = most_ = value;
  is_rising_ = is_rising_ && (values_.empty() || value >= values_.back());
  least_ = std::min(least_, value);
  most_ = std::max(most_, value);
  are_whole_ = are_whole_ && value == std::floor(value);
  values_.push_back(value);
  elevations_rad_.push_back(std::atan2(z, across));
  ways_.push_back({x / across, y / across});
}

ColumnKind ColumnLook::kind() const {
  if (values_.empty() || least_ == most_) return ColumnKind::kConstant;
  if (is_whole_byte() && goes_with_elevation()) return ColumnKind::kRing;
  if (!are_finite_ || time_unit_s(most_ - least_) == 0.0) return ColumnKind::kOther;
  const bool is_in_order = !is_whole_byte() && (is_rising_ || is_smooth());
  return is_in_order || goes_with_azimuth() ? ColumnKind::kTime : ColumnKind::kOther;
}

bool ColumnLook::is_whole_byte() const {
  return are_whole_ && least_ >= 0.0 && most_ <= kByteMost;
}

bool ColumnLook::goes_with_elevation() const {
  Sums all;
  std::map<double, Sums> rings;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    all.add(elevations_rad_[i]);
    rings[values_[i]].add(elevations_rad_[i]);
  }
  if (rings.size() > kRingsMost || 4 * rings.size() > values_.size()) return false;  // a point each explains all
  double between = 0.0;
  for (const auto& [ring, sums] : rings) between += sums.of_mean();
  const double total = all.squares - all.of_mean();
  return total > 0.0 && between - all.of_mean() >= kElevationByRingLeast * total;
}

bool ColumnLook::is_smooth() const {
  Sums all;
  double steps = 0.0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    all.add(values_[i] - least_);
    if (i > 0) steps += (values_[i] - values_[i - 1]) * (values_[i] - values_[i - 1]);
  }
  return steps <= kStepToSpreadMost * 2.0 * (all.squares - all.of_mean());
}

// A sensor that turns looks one way at a time.
bool ColumnLook::goes_with_azimuth() const {
  std::vector<Way> moments(kMoments);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const double share = (values_[i] - least_) / (most_ - least_);
    Way& sum = moments[std::min(static_cast<std::size_t>(share * static_cast<double>(kMoments)), kMoments - 1)];
    sum.x += ways_[i].x;
    sum.y += ways_[i].y;
  }
  double one_way = 0.0;
  Way all;
  for (const Way& sum : moments) {
    one_way += std::hypot(sum.x, sum.y);
    all.x += sum.x;
    all.y += sum.y;
  }
  const auto count = static_cast<double>(values_.size());
  // A sensor that sees little of the horizon looks one way all the time.
  return values_.size() >= kPointsAMomentLeast * kMoments && one_way >= kOneWayLeast * count &&
         std::hypot(all.x, all.y) <= kAllWaysMost * count;
}

}  // namespace pose_wall::tools

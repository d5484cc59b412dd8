// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "truth/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pose_wall.h"
#include "results/run_summary.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// True as well for a missing protection level: an error without a bound is not within it.
bool is_beyond(double error, double bound) {
  return !(std::abs(error) <= bound);
}

}  // namespace

ErrorFigures error_figures(const std::vector<double>& errors) {
  if (errors.empty()) return {0, kNaN, kNaN, kNaN, kNaN};
  double sum = 0.0;
  double sum_of_squares = 0.0;
  std::vector<double> sizes;
  sizes.reserve(errors.size());
  for (const double error : errors) {
    sum += error;
    sum_of_squares += error * error;
    sizes.push_back(std::abs(error));
  }
  const auto count = static_cast<double>(errors.size());
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  return {errors.size(), std::sqrt(sum_of_squares / count), sum / count, quantile(sizes, 0.95), largest};
}

double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, kTwoPi);
  return wrapped <= -kTwoPi / 2 ? wrapped + kTwoPi : wrapped;
}

void ErrorStatistics::add(const Measured& measured, double truth) {
  if (!std::isfinite(truth)) return;
  ++frames_;
  const auto error_of = [this, truth](double number) {
    return is_angle_ ? wrap_angle(number - truth) : number - truth;
  };
  if (std::isfinite(measured.raw)) {
    const double error = error_of(measured.raw);
    raw_errors_.push_back(error);
    if (is_beyond(error, measured.protection_level)) ++raw_beyond_protection_;
    if (measured.sigma > 0.0) {
      z2_sum_ += error * error / (measured.sigma * measured.sigma);
      ++z2_count_;
    }
  }
  if (measured.state == POSE_WALL_VALID) ++valid_;
  if (measured.state == POSE_WALL_INVALID || !std::isfinite(measured.value)) return;
  const double error = error_of(measured.value);
  value_errors_.push_back(error);
  if (is_beyond(error, measured.protection_level)) ++value_beyond_protection_;
  if (measured.state == POSE_WALL_VALID && is_beyond(error, alert_limit_)) ++valid_beyond_alert_;
}

double ErrorStatistics::mean_z2() const {
  return z2_count_ > 0 ? z2_sum_ / static_cast<double>(z2_count_) : kNaN;
}

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/truth/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/numbers/quantile.hpp"
#include "pose_wall.h"

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

Judged judge(const Measured& measured, double truth, bool is_angle, double alert_limit) {
  const bool is_valid = measured.state == POSE_WALL_VALID;
  if (!std::isfinite(truth)) return {kNaN, kNaN, false, false, is_valid};
  const auto error_of = [is_angle, truth](double number) {
    return is_angle ? wrap_angle(number - truth) : number - truth;
  };
  Judged judged{kNaN, kNaN, false, false, false};
  if (std::isfinite(measured.raw)) {
    judged.raw_error = error_of(measured.raw);
    judged.raw_beyond_protection = is_beyond(judged.raw_error, measured.protection_level);
  }
  if (measured.state != POSE_WALL_INVALID && std::isfinite(measured.value)) {
    judged.value_error = error_of(measured.value);
    judged.value_beyond_protection = is_beyond(judged.value_error, measured.protection_level);
    judged.misleading = is_valid && is_beyond(judged.value_error, alert_limit);
  }
  return judged;
}

void ErrorStatistics::add(const Measured& measured, double truth) {
  const Judged judged = judge(measured, truth, is_angle_, alert_limit_);
  if (!std::isfinite(truth)) {
    if (judged.misleading) ++valid_without_truth_;
    return;
  }
  ++frames_;
  ++states_.at(measured.state);
  if (std::isfinite(judged.raw_error)) {
    raw_errors_.push_back(judged.raw_error);
    if (measured.sigma > 0.0) {
      z2_sum_ += judged.raw_error * judged.raw_error / (measured.sigma * measured.sigma);
      ++z2_count_;
    }
  }
  if (std::isfinite(judged.value_error)) {
    value_errors_.push_back(judged.value_error);
    if (measured.state == POSE_WALL_VALID) {
      valid_errors_.push_back(judged.value_error);
      valid_levels_.push_back(measured.protection_level);
    }
  }
  if (judged.raw_beyond_protection) ++raw_beyond_protection_;
  if (judged.value_beyond_protection) ++value_beyond_protection_;
  if (judged.misleading) ++valid_beyond_alert_;
}

void ErrorStatistics::merge(const ErrorStatistics& other) {
  frames_ += other.frames_;
  for (std::size_t state = 0; state < states_.size(); ++state) states_[state] += other.states_[state];
  raw_beyond_protection_ += other.raw_beyond_protection_;
  value_beyond_protection_ += other.value_beyond_protection_;
  valid_beyond_alert_ += other.valid_beyond_alert_;
  valid_without_truth_ += other.valid_without_truth_;
  z2_sum_ += other.z2_sum_;
  z2_count_ += other.z2_count_;
  raw_errors_.insert(raw_errors_.end(), other.raw_errors_.begin(), other.raw_errors_.end());
  value_errors_.insert(value_errors_.end(), other.value_errors_.begin(), other.value_errors_.end());
  valid_errors_.insert(valid_errors_.end(), other.valid_errors_.begin(), other.valid_errors_.end());
  valid_levels_.insert(valid_levels_.end(), other.valid_levels_.begin(), other.valid_levels_.end());
}

LevelFigures ErrorStatistics::valid_levels() const {
  return {quantile(valid_levels_, 0.5), error_figures(valid_errors_).absolute_95};
}

double ErrorStatistics::mean_z2() const {
  return z2_count_ > 0 ? z2_sum_ / static_cast<double>(z2_count_) : kNaN;
}

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How far measured values are from the truth, per quantity: errors, and whether the stated bounds held.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pose_wall::tools {

// One quantity of one frame. NaN where there is no number.
struct Measured {
  double value;
  double raw;
  double sigma;
  double protection_level;
  std::uint32_t state;  // pose_wall_state
};

// Of a list of errors; NaN for an empty list.
struct ErrorFigures {
  std::size_t count = 0;
  double rmse = 0.0;
  double bias = 0.0;
  double absolute_95 = 0.0;  // 95 % of the errors are within it
  double absolute_max = 0.0;
};

ErrorFigures error_figures(const std::vector<double>& errors);

// Into (-pi, pi].
double wrap_angle(double angle_rad);

// How one measured quantity stands to its truth.
struct Judged {
  double raw_error;    // wrapped for angles; NaN without raw or truth
  double value_error;  // NaN also for an invalid value
  bool raw_beyond_protection;
  bool value_beyond_protection;
  bool misleading;  // valid, and further off than the alert limit or without a truth at all: the worst failure there is
};

// The alert limit is in the quantity's own unit.
Judged judge(const Measured& measured, double truth, bool is_angle, double alert_limit);

// Of valid values that have a truth; NaN without any.
struct LevelFigures {
  double median;             // of the protection levels
  double absolute_error_95;  // 95 % of these values' errors are within it

  // By how much the levels are wider than the errors need.
  double over_error() const { return median / absolute_error_95; }
};

class ErrorStatistics {
 public:
  // Errors of angles are wrapped. The alert limit is in the quantity's own unit.
  ErrorStatistics(bool is_angle, double alert_limit) : is_angle_(is_angle), alert_limit_(alert_limit) {}

  // A frame with a truth that is NaN (no wall there) counts only in valid_without_truth().
  void add(const Measured& measured, double truth);
  // Of the same kind of quantity: all that the other one has seen.
  void merge(const ErrorStatistics& other);

  std::size_t frames() const { return frames_; }
  std::size_t measured() const { return raw_errors_.size(); }
  std::size_t valid() const { return states_[3]; }
  // Frames of a pose_wall_state.
  std::size_t in_state(std::uint32_t state) const { return states_.at(state); }

  ErrorFigures raw() const { return error_figures(raw_errors_); }
  // Of frames in which the value was not invalid, held ones included.
  ErrorFigures value() const { return error_figures(value_errors_); }

  LevelFigures valid_levels() const;

  // Errors beyond the protection level: the bound that was promised did not hold.
  std::size_t raw_beyond_protection() const { return raw_beyond_protection_; }
  std::size_t value_beyond_protection() const { return value_beyond_protection_; }
  // Errors beyond the alert limit in frames that claimed to be valid: the worst failure there is.
  std::size_t valid_beyond_alert() const { return valid_beyond_alert_; }
  // Claimed to be valid where there is nothing to measure.
  std::size_t valid_without_truth() const { return valid_without_truth_; }

  // Mean of (raw error / sigma)^2: 1 for a true sigma, more for a boastful one. NaN when nothing was measured.
  double mean_z2() const;

 private:
  bool is_angle_;
  double alert_limit_;
  std::size_t frames_ = 0;
  std::array<std::size_t, 4> states_{};  // by pose_wall_state
  std::size_t raw_beyond_protection_ = 0;
  std::size_t value_beyond_protection_ = 0;
  std::size_t valid_beyond_alert_ = 0;
  std::size_t valid_without_truth_ = 0;
  double z2_sum_ = 0.0;
  std::size_t z2_count_ = 0;
  std::vector<double> raw_errors_;
  std::vector<double> value_errors_;
  std::vector<double> valid_errors_;
  std::vector<double> valid_levels_;
};

}  // namespace pose_wall::tools

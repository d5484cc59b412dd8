// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a run over many frames came to: states, medians, what levels are made of, times and reasons, for the tables at
// its end.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "study/results/result_csv.hpp"
#include "study/results/steer_tally.hpp"
#include "study/results/usability.hpp"
#include "study/truth/alert_limits.hpp"

namespace pose_wall::tools {

class RunSummary {
 public:
  void add(const FrameOutcome& outcome);

  std::size_t frames() const { return frames_; }
  std::size_t unreadable() const { return unreadable_; }
  // Of the frames that were read; NaN where there were none.
  ValidShares valid_shares() const;

  // What may steer stands first. `wall_s`: time that the whole run took, reading included.
  std::string text(double wall_s) const;

 private:
  struct Quantity {
    std::array<std::size_t, 4> states{};  // by pose_wall_state
    std::vector<double> values;           // smoothed or held, of frames in which it was not invalid
    std::vector<double> raws;             // of frames in which it was measured
    std::vector<double> protection_levels;
    std::vector<double> raw_levels;                          // of frames in which it was measured
    std::array<std::vector<double>, POSE_WALL_PARTS> parts;  // of the protection levels
    std::array<std::size_t, POSE_WALL_PARTS> largest{};      // how often each part was the largest
    std::string positive_means;                              // "right side down", of angles
  };

  static void add(const pose_wall_value& value, Quantity* to);
  std::string level_text(std::size_t quantity, const std::vector<double>& levels) const;
  std::string quantities_text() const;
  std::string levels_text() const;
  std::string times_text(double wall_s) const;
  std::string reasons_text() const;

  AlertLimits limits_;  // of the frames: by these a level is too large to be worth its digits
  std::size_t frames_ = 0;
  std::size_t unreadable_ = 0;
  std::array<Quantity, POSE_WALL_QUANTITIES> quantities_;
  SteerTally steer_;
  std::array<std::size_t, POSE_WALL_REASON_COUNT> reasons_{};
  std::vector<double> elapsed_ms_;
  std::vector<double> processor_ms_;
};

}  // namespace pose_wall::tools

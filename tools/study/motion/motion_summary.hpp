// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a row of frames came to for the motion library: states, travel, largest levels, times, reasons, and what is
// worth a look.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "study/motion/motion_runner.hpp"

namespace pose_wall::tools {

class MotionSummary {
 public:
  void add(const MotionOutcome& outcome);

  std::size_t frames() const { return frames_; }
  std::size_t unreadable() const { return unreadable_; }

  // `wall_s`: time that the whole work took, reading included.
  std::string text(double wall_s) const;

 private:
  static constexpr std::size_t kStates = POSE_WALL_ALONG_MEASURED + 1;

  std::string states_text() const;
  std::string travel_text() const;
  std::string levels_text() const;
  std::string times_text(double wall_s) const;
  std::string reasons_text() const;
  std::string advice() const;
  std::size_t processed() const { return frames_ - unreadable_; }

  std::size_t frames_ = 0;
  std::size_t unreadable_ = 0;
  std::array<std::size_t, kStates> states_{};
  std::array<std::string, kStates> first_of_state_;  // "frame 12 (road/000012.pcd)"
  std::array<std::size_t, POSE_WALL_MOTION_REASON_COUNT> reasons_{};
  std::array<double, POSE_WALL_MOTION_DIRECTIONS> level_max_{};  // of poses that have one
  std::array<std::uint64_t, POSE_WALL_MOTION_DIRECTIONS> level_max_frame_{};
  double along_m_ = 0.0, along_level_m_ = 0.0;
  bool has_along_ = false;
  std::int64_t first_stamp_ns_ = 0, last_stamp_ns_ = 0;
  double sum_ms_ = 0.0, worst_ms_ = 0.0;
  std::uint64_t worst_frame_ = 0;
};

}  // namespace pose_wall::tools

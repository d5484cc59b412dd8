// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A line at the bottom of a terminal that says how far the work is.

#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "io/language/language.hpp"

namespace pose_wall::tools {

// True when the stream number (1: stdout, 2: stderr) is a terminal that a person looks at.
bool is_terminal(int stream);

// "45 s", "3 min 20 s", "2 h 05 min".
std::string duration_text(double seconds);

// Writes to stderr, and nothing at all unless enabled.
class ProgressBar {
 public:
  // `unit`: what is counted, for the rate; a translatable text.
  ProgressBar(std::size_t total, bool enabled, const char* unit = translatable("frames"));
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();  // takes the line away

  // Redraws at most ten times a second, and for the last step.
  void advance(const std::string& note);

  // Prints a line of its own above the bar, also when the bar is not enabled.
  void print_above(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const std::string& note);
  void clear();

  std::size_t total_;
  std::size_t done_ = 0;
  bool enabled_;
  const char* unit_;
  bool drawn_ = false;
  Clock::time_point started_ = Clock::now();
  Clock::time_point drawn_at_{};
};

}  // namespace pose_wall::tools

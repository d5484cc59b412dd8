// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The daemon's log: one line a fact, to standard error. Where the journal reads it, the journal adds the time.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/live/health.hpp"

namespace pose_wall::tools::live {

// Less grave lines are not written from now on. From any thread.
void set_log_level(Grade least);
// "info", "warning", "error"; as the key log_level has it.
Grade log_level_of(const std::string& name);

// From any thread; a line is written whole, in the language of the process (--language, POSE_WALL_LANGUAGE, the
// locale). Part and fact are given in English.
void log_line(Grade grade, const std::string& part, const std::string& fact);
// The same whatever the level: what a person has asked for, and must see.
void log_anyway(Grade grade, const std::string& part, const std::string& fact);

// Writes only what changed: a part's grade or summary. A part may go to and fro, as on a machine that is too slow. When
// it has said the same a few times within kWindow, one line says so. From then on one line a window sums up, until a
// window passes without a change. A summary that is new is told at once all the same, up to a few a window.
class HealthLog {
 public:
  using Clock = std::chrono::steady_clock;
  using Write = std::function<void(Grade grade, const std::string& part, const std::string& fact)>;

  static constexpr auto kWindow = std::chrono::seconds(30);

  explicit HealthLog(Write write = log_line) : write_(std::move(write)) {}

  void note(const std::vector<PartHealth>& parts, Clock::time_point now = Clock::now());

 private:
  struct Course {
    PartHealth last;
    Clock::time_point window_began;
    std::map<std::string, int> told;  // summaries of this window, and how often
    std::uint64_t untold = 0;         // changes of this window that were not written
    bool has_changed = false;         // in this window
    bool is_damped = false;
  };

  void note_change(const PartHealth& part, Course* course);
  void end_window(Course* course, Clock::time_point now);

  Write write_;
  std::map<std::string, Course> courses_;  // of each part
};

}  // namespace pose_wall::tools::live

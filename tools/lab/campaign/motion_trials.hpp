// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the gates of the motion library are good for: the same runs with its table, then with other limits of a gate
// (--motion --sweep), or without gates (--motion --ablate). The motion library that takes notes measures them, for it
// alone lets a limit be set.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lab/campaign/manifest.hpp"
#include "lab/campaign/motion_card.hpp"
#include "lab/campaign/plan.hpp"
#include "lab/campaign/workers.hpp"
#include "pose_wall_motion_trace.h"

namespace pose_wall::tools::campaign {

// One change of the table.
struct MotionTrial {
  std::vector<std::uint32_t> gates;  // in their order; none: the table as it is
  double limit = 0.0;                // of the one gate; NaN: the gates let everything pass
};

struct MotionTrialRequest {
  bool is_sweep = false;
  std::string words;
  std::vector<MotionTrial> trials;
  std::string fault;  // empty, or what is wrong with the words
};

// "matched=40,160"
MotionTrialRequest motion_sweep(const std::string& words);
// "each", or "matched,reach": these together.
MotionTrialRequest motion_ablation(const std::string& words);

struct MotionTrialRow {
  MotionTrial trial;
  std::size_t judged = 0;                                          // frames but the first of each run
  std::array<std::size_t, POSE_WALL_ALONG_MEASURED + 2> states{};  // of those; the last: unreadable
  Misleading poses, steps;
  DirectionErrors along_step;
  std::size_t asked = 0, failed = 0;  // the trial's gates, over all frames
  std::size_t frames_changed = 0;     // any number but the time is another one than with the table
};

struct MotionTrials {
  MotionTrialRequest request;
  Manifest manifest;
  std::size_t frames = 0;
  std::vector<MotionTrialRow> rows;  // with the table first
};

// Throws as work_on does, and std::invalid_argument with the fault. No other frame may be traced meanwhile: limits are
// of the whole program.
MotionTrials run_motion_trials(const MotionTrialRequest& request, const Manifest& manifest,
                               const std::vector<Run>& runs, const Crew& crew);

pose_wall_motion_trace_info motion_gate(std::uint32_t gate);
// "matched, reach"
std::string motion_gate_names(const std::vector<std::uint32_t>& gates);

std::string motion_trials_text(const MotionTrials& trials);
std::string motion_trials_json(const MotionTrials& trials);

}  // namespace pose_wall::tools::campaign

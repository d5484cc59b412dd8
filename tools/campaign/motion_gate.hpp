// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the card of motion must show.

#pragma once

#include <string>
#include <vector>

#include "campaign/motion_card.hpp"

namespace pose_wall::tools::campaign {

// Of the way along on rough rock, asked from so many runs on: over fewer the accumulated one scatters more than that.
inline constexpr double kMotionZ2Min = 0.5, kMotionZ2Max = 1.3;
inline constexpr std::size_t kRunsForMotionZ2 = 40;

// Share of the frames of any class that may be lost: the one behind a long gap, where it stands in rock never seen.
inline constexpr double kMotionLostMax = 0.05;

// A line for each demand that the class breaks, in words: "measured in 12 % of the frames, at least 95 % are asked".
std::vector<std::string> motion_class_faults(const MotionClassCard& one);

// Those of all classes, each behind its name and sensor, and those of the whole; empty: passed.
std::vector<std::string> motion_gate_faults(const MotionCard& card);

}  // namespace pose_wall::tools::campaign

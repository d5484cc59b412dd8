// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a campaign must show before the engine, or the motion library, may be believed.

#pragma once

#include <string>
#include <vector>

#include "lab/campaign/card.hpp"
#include "lab/campaign/motion_card.hpp"

namespace pose_wall::tools::campaign {

// Rates of frames. Errors beyond the protection level in nominal classes: none. In adversarial ones: below this.
inline constexpr double kAdversarialRateMax = 1e-3;
// Frames in which the engine runs out of its work budget, of each kind and in all.
inline constexpr double kWorkLimitedMax = 0.005;
// Mean z² of each quantity over the runs of nominal classes in whose scans no motion is: sigma is that of the estimate,
// and what a moving machine does to a scan is in the level alone. Of motion that of the way along on rough rock.
inline constexpr double kMeanZ2Min = 0.5;
inline constexpr double kMeanZ2Max = 1.3;
// Runs that it takes to ask for that: each has only one rock, and the mean over fewer scatters more than these bounds.
inline constexpr std::size_t kRunsForMeanZ2 = 200;
inline constexpr std::size_t kRunsForMotionZ2 = 40;  // over fewer the accumulated way scatters more than that

// Share of the frames of any class that may be lost: the one behind a long gap, where it stands in rock never seen.
inline constexpr double kMotionLostMax = 0.05;

// Part of the whole; 0 of nothing.
double rate(std::size_t events, std::size_t frames);

// One line per demand that does not hold; empty when the gate is passed.
std::vector<std::string> gate_faults(const Card& card);
// Those of all classes, each behind its name and sensor, and those of the whole.
std::vector<std::string> gate_faults(const MotionCard& card);
// Of one: "measured in 12 % of the frames, at least 95 % are asked".
std::vector<std::string> class_faults(const MotionClassCard& one);

}  // namespace pose_wall::tools::campaign

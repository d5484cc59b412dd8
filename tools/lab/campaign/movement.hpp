// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a campaign adds to its scenes so that they are as real sensors see them: scans that take time, while the machine
// stands in half of the runs and drives in the others.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/sim/setup.hpp"

namespace pose_wall::tools::campaign {

// kTurning: a scan takes the time of the sensor's turn, and its points have times. kInstant: each frame is taken at one
// instant, and the machine moves as the scene draws it.
enum class Scans { kTurning, kInstant };

std::vector<std::string> scans_names();
const char* scans_name(Scans scans);
// Throws std::invalid_argument for a name that does not exist.
Scans scans_named(const std::string& name);

// Which run of a campaign: those of one scene and sensor take turns.
struct RunOfClass {
  std::string scene;
  std::string sensor;
  std::uint32_t draw = 0;
  std::uint64_t seed = 0;
};

// KEY=VALUE for `pose_wall sim` over the scene as the run draws it; nothing with kInstant. They depend on the run
// alone, however many frames of it are asked for. Where a scene has a motion of its own, that is kept.
std::vector<std::string> movement_of(const RunOfClass& run, Scans scans);

// How far the machine may go from where a scene begins: things that stand at one place stay what the scene is about.
// Infinite on a road that is the same everywhere.
double room_to_drive_m(const sim::Setup& setup);

// Whether these settings make the machine stand.
bool stands(const std::vector<std::string>& settings);
// Whether no motion of the machine is in a scan: it has no duration, or the machine stands and does not sway.
bool has_straight_scans(const std::vector<std::string>& settings);

}  // namespace pose_wall::tools::campaign

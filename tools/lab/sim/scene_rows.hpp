// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The parts of the table of scenes.
#pragma once

#include "lab/sim/scenes.hpp"

namespace pose_wall::tools::sim {

std::vector<SceneChoice> mines_scenes();
std::vector<SceneChoice> walls_scenes();
std::vector<SceneChoice> along_scenes();
std::vector<SceneChoice> openings_scenes();
std::vector<SceneChoice> floors_scenes();
std::vector<SceneChoice> air_scenes();
std::vector<SceneChoice> machine_scenes();
std::vector<SceneChoice> sensor_scenes();

}  // namespace pose_wall::tools::sim

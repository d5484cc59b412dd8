// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Settings of the SLAM as `--set KEY=VALUE` gives them.

#pragma once

#include <string>
#include <vector>

#include "pose_wall_planar_slam.h"
#include "study/planar/setting_words.hpp"

namespace pose_wall::tools {

// Without keyframes_most: the trail takes the room that is there.
const SettingRows& slam_setting_rows();

// The defaults, with the settings that `words` holds; these are taken out of it, the others stay. Throws
// std::invalid_argument that names the setting and its range.
pose_wall_planar_slam_settings take_slam_settings(std::vector<std::string>* words);

}  // namespace pose_wall::tools

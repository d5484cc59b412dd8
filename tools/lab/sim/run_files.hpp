// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lab/sim/sensors.hpp"
#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

// frames/000007.pcd under the folder.
std::filesystem::path frame_file(const std::filesystem::path& folder, std::uint32_t frame_index);

// The settings that an engine must know of this run: axes, mounting, the machine's own body, and what its sensor asks
// for.
std::vector<EngineSetting> engine_setting_list(const Setup& setup);

// The same as a pose_wall.yaml.
std::string engine_settings(const Setup& setup, const std::string& comment);

}  // namespace pose_wall::tools::sim

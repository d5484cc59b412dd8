// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The keys of pose_wall.yaml that the motion library reads and the engine does not.

#pragma once

#include <string>
#include <vector>

#include "io/config_file/outside_key.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::tools {

pose_wall_motion_settings default_motion_settings();

// All rows, in the table's order.
const std::vector<OutsideKey>& motion_keys();
const OutsideKey* find_motion_key(const std::string& name);

// As it would be written in pose_wall.yaml, in the key's own unit.
std::string motion_value_text(const pose_wall_motion_settings& settings, const OutsideKey& key);

// False where the value is not allowed; the settings are then as before.
bool set_motion_value(pose_wall_motion_settings* settings, const OutsideKey& key, const std::string& value);

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Rows of the engine's table of keys, by name, and in words.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::tools {

// All rows, in the table's order.
const std::vector<pose_wall_key_info>& config_keys();

std::optional<pose_wall_key_info> find_config_key(const std::string& name);

std::vector<std::string> config_key_names();

// "a number from 0.01 to 0.5 m", "one of +X, -X, +Y, -Y", ...
std::string allowed_text(const pose_wall_key_info& key);

// The present value as it would be written in pose_wall.yaml.
std::string config_value_text(const pose_wall_config& config, const pose_wall_key_info& key);

// Of a key of text or choice.
std::string config_text(const pose_wall_config& config, const char* key);

// The same where people read it: nothing as it is written, too, in a file or behind --set ("[]": no box).
std::string config_written_text(const pose_wall_config& config, const pose_wall_key_info& key);

// What a controller compares with the image's config_crc32.
std::uint32_t config_crc(const pose_wall_config& config);
// "settings' CRC: 16#D5FB5C72".
std::string config_crc_text(const pose_wall_config& config);

}  // namespace pose_wall::tools

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// An answer of the stop as a controller reads it, and the number by which the controller knows the settings.

#pragma once

#include <cstdint>

#include "pose_wall_planar_stop.h"

namespace pose_wall::planar {

// Of results that a stop wrote.
constexpr std::uint32_t kStopMark = 0x706F7453U;

// Of what decides: the config, and the settings without corners that are not in use. Both are initialised.
std::uint32_t settings_crc(const pose_wall_config& config, const pose_wall_planar_stop_settings& settings);

// Everything but struct_size and the CRC is written, then the CRC.
void fill_image(const pose_wall_planar_stop_result& result, pose_wall_planar_stop_image* image);

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From a result to the process image of a controller.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall {

// Everything but struct_size and crc32 is written, then crc32.
void fill_image(const pose_wall_result& result, pose_wall_image* image);

// POSE_WALL_OK, or what is wrong with it.
std::int32_t check_image(const pose_wall_image& image);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From a result to the process images of a controller.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall {

// Everything but struct_size and the CRC is written, then the CRC.
void fill_image(const pose_wall_result& result, pose_wall_image* image);
void fill_image(const pose_wall_result& result, const pose_wall_image_source& source, pose_wall_image2* image);

// The source of a result, from the result alone.
pose_wall_image_source source_of(const pose_wall_result& result);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A motion result as a controller reads it: whole numbers, rounded so that |value - truth| <= level still holds.

#pragma once

#include <cstdint>

#include "pose_wall_motion.h"

namespace pose_wall::motion {

void fill_image(const pose_wall_motion_result& result, const pose_wall_image_source& source,
                pose_wall_motion_image* image);

}  // namespace pose_wall::motion

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// When mementos are saved and loaded.

#pragma once

#include "pose_wall.h"

namespace pose_wall::test {

// The stamps go on in the clock of the saved ones.
constexpr pose_wall_moment kSameClock = {sizeof(pose_wall_moment), POSE_WALL_MOMENT_SAME_CLOCK, {}, 0, 0};

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 5: at most one wall on each side.

#pragma once

#include "base/math/random.hpp"
#include "engine/walls/scene.hpp"
#include "engine/walls/scratch.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// last: the planes of the last frame by side, or nullptr; scored like any other hypothesis.
WallsResult find_walls(const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch);

}  // namespace pose_wall

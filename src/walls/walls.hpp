// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 5: at most one wall on each side.

#pragma once

#include "base/math/random.hpp"
#include "types.hpp"
#include "walls/scratch.hpp"

namespace pose_wall {

struct WallsResult {
  WallResult side[2];  // left, right
  // The turn by which the level may be off, by what the lean of both sides says; zero unless they are sure.
  Eigen::Vector3d tilt_level_rad = Eigen::Vector3d::Zero();
};

// last: the planes of the last frame by side, or nullptr; scored like any other hypothesis.
WallsResult find_walls(const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The standard deviations of yaw and the distances.

#pragma once

#include "base/estimation/patch_fit.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// Sets the standard deviations, their degrees of freedom and the pivot of each wall that is found, left and right. What
// one wall shows of the rock holds for the other as well if both are accepted. errors: of their surfaces. sigmas: as in
// spread_of_mixture().
void set_sigmas(const PatchErrors (&errors)[2], double sigmas, JudgedWall (*walls)[2]);

}  // namespace pose_wall

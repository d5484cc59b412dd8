// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include "estimation/plane.hpp"
#include "stages/walls_scene.hpp"

namespace pose_wall {

// Whether the sensor looks past both ends of a plane, near itself: a curtain or a vehicle that hides the wall. A wall
// goes on until it is out of sight; one that bends away is seen just behind its end, and behind an opening there is
// more of it. margin_m: returns this near to the plane are the plane's.
bool is_island(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double margin_m);

}  // namespace pose_wall

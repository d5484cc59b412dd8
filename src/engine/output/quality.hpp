// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 6a: from fits to the seven measurements, each with standard deviation, protection level and reasons.

#pragma once

#include "engine/config.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/floor/result.hpp"
#include "engine/output/measurements.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// walls: left, right. The quantities of a refused floor or wall stay unmeasured.
Measurements measure_quantities(const FloorResult& floor, const Levelling& levelling, const MeasuredWalls& walls,
                                const Settings& settings);

}  // namespace pose_wall

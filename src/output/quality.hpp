// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 6a: from fits to the seven measurements, each with standard deviation, protection level and reasons.

#pragma once

#include "config.hpp"
#include "types.hpp"

namespace pose_wall {

// walls: left, right. A refused floor or wall leaves its quantities unmeasured.
Measurements measure_quantities(const FloorResult& floor, const Levelling& levelling, const WallResult (&walls)[2],
                                const Settings& settings);

// Returns nearer than range_min that take up most of a side hide what is behind them: that side is refused.
void refuse_blocked_sides(const IngestCounts& counts, WallResult (*walls)[2]);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A route as the caller gets it: corners rounded where there is room, then poses along it.

#pragma once

#include <cstdint>

#include "base/containers/span.hpp"
#include "planar/route/footprint.hpp"
#include "planar/route/leg.hpp"
#include "pose_wall_planar_plan.h"

namespace pose_wall::planar::route {

struct Rounding {
  double radius_least_m = 1.0, radius_most_m = 8.0;
  double pose_step_m = 0.25;
};

struct Written {
  std::uint32_t poses = 0;  // that the route has; only as many as there is room for are written
  std::uint32_t cusps = 0, spot_turns = 0;
  double length_m = 0.0, turning_rad = 0.0, cost_m = 0.0;
};

Written write_poses(Span<const Corner> corners, const Pose2& start, const Costs& costs, const Rounding& rounding,
                    Sweeps* sweeps, Span<pose_wall_planar_path_pose> out);

}  // namespace pose_wall::planar::route

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which runs a campaign of the motion library is made of: one draw of a class's sizes, seen by one sensor.

#pragma once

#include <string>
#include <vector>

#include "campaign/motion_classes.hpp"
#include "campaign/plan.hpp"

namespace pose_wall::tools::campaign {

// Draw by draw, class by class, sensor by sensor: what was interrupted has runs of every class. request.scenes are
// names of classes. The drawn sizes do not depend on the size, only how long a run is. Throws std::invalid_argument for
// names that do not exist, with the nearest one.
std::vector<Run> make_motion_plan(const PlanRequest& request);

}  // namespace pose_wall::tools::campaign

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <array>
#include <vector>

#include "lab/sim/pose.hpp"
#include "lab/sim/primitives.hpp"

namespace pose_wall::tools::sim {

// The machine's body and boom at their places in the road, as the sensor sees them.
std::vector<Primitive> machine_body(const Setup& setup, const MachinePose& pose, const Placement& placement);

// x_min x_max y_min y_max z_min z_max of the body in base, with a margin: for the config of the engine.
std::array<double, 6> body_box_base_m(const Machine& machine);
// The same of the boom when it does not swing.
std::array<double, 6> boom_box_base_m(const Machine& machine);

}  // namespace pose_wall::tools::sim

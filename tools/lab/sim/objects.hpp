// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>
#include <vector>

#include "lab/sim/primitives.hpp"
#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

// What stands in the road at the start.
std::vector<Primitive> road_objects(const Setup& setup, std::uint64_t seed);
// The narrow place: part of the rock, though built of boxes.
std::vector<Primitive> narrow_place(const Setup& setup);
std::vector<Primitive> benches(const Setup& setup);

}  // namespace pose_wall::tools::sim

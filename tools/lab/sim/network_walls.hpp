// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// From centre lines to walls: the outline of all roads together, moved in and out by the relief of the rock.
#pragma once

#include <vector>

#include "lab/sim/network_graph.hpp"
#include "lab/sim/network_segments.hpp"

namespace pose_wall::tools::sim {

// The rock first, whose neighbours' ends are equal to the last bit; then steel sets and props, closed and seen from
// outside.
std::vector<WallSegment> network_walls(const NetworkPlan& plan, const NetworkGraph& graph, std::uint64_t seed);

}  // namespace pose_wall::tools::sim

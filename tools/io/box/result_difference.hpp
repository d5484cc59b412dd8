// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where two results differ, bit by bit and by name.

#pragma once

#include <optional>
#include <string>

#include "pose_wall.h"

namespace pose_wall::tools {

struct ResultDifference {
  std::string field;  // "quantity[yaw].sigma"
  std::string recorded;
  std::string computed;
};

// The first in the order of the struct. stage_ns is left out: it is the clock's, not the engine's. NaN equals NaN of
// the same bits.
std::optional<ResultDifference> first_difference(const pose_wall_result& recorded, const pose_wall_result& computed);

}  // namespace pose_wall::tools

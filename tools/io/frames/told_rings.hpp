// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How many rings a sensor has, where its driver tells it.

#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

struct ToldRings {
  std::size_t count = 0;  // 0: neither a field nor the cloud's shape tells
  std::string by;         // "field ring", "rows of the cloud"
};

// The field that holds the ring of a point. None where there is no such field, or where one ring holds points of many
// elevations: a driver that fills the field with zeros tells no rings.
std::optional<pose_wall_field> told_ring_field(const Frame& frame);

// By the values of that field, or by the rows of a cloud that keeps the sensor's order.
ToldRings told_rings(const Frame& frame);

}  // namespace pose_wall::tools

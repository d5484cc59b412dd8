// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How many rings a sensor has, where its driver tells it.

#pragma once

#include <cstddef>
#include <string>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

struct ToldRings {
  std::size_t count = 0;  // 0: neither a field nor the cloud's shape tells
  std::string by;         // "field ring", "rows of the cloud"
};

// By the values of the field that numbers them, or by the rows of a cloud that keeps the sensor's order.
ToldRings told_rings(const Frame& frame);

}  // namespace pose_wall::tools

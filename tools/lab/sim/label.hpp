// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

namespace pose_wall::tools::sim {

// What a simulated point really is.
enum class Label : std::uint8_t {
  kNone = 0,  // no return
  kFloor,
  kRoof,
  kWallLeft,
  kWallRight,
  kFace,
  kOpening,  // inside a crosscut or widening
  kSteel,
  kMuck,
  kObject,
  kBody,
  kGhost,
  kDust
};

}  // namespace pose_wall::tools::sim

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Steps of one item of the motion's loops (base/containers/work.hpp). A step is 11 to 14 instructions of
// an ordinary frame and of one after a silence, counted by callgrind in bounded_test (2026-11).

#pragma once

#include <cstdint>

#include "base/containers/work.hpp"

namespace pose_wall::motion::steps {

// Counted by callgrind (2026-11): a point of the cloud, and one of the range image in segments, features and
// observations. One in a keyframe, and a tile that begins there. An observation in both steps, all rounds.
constexpr std::uint64_t kPointProjected = 7, kPointLookedAt = 24, kPointTakenIn = 33, kTileSettled = 680;
constexpr std::uint64_t kEquation = 81;  // counted, see above
// Wide start: a cell of the map's surfaces that is drawn, an observation's window in a row of places, a start whose
// bound is drawn up, and an observation that is looked up exactly. Counted by callgrind (2026-11).
constexpr std::uint64_t kCellDrawn = 2, kWindowOpened = 4, kEightWindows = 12, kStartBounded = 2, kStartLookedAt = 13;
// All of a wide start, at most: pose_wall_motion.h promises it.
constexpr std::uint64_t kSearchMost = 5000000;

// Curves along the road: an observation at a shift. Likewise.
constexpr std::uint64_t kRowShifted = 20;

inline std::uint64_t of_curve(std::uint32_t observations, std::uint32_t rows_most, std::uint32_t shifts) {
  const std::uint32_t rows = observations / (observations / rows_most + 1) + 1;
  return kRowShifted * (rows < rows_most ? rows : rows_most) * shifts;
}

}  // namespace pose_wall::motion::steps

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Degrees are for people and their settings; all that is computed is in radians.

#pragma once

namespace pose_wall::tools {

inline constexpr double kDegPerRad = 57.29577951308232;
inline constexpr double kRadPerDeg = 0.017453292519943295;
// What tests find of the one holds for the other.
static_assert(kDegPerRad * kRadPerDeg == 1.0);

}  // namespace pose_wall::tools

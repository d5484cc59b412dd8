// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How far a surface stands out of its wall, by height above the sensor. The floor lies 1.4 m below that (kFloorZ_m).

#pragma once

namespace pose_wall::test {

using WallProfile = double (*)(double z_m);

inline double plain_wall(double) {
  return 0.0;
}

// From 1.6 m above the floor on.
inline double arched_wall(double z_m) {
  return z_m > 0.2 ? 0.35 * (z_m - 0.2) * (z_m - 0.2) : 0.0;
}

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What must hold of every result, whatever the cloud was.

#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "pose_wall.h"

namespace pose_wall::test {

// Empty when the result keeps its promises, else which one it breaks.
inline const char* broken_promise(const pose_wall_value& v) {
  const bool live = v.state == POSE_WALL_VALID || v.state == POSE_WALL_DEGRADED;
  if (v.state > POSE_WALL_VALID) return "no such state";
  if (!(v.confidence >= 0.0 && v.confidence <= 1.0)) return "confidence outside 0..1";
  if ((v.state == POSE_WALL_INVALID) != (v.confidence == 0.0)) return "confidence 0 is for invalid alone";
  if (!(v.age_s >= 0.0)) return "negative age";
  if (std::isnan(v.raw) == live) return "raw is there iff it was measured";
  if (v.state == POSE_WALL_INVALID) return "";
  if (!std::isfinite(v.value)) return "value is no number";
  if (!(v.sigma > 0.0) || !std::isfinite(v.sigma)) return "sigma is no positive number";
  if (!(v.protection_level > 0.0) || !std::isfinite(v.protection_level)) return "level is no positive number";
  if (live && !std::isfinite(v.raw)) return "raw is no number";
  return "";
}

inline std::uint32_t dropped(const pose_wall_result& r) {
  return r.dropped_not_finite + r.dropped_zero + r.dropped_near + r.dropped_far + r.dropped_body;
}

inline void expect_promises(const pose_wall_result& r, const char* what) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_STREQ(broken_promise(r.quantity[q]), "") << what << ": " << pose_wall_quantity_name(q);
  }
  EXPECT_TRUE(r.confidence >= 0.0 && r.confidence <= 1.0) << what;
  EXPECT_LE(dropped(r), r.points_in) << what;
  EXPECT_LE(r.outliers, r.voxels) << what;
  for (const double entry : r.R_level_base) EXPECT_TRUE(std::isfinite(entry)) << what;
  for (const pose_wall_plane* plane : {&r.floor, &r.left, &r.right}) {
    const double norm = std::hypot(plane->normal[0], plane->normal[1], plane->normal[2]);
    EXPECT_NEAR(norm, plane->found != 0 ? 1.0 : 0.0, 1e-9) << what;
  }
}

}  // namespace pose_wall::test

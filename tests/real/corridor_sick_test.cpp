// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// corridor_sick: a vehicle with a tilting SICK scanner in a corridor.
// Proves: by all of it in view, the wall on the right stands at 0.965 m from the sensor. So it does within the level of
// the piece beside the sensor, whose half behind is not seen. The surface at 3.79 m behind an opening on the left never
// becomes the left wall.

#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr double kRight_m = 0.965, kRightTolerance_m = 0.02;
constexpr double kSurfaceBehind_m = 3.79;

class CorridorSick : public RealFrames {
 protected:
  static pose_wall_config config(const char* region = "on") {
    return config_with({{"range_min", "0.5"}, {"region", region}});
  }
};

TEST_F(CorridorSick, TheRightWallIsWhereItStands) {
  for (const char* name : {"corridor_sick/scan000.pcd", "corridor_sick/scan001.pcd"}) {
    const pose_wall_result r = process_alone(config("off"), name);
    ASSERT_EQ(r.right.found, 1U) << name;
    // The sensor is the base origin here, and d the wall's distance from it.
    EXPECT_NEAR(std::fabs(r.right.d_m), kRight_m, kRightTolerance_m) << name;
    const pose_wall_value beside = process_alone(config(), name).quantity[POSE_WALL_D_RF];
    ASSERT_TRUE(is_measured(beside)) << name;
    EXPECT_NEAR(beside.raw, kRight_m, beside.raw_protection_level + kRightTolerance_m) << name;
  }
}

TEST_F(CorridorSick, TheLeftWallIsNeverTheSurfaceBehindTheOpening) {
  for (const char* name : {"corridor_sick/scan000.pcd", "corridor_sick/scan001.pcd"}) {
    const pose_wall_result r = process_alone(config(), name);
    if (!is_measured(r.quantity[POSE_WALL_D_LF]) && !is_measured(r.quantity[POSE_WALL_D_LB])) continue;
    EXPECT_GT(std::fabs(std::fabs(r.left.d_m) - kSurfaceBehind_m), 0.3) << name;
  }
}

}  // namespace
}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: of air full of points, at any number of them for the room there is, nothing is valid, and what did not fit
// leaves nothing behind for the next frame. Other garbage is tried by the fuzz targets (tests/fuzz), in every build,
// and named case by case in tests/faults.

#include <gtest/gtest.h>

#include "support/contract.hpp"
#include "support/garbage.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

// Dust as thick as can be: points that fill the air evenly, at any number of them for the room there is. Voxels that
// had to grow would lie in layers. The lowest points may be told as a doubtful floor, but nothing passes for sure.
TEST(Air, OfPointsThatFillTheAirNothingIsValid) {
  std::mt19937 random(13);
  int without_voxels = 0;
  for (const char* points_max : {"5000", "16000", "60000"}) {
    for (const std::size_t count : {5000U, 20000U, 65000U, 131000U, 260000U}) {
      Points points(count);
      for (auto& p : points) p = {within(&random, 20), within(&random, 20), within(&random, 2.5F)};
      const pose_wall_config config = config_with({{"points_max", points_max}, {"ground_inlier_min", "150"}});
      EngineUnderTest engine(config);
      const pose_wall_result r = engine.process(cloud_of(points, 0));
      EXPECT_EQ(broken_contract(r, limits_of(config)), "") << points_max << " " << count;
      for (const pose_wall_value& v : r.quantity) EXPECT_NE(v.state, POSE_WALL_VALID) << points_max << " " << count;
      if (r.voxels == 0) {
        ++without_voxels;
        EXPECT_NE(r.frame_reasons & POSE_WALL_R_LEAF_GROWN, 0U) << points_max << " " << count;
        for (const pose_wall_value& v : r.quantity) EXPECT_NE(v.reasons & POSE_WALL_R_LEAF_GROWN, 0U) << points_max;
      }
      for (std::uint32_t q = POSE_WALL_YAW; q < POSE_WALL_QUANTITIES; ++q) {
        EXPECT_EQ(r.quantity[q].state, POSE_WALL_INVALID) << points_max << " " << count;
      }
    }
  }
  EXPECT_GT(without_voxels, 0);
}

// The lists of the frame before lie where other stages have written since.
TEST(Air, APointCloudThatDoesNotFitBetweenTwoRoadsLeavesNothingBehind) {
  const Points road = points_of(sim::Simulator(sim::make_setup("clean", "vlp16", false, 1), 1).render(0));
  std::mt19937 random(14);
  Points air(65000);
  for (auto& p : air) p = {within(&random, 20), within(&random, 20), within(&random, 2.5F)};
  for (const char* points_max : {"5000", "16000"}) {
    const pose_wall_config config = config_with({{"points_max", points_max}});
    EngineUnderTest engine(config);
    for (int round = 0; round < 3; ++round) {
      const pose_wall_result r = engine.process(cloud_of(road, 200000000LL * round));
      EXPECT_GT(r.voxels, 0U) << points_max;
      const pose_wall_result none = engine.process(cloud_of(air, 200000000LL * round + 100000000));
      EXPECT_EQ(none.voxels, 0U) << points_max;
      EXPECT_NE(none.frame_reasons & POSE_WALL_R_LEAF_GROWN, 0U) << points_max;
    }
  }
}

}  // namespace
}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: with regions on, what is no wall of a region is never told as one, levels hold on curved walls, and one wall
// that falls silent leaves the road's direction.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lab/sim/parameters.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

constexpr double kOfPoints_m_rad = 1e-4;  // their rounding

sim::SceneSetup setup_with(const char* scene, const char* sensor, const std::vector<std::string>& parameters) {
  sim::SceneSetup setup = sim::make_setup(scene, sensor, false, 1);
  for (const std::string& parameter : parameters) sim::set_parameter(setup, parameter);
  return setup;
}

std::vector<JudgedFrame> run_regions(const sim::SceneSetup& setup, std::uint64_t seed, std::uint32_t frames) {
  return run_frames(setup, seed, frames, config_with({{"region", "on"}}));
}

TEST(Regions, ARowOfPropsBeforeNothingIsNoWall) {
  for (const char* sensor : {"os1-64", "os0-128"}) {
    for (const char* pitch : {"0.4", "0.5", "0.7", "1", "1.5"}) {
      const auto frames =
          run_regions(setup_with("props_before_void", sensor, {std::string("prop_pitch_m=") + pitch}), 1, 2);
      for (const JudgedFrame& frame : frames) {
        ASSERT_TRUE(std::isnan(frame.truth.value[POSE_WALL_D_LF]));
        for (const std::uint32_t q : {POSE_WALL_D_LF, POSE_WALL_D_LB}) {
          EXPECT_FALSE(frame.is(q, POSE_WALL_VALID)) << pose_wall_quantity_name(q) << ' ' << sensor << ", " << pitch;
        }
      }
    }
  }
}

// The plane leans where it is fitted to an arch, so a distance follows the lean as well.
TEST(Regions, TheLevelsHoldInAnArch) {
  std::uint32_t valid = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const JudgedFrame frame = run_regions(sim::make_setup("arch", "os1-64", true, seed), seed, 1).front();
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      if (!frame.is(q, POSE_WALL_VALID)) continue;
      ++valid;
      EXPECT_LE(std::fabs(frame.error(q)), frame.result.quantity[q].protection_level + kOfPoints_m_rad)
          << pose_wall_quantity_name(q) << ", seed " << seed;
    }
  }
  EXPECT_GE(valid, 35U) << "half of them";
}

// Each bends the region's plane, by 0.4 to 2.4 degrees, and all of the floor in view tells so.
TEST(Regions, NeitherAWallsFootNorABenchInTheLaneTurnsTheFloor) {
  struct Case {
    const char *scene, *sensor;
    std::uint64_t seed;
  };
  for (const Case& c : {Case{"near_wall", "mid360", 398657283}, Case{"bench", "os0-128", 725470930},
                        Case{"blocked_twice", "os1-64", 836349038}}) {
    for (const JudgedFrame& frame : run_regions(sim::make_setup(c.scene, c.sensor, true, c.seed), c.seed, 3)) {
      for (const std::uint32_t q : {POSE_WALL_ROLL, POSE_WALL_PITCH}) {
        EXPECT_FALSE(frame.is(q, POSE_WALL_INVALID)) << c.scene;
        EXPECT_LE(std::fabs(frame.error(q)), frame.result.quantity[q].protection_level) << c.scene;
      }
    }
  }
}

TEST(Regions, OneSilentWallLeavesTheDirection) {
  const auto setup = setup_with("shotcrete", "os1-64", {"lost_side=left", "lost_from_s=0", "lost_to_s=60"});
  for (const JudgedFrame& frame : run_regions(setup, 5, 3)) {
    EXPECT_TRUE(frame.is(POSE_WALL_YAW, POSE_WALL_VALID));
    EXPECT_LE(std::fabs(frame.error(POSE_WALL_YAW)), frame.result.quantity[POSE_WALL_YAW].protection_level);
    EXPECT_FALSE(frame.is(POSE_WALL_D_LF, POSE_WALL_VALID));
    EXPECT_TRUE(frame.is(POSE_WALL_D_RF, POSE_WALL_VALID));
  }
}

}  // namespace
}  // namespace pose_wall::test

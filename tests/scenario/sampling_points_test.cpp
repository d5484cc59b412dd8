// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, where the plane is right but the wall at a sampling point is not seen, or not in the plane: each distance is
// within its level, and none is valid that is off by more than the alert limit. A wall that widens where only the floor
// is seen of it, a narrow place seen above the band only, an arch whose bend begins at the height of the sampling
// point, one that is seen too little of, and one whose band ends below the sampling point. Does not prove a rate.

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <vector>

#include "lab/sim/parameters.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

struct AtPoint {
  const char* name;
  const char* scene;
  const char* sensor;
  std::uint64_t seed;  // of random sizes; 0: the scene's own
  std::vector<const char*> sizes;
  std::vector<KeyValue> settings = {};
  std::uint32_t frames = 3;
};

void PrintTo(const AtPoint& at, std::ostream* os) {
  *os << at.name;
}

// clang-format off
const std::vector<AtPoint> kAtPoints = {
    {"widening_of_which_the_floor_is_seen", "widening", "mid360", 0,
     {"widening_side=both", "widening_at_m=1.5", "widening_m=0.6", "width_m=5.86", "lateral_m=0.5",
      "base_height_m=1.24", "turned_left_deg=4.5", "roll_deg=-13.5", "pitch_deg=16.4", "mount_roll_deg=180"}},
    {"widening_by_a_metre", "widening", "mid360", 100330,
     {"forward_axis=+Y", "roll_deg=-16.42", "pitch_deg=-13.51", "lateral_m=-0.47", "mount_roll_deg=180"}},
    {"widening_far_from_what_is_seen", "widening", "mid360", 0,
     {"widening_side=left", "widening_at_m=1.5", "roll_deg=-20", "pitch_deg=20", "mount_roll_deg=180",
      "base_height_m=1.2"}},
    {"narrow_place_above_the_band", "narrow", "vlp16", 100130,
     {"forward_axis=-Y", "turned_left_deg=14.84", "roll_deg=14.82", "pitch_deg=13.64", "mount_y_m=0.77",
      "mount_z_m=0.87"}, {}, 6},
    {"arch_seen_from_a_tilted_machine", "arch", "mid360", 117,
     {"roll_deg=-7.8", "pitch_deg=-10.07", "mount_roll_deg=180"}},
    {"arch_seen_from_the_other_side", "arch", "mid360", 185,
     {"roll_deg=12.01", "pitch_deg=9.14", "mount_roll_deg=180"}},
    {"arch_and_a_sensor_turned_back", "arch", "vlp16", 2002213,
     {"forward_axis=+Y", "turned_left_deg=0.37", "roll_deg=15.08", "pitch_deg=-8.99", "mount_yaw_deg=-168.9"}, {}, 6},
    {"arch_above_the_band", "arch", "vlp16", 0,
     {"arch_springing_m=1.1", "roughness_m=0.02", "width_m=5.6", "height_m=3", "base_height_m=1.6"},
     {{"wall_z_max", "1.4"}}},
    {"smooth_arch_above_the_band", "arch", "os1-64", 0,
     {"arch_springing_m=1.2", "roughness_m=0", "base_height_m=1.8"}, {{"wall_z_max", "1.4"}}},
    {"upright_wall_below_an_arch", "arch", "os1-64", 0,
     {"arch_springing_m=1.35", "roughness_m=0", "base_height_m=2.2"}, {{"wall_z_max", "1.3"}}},
};
// clang-format on

class SamplingPoint : public ::testing::TestWithParam<AtPoint> {};

TEST_P(SamplingPoint, WhatIsNotSeenThereIsInTheLevel) {
  constexpr double kTruthGrid_m = 0.001;  // the simulator's own grid and rounding
  const AtPoint& at = GetParam();
  sim::SceneSetup setup = sim::make_setup(at.scene, at.sensor, at.seed != 0, at.seed);
  for (const char* assignment : at.sizes) sim::set_parameter(setup, assignment);
  pose_wall_config config = config_with();
  for (const auto& [key, value] : at.settings) set(&config, key, value);
  std::uint32_t measured = 0;
  for (const JudgedFrame& f : run_frames(setup, at.seed != 0 ? at.seed : 1, at.frames, config)) {
    for (std::uint32_t q = POSE_WALL_D_LF; q <= POSE_WALL_D_RB; ++q) {
      if (!f.is(q, POSE_WALL_VALID) && !f.is(q, POSE_WALL_DEGRADED)) continue;
      ++measured;
      const double level_m = f.result.quantity[q].protection_level;
      EXPECT_LE(std::fabs(f.raw_error(q)), level_m + kTruthGrid_m) << pose_wall_quantity_name(q);
      const double allowed_m = f.is(q, POSE_WALL_VALID) ? 0.10 : 1e9;
      EXPECT_LE(std::fabs(f.error(q)), allowed_m) << pose_wall_quantity_name(q);
    }
  }
  EXPECT_GT(measured, 0U);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SamplingPoint, ::testing::ValuesIn(kAtPoints),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pose_wall::test

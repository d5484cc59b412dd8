// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, on simulated roads with the motion library beside the engine: no level is wider than that of the look alone,
// and none is left by its error, whether the machine drives or stands. A sparse sensor that drives up to a face keeps
// the floor that it has seen on the way. Does not prove how much narrower levels become: src/engine/output has a table.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lab/sim/run_files.hpp"
#include "study/motion/moving_engine.hpp"
#include "support/motion_under_test.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

constexpr double kMargin_rad = 1e-4, kMargin_m = 0.001;  // the simulator's own grid and rounding

// So many frames of a drawn road, by an engine that knows its way.
std::vector<JudgedFrame> drive(const char* scene, const char* sensor, double speed_mps, std::uint32_t frames) {
  constexpr std::uint64_t kSeed = 1;  // of the drive to a face in src/engine/output/README.md
  sim::SceneSetup setup = sim::make_setup(scene, sensor, true, kSeed);
  setup.machine.speed_mps = speed_mps;
  setup.rock.rock_repeats = 0.0;
  const sim::Simulator simulator(setup, kSeed);
  api::Config config;
  for (const tools::EngineSetting& setting : sim::engine_setting_list(setup)) {
    EXPECT_EQ(config.set(setting.key.c_str(), setting.value.c_str()), POSE_WALL_OK) << setting.key;
  }
  tools::MovingEngine engine;
  EXPECT_EQ(engine.open(config, motion_settings()), POSE_WALL_OK);
  std::vector<JudgedFrame> out;
  for (std::uint32_t i = 0; i < frames; ++i) {
    const sim::Frame frame = simulator.render(i);
    pose_wall_result result{};
    result.struct_size = sizeof result;
    EXPECT_EQ(engine.process(cloud_of(frame), result), POSE_WALL_OK);
    out.push_back({result, simulator.truth(i), simulator.surveyed_truth(i)});
  }
  return out;
}

void expect_sound(const std::vector<JudgedFrame>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const pose_wall_value& v = frames[i].result.quantity[q];
      if (v.state != POSE_WALL_VALID && v.state != POSE_WALL_DEGRADED) continue;
      const std::string where = std::string(pose_wall_quantity_name(q)) + " of frame " + std::to_string(i);
      EXPECT_LE(v.protection_level, v.raw_protection_level) << where;
      EXPECT_LE(std::fabs(frames[i].error(q)), v.protection_level + (q < POSE_WALL_D_LF ? kMargin_rad : kMargin_m))
          << where;
    }
  }
}

double median_level(const std::vector<JudgedFrame>& frames, std::size_t from, std::uint32_t quantity) {
  std::vector<double> levels;
  for (std::size_t i = from; i < frames.size(); ++i) {
    levels.push_back(frames[i].result.quantity[quantity].protection_level);
  }
  std::sort(levels.begin(), levels.end());
  return levels[levels.size() / 2];
}

// Behind the face the sixteen rings show no floor, and behind the machine none that is near. In a single frame it may
// be a ramp: 12 degrees. But 4 m before, the floor was seen where the machine stands now.
TEST(RoadMemory, TheFloorIsKnownBeforeTheFace) {
  const std::vector<JudgedFrame> frames = drive("nominal", "vlp16", 1.0, 60);
  expect_sound(frames);
  EXPECT_LT(median_level(frames, 45, POSE_WALL_ROLL), 3.0 * kRadPerDeg);
  EXPECT_LT(median_level(frames, 45, POSE_WALL_PITCH), 3.0 * kRadPerDeg);
}

TEST(RoadMemory, AStandingMachineLosesNothing) {
  expect_sound(drive("rough", "vlp16", 0.0, 30));
}

}  // namespace
}  // namespace pose_wall::test

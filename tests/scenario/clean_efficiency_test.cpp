// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: on clean roads of random sizes and poses the root mean square error of each of the seven quantities stays
// within 1.3 times the Cramer-Rao bound of the very points used: floor within the reported radius, walls within their
// reported span. Does not prove anything about rough rock, which hides the range noise.

#include <gtest/gtest.h>

#include <cmath>

#include "study/truth/efficiency.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

// 240 frames, each with its own noise: the ratio is known to 1 / sqrt(2 * 240) = 4.6 % (1 sigma) where the errors are
// Gaussian. kAllowed is the promise itself, without that margin on top.
constexpr double kAllowed = 1.3;
constexpr std::uint32_t kDraws = 24;
constexpr std::uint32_t kFrames = 10;

struct Eyes {
  const char* sensor;
  bool sparse;
};

class CleanEfficiency : public ::testing::TestWithParam<Eyes> {};

tools::View view_of(const pose_wall_result& r) {
  return {r.floor.d_m,
          r.floor.extent_max_m,
          {{{r.left.extent_min_m, r.left.extent_max_m}, {r.right.extent_min_m, r.right.extent_max_m}}}};
}

void add_draw(std::uint64_t seed, const Eyes& eyes, tools::Efficiency* out) {
  const sim::SceneSetup setup = sim::make_setup("clean", eyes.sensor, true, seed);
  const sim::Simulator simulator(setup, seed);
  const pose_wall_config settings = config_for(setup, eyes.sparse ? sparse_config() : config_with());
  EngineUnderTest engine(settings);
  api::Config config;
  *config.get() = settings;
  const tools::CramerRao bounds(config, setup.sensor.range_noise_m);
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const sim::Frame frame = simulator.render(i);
    const tools::TruthRow truth = simulator.truth(i);
    const pose_wall_cloud cloud = cloud_of(frame);
    const pose_wall_result result = engine.process(cloud);
    const tools::FrameBound bound = bounds.bound(cloud, truth.value, view_of(result));
    out->add(bound);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      out->quantity[q].add(result.quantity[q].raw - truth.value[q], bound.sigma[q]);
    }
  }
}

TEST_P(CleanEfficiency, WithinThePromisedFactorOfTheBound) {
  tools::Efficiency efficiency;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) add_draw(seed, GetParam(), &efficiency);
  EXPECT_TRUE(efficiency.is_believable()) << efficiency.noise_ratio;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const tools::EfficiencySums& sums = efficiency.quantity[q];
    EXPECT_EQ(sums.frames(), kDraws * kFrames) << pose_wall_quantity_name(q);
    EXPECT_LE(sums.ratio(), kAllowed) << pose_wall_quantity_name(q) << " of " << GetParam().sensor;
    // Far below 1, the bound or the test would be wrong: five standard deviations of the ratio.
    EXPECT_GE(sums.ratio(), 0.75) << pose_wall_quantity_name(q) << " of " << GetParam().sensor;
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, CleanEfficiency,
                         ::testing::Values(Eyes{"os0-128", false}, Eyes{"os1-64", false}, Eyes{"vlp16", true}));

}  // namespace
}  // namespace pose_wall::test

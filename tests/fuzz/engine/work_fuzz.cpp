// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: halls and roads whose frames cost much. The fuzzer is shown the steps that a frame takes as if they were
// code it has reached, so that it keeps what costs more than anything before; a frame beyond the computed bound is a
// finding.

#include "fuzz/fuzz_target.hpp"
#include "fuzz/road_from_input.hpp"
#include "support/dear_clouds.hpp"
#include "support/work_bound.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

// Together 12.8 million steps, twice what a simulated road by an OS1-64 takes.
constexpr std::uint32_t kCounters = 256;
constexpr std::uint64_t kStepsPerCounter = 50'000;

#if defined(__clang__) && defined(__linux__)
__attribute__((section("__libfuzzer_extra_counters"), used))
#endif
std::uint8_t g_reached[kCounters];

void show(std::uint64_t work) {
  const std::uint64_t reached = work / kStepsPerCounter;
  for (std::uint32_t k = 0; k < kCounters; ++k) g_reached[k] = k <= reached ? 1 : 0;
}

Hall hall_by(Input* input) {
  Hall hall;
  hall.seed = input->byte();
  for (double& number : hall.v) number = input->between(0.0, 1.0);
  return hall;
}

void fill_by(Input* input, DearCloud* cloud) {
  constexpr std::uint32_t kPointsMost = 30000;
  cloud->clear();
  const std::uint32_t points = kPointsMost / 4 * (1 + input->below(4));
  if (input->below(4) != 0) {
    hall_by(input).fill(points, cloud);
    return;
  }
  const std::uint32_t count = scan_road(road_by(input), 0);
  for (std::uint32_t i = 0; i < count; ++i) cloud->put(road_points()[i][0], road_points()[i][1], road_points()[i][2]);
}

pose_wall_config small_config() {
  pose_wall_config config;
  pose_wall_config_init(&config);
  require_ok(pose_wall_config_set(&config, "points_max", "20000"), "points_max");
  require_ok(pose_wall_config_set(&config, "ground_inlier_min", "150"), "ground_inlier_min");
  require_ok(pose_wall_config_set(&config, "wall_inlier_min", "250"), "wall_inlier_min");
  return config;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block;
  static DearCloud cloud;
  static const pose_wall_config config = small_config();
  Input input(data, size);
  fill_by(&input, &cloud);
  if (cloud.size() == 0) return 0;
  pose_wall_engine* const engine = open_engine(config, &block, 0xA5);
  std::uint64_t most = 0;
  for (int frame = 0; frame < 2; ++frame) {
    if (frame > 0) cloud.nudge();
    pose_wall_result result = empty_result();
    const pose_wall_cloud described = cloud.at(1 + 100'000'000LL * frame);
    require_ok(pose_wall_process(engine, &described, &result), "process");
    most = most > result.work ? most : result.work;
    require(result.work <= most_of_a_frame(pose_wall::read_settings(config), cloud.size()), "within the bound");
  }
  show(most);
  return 0;
}

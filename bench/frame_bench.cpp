// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A whole frame through the C ABI, as a controller calls it; per sensor, with the share of each stage.

#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "bench_frames.hpp"

namespace pose_wall::bench {
namespace {

// Enough that the engine never sees a frame it would take for a repeat.
constexpr std::uint32_t kFrames = 8;
constexpr std::int64_t kPeriod_ns = 100'000'000;

std::int64_t steady_ns(void* /*user*/) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void frame_through_the_engine(benchmark::State& state, const std::string& sensor) {
  const auto& frames = bench::frames(sensor, kFrames);
  api::Engine engine;
  if (engine.open(config(sensor)) != POSE_WALL_OK) return state.SkipWithError("the engine refused its config");
  engine.set_clock(steady_ns);

  pose_wall_result result = api::make_result();
  std::array<double, POSE_WALL_STAGES> stage_ms{};
  std::int64_t stamp_ns = 0;
  std::size_t next = 0;
  double measured = 0.0;
  for (auto _ : state) {
    const pose_wall_cloud cloud = cloud_of(frames[next], stamp_ns += kPeriod_ns);
    next = (next + 1) % frames.size();
    if (engine.process(cloud, result) != POSE_WALL_OK) return state.SkipWithError("the engine refused a cloud");
    for (std::size_t i = 0; i < stage_ms.size(); ++i) stage_ms[i] += static_cast<double>(result.stage_ns[i]) * 1e-6;
    for (const pose_wall_value& value : result.quantity) measured += value.state >= POSE_WALL_DEGRADED ? 1.0 : 0.0;
  }
  for (std::uint32_t i = 0; i < POSE_WALL_STAGES; ++i) {
    state.counters[std::string("ms_") + pose_wall_stage_name(i)] =
        benchmark::Counter(stage_ms[i], benchmark::Counter::kAvgIterations);
  }
  state.counters["points"] = result.points_in;
  state.counters["voxels"] = result.voxels;
  // A fast frame that measures nothing is no achievement.
  state.counters["measured_of_7"] = benchmark::Counter(measured, benchmark::Counter::kAvgIterations);
}

BENCHMARK_CAPTURE(frame_through_the_engine, vlp_16, "vlp16")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_through_the_engine, mid_360, "mid360")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_through_the_engine, os1_64, "os1-64")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame_through_the_engine, os0_128, "os0-128")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pose_wall::bench

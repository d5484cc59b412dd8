// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Each stage of the pipeline by itself, over the points of a frame. N, which items per second and complexity are told
// of, is what the stage is given: points, then voxels, then those of the wall band. *_BigO is the straight line through
// the times, ns a point, and *_RMS how far they are from it: much where a bounded part outweighs, and where a frame
// has more voxels than there is room for and is read twice (131000).

#include <benchmark/benchmark.h>

#include <map>
#include <memory>

#include "stage_pipeline.hpp"

namespace pose_wall::bench {
namespace {

StagePipeline& pipeline(const benchmark::State& state) {
  static std::map<std::int64_t, std::unique_ptr<StagePipeline>> made;
  std::unique_ptr<StagePipeline>& one = made[state.range(0)];
  if (!one) one = std::make_unique<StagePipeline>(static_cast<std::uint32_t>(state.range(0)));
  return *one;
}

void tell(benchmark::State& state, std::uint32_t given) {
  state.counters["N"] = given;
  state.SetComplexityN(given);
  state.SetItemsProcessed(state.iterations() * given);
}

void stage_1_voxels(benchmark::State& state) {
  StagePipeline& p = pipeline(state);
  for (auto _ : state) p.build_voxels();
  p.remove_outliers();  // the later stages' cloud is without them
  tell(state, p.points());
}

void stage_2_outliers(benchmark::State& state) {
  StagePipeline& p = pipeline(state);
  for (auto _ : state) {
    state.PauseTiming();
    p.build_voxels();
    state.ResumeTiming();
    benchmark::DoNotOptimize(p.remove_outliers());
  }
  tell(state, p.voxels());
}

void stage_3_ground(benchmark::State& state) {
  StagePipeline& p = pipeline(state);
  for (auto _ : state) benchmark::DoNotOptimize(p.find_floor());
  tell(state, p.clean_voxels());
}

void stage_4_band(benchmark::State& state) {
  StagePipeline& p = pipeline(state);
  if (!p.has_floor()) return state.SkipWithError("so few points show no floor");
  for (auto _ : state) p.cut_band();
  tell(state, p.clean_voxels());
}

void stage_5_walls(benchmark::State& state) {
  StagePipeline& p = pipeline(state);
  if (!p.has_floor()) return state.SkipWithError("so few points show no floor");
  WallsResult walls;
  for (auto _ : state) benchmark::DoNotOptimize(walls = p.find_walls());
  int found = 0;
  for (const JudgedWall& wall : walls.side) found += wall.fit.found && !wall.fit.refused ? 1 : 0;
  state.counters["walls"] = found;
  tell(state, p.band_points());
}

void over_points(benchmark::internal::Benchmark* stage) {
  for (const std::int64_t points : {5'000, 16'000, 32'000, 65'000, 131'000}) stage->Arg(points);
  stage->ArgName("points")->Unit(benchmark::kMicrosecond)->Complexity(benchmark::oN);
}

BENCHMARK(stage_1_voxels)->Apply(over_points);
BENCHMARK(stage_2_outliers)->Apply(over_points);
BENCHMARK(stage_3_ground)->Apply(over_points);
BENCHMARK(stage_4_band)->Apply(over_points);
BENCHMARK(stage_5_walls)->Apply(over_points);

}  // namespace
}  // namespace pose_wall::bench

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Each stage of the pipeline by itself, on what the stages before it made of one frame. White box: calls the stages
// as engine.cpp does.

#include <benchmark/benchmark.h>

#include <vector>

#include "bench_frames.hpp"
#include "engine.hpp"
#include "stages/ground.hpp"
#include "stages/level.hpp"
#include "stages/outliers.hpp"
#include "stages/voxel.hpp"
#include "stages/walls.hpp"

namespace pose_wall::bench {
namespace {

constexpr const char* kSensor = "os1-64";
constexpr std::int64_t kStamp_ns = 1;

struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
  unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
};

// One frame, taken through all stages once; each benchmark then repeats its own.
struct Pipeline {
  Settings settings = read_settings(*config(kSensor).get());
  Axes axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  Extrinsic extrinsic{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  pose_wall_cloud cloud = cloud_of(frames(kSensor, 1).front(), kStamp_ns);
  std::vector<Line> block;
  Scratch scratch;
  PointSet all_voxels;  // before the outliers went
  FloorResult floor;
  LevelResult level;

  Pipeline() {
    lay_out(nullptr);
    lay_out(&block);
    voxels();
    save_voxels();
    outliers();
    floor = ground();
    level = level_by(floor.fit.plane, axes);
    cut_band();
  }

  void voxels() {
    build_voxels(cloud, settings, extrinsic, axes, &scratch.grid, &scratch.returns_lidar, &scratch.cloud_base);
  }

  std::uint32_t outliers() {
    return remove_outliers(settings, settings.voxel_leaf, &scratch.cells, scratch.marks, &scratch.cloud_base);
  }

  FloorResult ground() {
    Random random(1);
    return find_floor(scratch.cloud_base, settings, axes, extrinsic.sensor_base_m, nullptr, &random, &scratch.ground);
  }

  void cut_band() {
    cut_wall_band(scratch.cloud_base, level, settings, &scratch.grid, &scratch.band_level, &scratch.beyond_level);
  }

  WallsResult walls() {
    Random random(1);
    const Plane* const no_last[2] = {nullptr, nullptr};
    const WallScene scene = wall_scene(scratch.band_level, scratch.beyond_level, scratch.cloud_base,
                                       scratch.returns_lidar, settings, level, axes, extrinsic);
    return find_walls(scene, no_last, &random, &scratch.walls);
  }

  void restore_voxels() {
    scratch.cloud_base.count = all_voxels.count;
    for (std::uint32_t i = 0; i < all_voxels.count; ++i)
      scratch.cloud_base.set(i, all_voxels.at(i), all_voxels.weight[i]);
  }

 private:
  // Without a block the walk only measures.
  void lay_out(std::vector<Line>* into) {
    Arena arena(into != nullptr ? into->data() : nullptr);
    scratch.lay_out(arena, settings.points_max);
    all_voxels.lay_out(arena, settings.points_max);
    if (into == nullptr) {
      block.resize(arena.bytes() / sizeof(Line) + 1);
    } else {
      scratch.reset();
    }
  }

  void save_voxels() {
    all_voxels.count = scratch.cloud_base.count;
    for (std::uint32_t i = 0; i < all_voxels.count; ++i) {
      all_voxels.set(i, scratch.cloud_base.at(i), scratch.cloud_base.weight[i]);
    }
  }
};

Pipeline& pipeline() {
  static Pipeline made;
  return made;
}

void stage_1_voxels(benchmark::State& state) {
  for (auto _ : state) pipeline().voxels();
  pipeline().outliers();  // the later stages' cloud is without them
  state.counters["points"] = pipeline().cloud.width;
  state.counters["voxels"] = pipeline().all_voxels.count;
}

void stage_2_outliers(benchmark::State& state) {
  Pipeline& p = pipeline();
  for (auto _ : state) {
    state.PauseTiming();
    p.restore_voxels();
    state.ResumeTiming();
    benchmark::DoNotOptimize(p.outliers());
  }
}

void stage_3_ground(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(pipeline().ground());
  state.counters["inliers"] = pipeline().floor.fit.inliers;
}

void stage_4_band(benchmark::State& state) {
  Pipeline& p = pipeline();
  for (auto _ : state) p.cut_band();
  state.counters["wall_points"] = p.scratch.band_level.count;
}

void stage_5_walls(benchmark::State& state) {
  WallsResult walls;
  for (auto _ : state) benchmark::DoNotOptimize(walls = pipeline().walls());
  state.counters["inliers_left"] = walls.side[0].fit.inliers;
  state.counters["inliers_right"] = walls.side[1].fit.inliers;
}

BENCHMARK(stage_1_voxels)->Unit(benchmark::kMicrosecond);
BENCHMARK(stage_2_outliers)->Unit(benchmark::kMicrosecond);
BENCHMARK(stage_3_ground)->Unit(benchmark::kMicrosecond);
BENCHMARK(stage_4_band)->Unit(benchmark::kMicrosecond);
BENCHMARK(stage_5_walls)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace pose_wall::bench

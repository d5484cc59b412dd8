// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stage_pipeline.hpp"

#include "bench_frames.hpp"
#include "engine/cloud/outliers.hpp"
#include "engine/cloud/voxels.hpp"
#include "engine/floor/floor.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/walls/walls.hpp"

namespace pose_wall::bench {
namespace {

constexpr const char* kSensor = "os0-128";
constexpr std::int64_t kStamp_ns = 1;

// Frames of few points need what sensors of few points need; as config/vlp16.yaml.
constexpr std::uint32_t kFew = 10'000;

api::Config config_for(std::uint32_t points) {
  api::Config out = config(kSensor);
  if (points >= kFew) return out;
  out.set("outlier_radius", 0.40);
  out.set("outlier_min_neighbors", 2.0);
  out.set("ground_inlier_min", 150.0);
  out.set("wall_inlier_min", 250.0);
  return out;
}

}  // namespace

// The simulated frames are in base already, and the machine faces +X.
StagePipeline::StagePipeline(std::uint32_t points)
    : settings_(read_settings(*config_for(points).get())),
      axes_{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()},
      extrinsic_{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()},
      frame_(resampled(frames(kSensor, 1).front(), points)),
      cloud_(cloud_of(frame_, kStamp_ns)) {
  lay_out(nullptr);
  lay_out(&block_);
  build_voxels();
  all_voxels_ = scratch_.cloud_base.count;
  remove_outliers();
  floor_ = find_floor();
  if (!has_floor()) return;
  level_ = levelling_by(floor_.fit.plane, axes_);
  cut_band();
}

void StagePipeline::build_voxels() {
  voxels_ = pose_wall::build_voxels(cloud_, nullptr, settings_, extrinsic_, axes_, {}, &scratch_.grid,
                                    {&scratch_.returns_lidar, scratch_.print}, &scratch_.cloud_base);
}

std::uint32_t StagePipeline::remove_outliers() {
  Work work;
  return pose_wall::remove_outliers(settings_, &scratch_.grid, scratch_.marks, &scratch_.cloud_base, &work);
}

FloorResult StagePipeline::find_floor() {
  Random random(1);
  return pose_wall::find_floor({scratch_.cloud_base, settings_, axes_, extrinsic_.sensor_base_m, nullptr}, &random,
                               &scratch_.floor);
}

void StagePipeline::cut_band() {
  cut_wall_band(scratch_.cloud_base, level_, settings_, &scratch_.grid, &scratch_.band_level, &scratch_.beyond_level);
}

WallsResult StagePipeline::find_walls() {
  Random random(1);
  const Plane* const no_last[2] = {nullptr, nullptr};
  const WallScene scene = wall_scene(
      {scratch_.band_level, scratch_.beyond_level, scratch_.cloud_base, scratch_.returns_lidar, voxels_.counts},
      settings_, level_, axes_, extrinsic_);
  return pose_wall::find_walls(scene, no_last, &random, &scratch_.walls);
}

// Without a block the walk only measures.
void StagePipeline::lay_out(std::vector<Line>* into) {
  Arena arena(into != nullptr ? into->data() : nullptr);
  scratch_.lay_out(arena, settings_.points_max);
  if (into == nullptr) block_.resize(arena.bytes() / sizeof(Line) + 1);
}

}  // namespace pose_wall::bench

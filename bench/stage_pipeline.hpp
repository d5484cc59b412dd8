// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One frame taken through all stages once, as engine.cpp does; each benchmark then repeats its own stage. White box.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/engine.hpp"
#include "lab/sim/simulator.hpp"

namespace pose_wall::bench {

class StagePipeline {
 public:
  // Of a dense sensor's frame with so many points.
  explicit StagePipeline(std::uint32_t points);
  StagePipeline(const StagePipeline&) = delete;
  StagePipeline& operator=(const StagePipeline&) = delete;

  // Without a floor there is nothing to level by, and the stages behind it have nothing to do.
  bool has_floor() const { return !floor_.fit.refused; }

  void build_voxels();
  std::uint32_t remove_outliers();
  FloorResult find_floor();
  void cut_band();
  WallsResult find_walls();

  std::uint32_t points() const { return cloud_.width; }
  std::uint32_t voxels() const { return all_voxels_; }
  std::uint32_t clean_voxels() const { return scratch_.cloud_base.count; }
  std::uint32_t band_points() const { return scratch_.band_level.count; }

 private:
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };

  void lay_out(std::vector<Line>* into);

  Settings settings_;
  Axes axes_;
  Extrinsic extrinsic_;
  tools::sim::Frame frame_;
  pose_wall_cloud cloud_;
  std::vector<Line> block_;
  Scratch scratch_;
  std::uint32_t all_voxels_ = 0;
  VoxelResult voxels_;
  FloorResult floor_;
  Levelling level_;
};

}  // namespace pose_wall::bench

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From what the stages found to the public result.

#pragma once

#include "pose_wall.h"
#include "stages/walls.hpp"
#include "types.hpp"

namespace pose_wall {

// Everything a frame produced, by stage.
struct FrameFindings {
  std::int64_t stamp_ns = 0;
  std::uint32_t reasons = 0;
  std::uint64_t work = 0;  // steps, see containers/work.hpp
  std::uint32_t outliers = 0;
  std::uint32_t wall_points = 0;
  VoxelResult voxels;
  FloorResult floor;
  LevelResult level;
  WallsResult walls;
  Measurements measured;
};

// Fills all but quantity, stage_ns and frame_index.
void report_findings(const FrameFindings& found, pose_wall_result* result);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From the stages' findings to the public result.

#pragma once

#include "engine/cloud/voxels.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/floor/result.hpp"
#include "engine/output/measurements.hpp"
#include "engine/walls/wall.hpp"
#include "pose_wall.h"

namespace pose_wall {

// Everything a frame produced, by stage.
struct FrameFindings {
  std::int64_t stamp_ns = 0;
  std::uint32_t reasons = 0;
  std::uint64_t work = 0;  // steps, see base/containers/work.hpp
  std::uint32_t outliers = 0;
  std::uint32_t wall_points = 0;
  VoxelResult voxels;
  FloorResult floor;
  Levelling levelling;
  MeasuredWalls walls;
  Measurements measured;
};

// Sets the meaning of positive roll, pitch and yaw for the driver.
void set_senses(std::int32_t forward_choice, std::uint32_t (*positive_means)[3]);

// A checksum of a result's head. Each result of an engine carries it. It separates results from other memory, and is no
// signature.
std::uint32_t mark_of(const pose_wall_result& result);

// Fills all but quantity, stage_ns and frame_index.
void report_findings(const FrameFindings& found, pose_wall_result* result);

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From the caller's cloud to a frame of ours: only the fields that the engine reads, only points that hold a return.

#pragma once

#include <cstdint>

#include "frame_slot.hpp"
#include "pose_wall.h"

namespace pose_wall::runtime {

// Beside x, y and z.
struct CopiedFields {
  bool intensity = false;
  // Where they fit the point's bytes, time before ring.
  bool time = false, ring = false;
  std::uint32_t point_bytes_max = 0;
};

// Bytes of a point as it must be copied at least: without time and ring.
std::uint32_t packed_bytes(const pose_wall_cloud& cloud, bool with_intensity);

// The cloud's description was checked, and its points fit slot->points. Sets cloud, inputs and left_out_* of the slot.
// With intensity every point is kept but for thinning: no-returns count in the mean that brightness is measured
// against. Nor are the first and the last of them left out where times are copied.
void copy_frame(const pose_wall_cloud& cloud, const CopiedFields& fields, std::uint32_t thinning, FrameSlot* slot);

}  // namespace pose_wall::runtime

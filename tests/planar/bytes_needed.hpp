// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The bytes that a part asks for, as a number: for blocks that are members.

#pragma once

#include <cstdint>
#include <stdexcept>

#include "pose_wall_planar_plan.h"
#include "pose_wall_planar_stop.h"
#include "pose_wall_planar_track.h"

namespace pose_wall::test {

inline std::uint64_t good_bytes(std::int32_t status, std::uint64_t bytes) {
  if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_planar_status_text(status));
  return bytes;
}

inline std::uint64_t bytes_needed(const pose_wall_planar_plan_settings& settings) {
  std::uint64_t bytes = 0;
  const std::int32_t status = pose_wall_planar_plan_memory_needed(&settings, &bytes);
  return good_bytes(status, bytes);
}
inline std::uint64_t bytes_needed(const pose_wall_planar_track_settings& settings) {
  std::uint64_t bytes = 0;
  const std::int32_t status = pose_wall_planar_track_memory_needed(&settings, &bytes);
  return good_bytes(status, bytes);
}
inline std::uint64_t stop_bytes_needed() {
  std::uint64_t bytes = 0;
  const std::int32_t status = pose_wall_planar_stop_memory_needed(&bytes);
  return good_bytes(status, bytes);
}

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the C ABIs of all parts share.

#include "export.hpp"
#include "pose_wall_planar_types.h"

extern "C" {

POSE_WALL_EXPORT uint32_t pose_wall_planar_abi_version(void) {
  return POSE_WALL_PLANAR_ABI_VERSION;
}

POSE_WALL_EXPORT const char* pose_wall_planar_status_text(int32_t status) {
  switch (status) {
    case POSE_WALL_E_SCAN:
      return "the planar scan's beams, angles or ranges are outside their limits";
    case POSE_WALL_E_POSE:
      return "a pose or a covariance is not finite, or is no covariance";
    case POSE_WALL_E_MAP_FILE:
      return "the saved map is of another version, cut off or damaged";
    case POSE_WALL_E_GRID:
      return "the grid's size, cells or resolution are outside their limits";
    case POSE_WALL_E_ORDER:
      return "the call comes too early or too late";
    default:
      return pose_wall_status_text(status);
  }
}

}  // extern "C"

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
  return pose_wall_status_text(status);
}

}  // extern "C"

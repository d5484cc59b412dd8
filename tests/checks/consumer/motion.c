/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* A user's program that asks how the machine moves: a motion on its block, a frame of no points. */
#include <pose_wall_motion.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
  const uint64_t bytes = pose_wall_motion_memory_needed();
  pose_wall_config config;
  pose_wall_motion* motion = NULL;
  pose_wall_cloud cloud;
  pose_wall_motion_result result;
  char *memory, *block;
  if (pose_wall_motion_abi_version() != POSE_WALL_MOTION_ABI_VERSION) return 1;
  if (pose_wall_config_init(&config) != POSE_WALL_OK) return 2;
  memory = malloc((size_t)bytes + POSE_WALL_BLOCK_ALIGNMENT);
  if (memory == NULL) return 3;
  block = memory + (POSE_WALL_BLOCK_ALIGNMENT - (uintptr_t)memory % POSE_WALL_BLOCK_ALIGNMENT);
  if (pose_wall_motion_open(&config, NULL, block, bytes, &motion) != POSE_WALL_OK) return 4;
  if (pose_wall_cloud_xyz32(&cloud, NULL, 0, 12, 0) != POSE_WALL_OK) return 5;
  result.struct_size = sizeof(result);
  if (pose_wall_motion_process(motion, &cloud, &result) != POSE_WALL_OK) return 6;
  printf("along: %s\n", pose_wall_motion_along_state_name(result.along_state));
  free(memory);
  return result.along_state == POSE_WALL_ALONG_LOST && (result.reasons & POSE_WALL_MOTION_R_FEW_POINTS) != 0 ? 0 : 7;
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* A user's program that asks where a scan was taken: SLAM on its block, a scan of a room, and one more. */
#include <pose_wall_planar.h>
#include <stdio.h>
#include <stdlib.h>

#define BEAMS 360u

int main(void) {
  static float range_m[BEAMS];
  pose_wall_planar_slam_settings settings;
  pose_wall_planar_slam* slam = NULL;
  pose_wall_planar_slam_result result;
  pose_wall_planar_scan scan = {0};
  uint64_t bytes = 0;
  uint32_t k;
  char *memory, *block;
  if (pose_wall_planar_abi_version() != POSE_WALL_PLANAR_ABI_VERSION) return 1;
  if (pose_wall_planar_slam_settings_init(&settings) != POSE_WALL_OK) return 2;
  settings.keyframes_most = 64;
  if (pose_wall_planar_slam_memory_needed(&settings, &bytes) != POSE_WALL_OK) return 3;
  memory = malloc((size_t)bytes + POSE_WALL_BLOCK_ALIGNMENT);
  if (memory == NULL) return 4;
  block = memory + (POSE_WALL_BLOCK_ALIGNMENT - (uintptr_t)memory % POSE_WALL_BLOCK_ALIGNMENT);
  if (pose_wall_planar_slam_open(&settings, block, bytes, &slam) != POSE_WALL_OK) return 5;
  for (k = 0; k < BEAMS; ++k) range_m[k] = 4.0f + 0.01f * (float)(k % 90);
  scan.struct_size = sizeof(scan);
  scan.beams = BEAMS;
  scan.angle_step_rad = 6.283185307179586 / BEAMS;
  scan.range_max_m = 30.0;
  scan.sigma_m = 0.02;
  scan.range_m = range_m;
  result.struct_size = sizeof(result);
  if (pose_wall_planar_slam_process(slam, &scan, NULL, &result) != POSE_WALL_OK) return 6;
  if (pose_wall_planar_slam_process(slam, &scan, NULL, &result) != POSE_WALL_OK) return 7;
  printf("%s\n", pose_wall_planar_slam_state_name(result.state));
  free(memory);
  return result.state == POSE_WALL_PLANAR_SLAM_TRACKED ? 0 : 8;
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints the sizes of include/SIZES.md that a caller provides memory for, a line `COLUMN: NUMBER` each. */

#include <inttypes.h>
#include <stdio.h>

#include "pose_wall.h"
#include "pose_wall_motion.h"

static double mebibytes(uint64_t bytes) {
  return (double)bytes / (1024.0 * 1024.0);
}

static int print_block(unsigned points_max) {
  pose_wall_config config;
  uint64_t bytes;
  if (pose_wall_config_init(&config) != POSE_WALL_OK) return 1;
  if (pose_wall_config_set_number(&config, "points_max", points_max) != POSE_WALL_OK) return 1;
  if (pose_wall_memory_needed(&config, &bytes) != POSE_WALL_OK) return 1;
  printf("engine of %u, MiB: %.2f\n", points_max, mebibytes(bytes));
  return 0;
}

int main(void) {
  if (print_block(16000) || print_block(60000) || print_block(131000)) return 1;
  printf("motion, MiB: %.2f\n", mebibytes(pose_wall_motion_memory_needed()));
  printf("memento, bytes: %" PRIu64 "\n", pose_wall_memento_bytes());
  printf("config, bytes: %zu\n", sizeof(pose_wall_config));
  printf("cloud, bytes: %zu\n", sizeof(pose_wall_cloud));
  printf("result, bytes: %zu\n", sizeof(pose_wall_result));
  printf("motion result, bytes: %zu\n", sizeof(pose_wall_motion_result));
  printf("image, bytes: %zu\n", sizeof(pose_wall_image));
  printf("image 2, bytes: %zu\n", sizeof(pose_wall_image2));
  printf("motion image, bytes: %zu\n", sizeof(pose_wall_motion_image));
  return 0;
}

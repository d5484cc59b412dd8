/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* A user's program around the threads of pose_wall_runtime.h: opens, starts, stops. */
#include <pose_wall_runtime.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
  pose_wall_config config;
  pose_wall_runtime_options options;
  pose_wall_runtime* runtime = NULL;
  uint64_t bytes = 0;
  char *memory, *block;
  if (pose_wall_config_init(&config) != POSE_WALL_OK) return 1;
  if (pose_wall_runtime_options_init(&options) != POSE_WALL_OK) return 2;
  if (pose_wall_runtime_memory_needed(&config, &options, &bytes) != POSE_WALL_OK) return 3;
  memory = malloc((size_t)bytes + POSE_WALL_BLOCK_ALIGNMENT);
  if (memory == NULL) return 4;
  block = memory + (POSE_WALL_BLOCK_ALIGNMENT - (uintptr_t)memory % POSE_WALL_BLOCK_ALIGNMENT);
  if (pose_wall_runtime_open(&config, &options, block, bytes, &runtime) != POSE_WALL_OK) return 5;
  if (pose_wall_runtime_start(runtime) != POSE_WALL_OK) return 6;
  if (pose_wall_runtime_stop(runtime) != POSE_WALL_OK) return 7;
  if (pose_wall_runtime_close(runtime) != POSE_WALL_OK) return 8;
  free(memory);
  puts("the runtime ran");
  return 0;
}

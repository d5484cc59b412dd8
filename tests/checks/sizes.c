/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints the sizes of include/SIZES.md that a caller provides memory for, a line `COLUMN: NUMBER` each. */

#include <inttypes.h>
#include <stdio.h>

#include "pose_wall.h"
#include "pose_wall_motion.h"
#include "pose_wall_planar.h"

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

static void print_planar(const char* part, uint64_t bytes) {
  printf("planar %s, MiB: %.2f\n", part, mebibytes(bytes));
}

/* With their defaults. A kilometre of road takes some 3300 keyframes, 664 tiles of the map and 300 of a localisation's.
 */
static int print_planar_blocks(void) {
  pose_wall_planar_scanner_settings scanner;
  pose_wall_planar_plan_settings plan;
  pose_wall_planar_track_settings track;
  uint64_t scan, match, slam, map, localise, route, drive, stop;
  if (pose_wall_planar_scanner_settings_init(&scanner) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_plan_settings_init(&plan) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_track_settings_init(&track) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_scanner_memory_needed(&scanner, &scan) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_match_memory_needed(&match) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_slam_memory_needed(NULL, &slam) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_map_memory_needed(NULL, &map) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_localise_memory_needed(NULL, &localise) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_plan_memory_needed(&plan, &route) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_track_memory_needed(&track, &drive) != POSE_WALL_OK) return 1;
  if (pose_wall_planar_stop_memory_needed(&stop) != POSE_WALL_OK) return 1;
  print_planar("scan", scan);
  print_planar("match", match);
  print_planar("SLAM", slam);
  print_planar("map", map);
  print_planar("localise", localise);
  print_planar("plan", route);
  print_planar("track", drive);
  print_planar("stop", stop);
  return 0;
}

int main(void) {
  if (print_block(16000) || print_block(60000) || print_block(131000)) return 1;
  printf("motion, MiB: %.2f\n", mebibytes(pose_wall_motion_memory_needed()));
  if (print_planar_blocks()) return 1;
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

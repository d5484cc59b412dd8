/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * Two versions of the library in one program: this one, and one of a later day whose blocks are aligned to 128 bytes
 * and whose functions were renamed second_*. Each has to run its own code, down to its own inline functions.
 */

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "pose_wall.h"
#include "roadway.h"

const char* second_pose_wall_version(void);
int32_t second_pose_wall_config_init_2(pose_wall_config* config);
int32_t second_pose_wall_open(const pose_wall_config* config, void* block, uint64_t bytes, pose_wall_engine** engine);
int32_t second_pose_wall_self_test(void* block, uint64_t bytes, pose_wall_self_test_report* report);
int32_t second_pose_wall_process(pose_wall_engine* engine, const pose_wall_cloud* cloud, pose_wall_result* result);

static unsigned char first_block[8u << 20] __attribute__((aligned(128)));
static unsigned char second_block[8u << 20] __attribute__((aligned(128)));
static float points[ROADWAY_POINTS_MAX][3];
static int failed;

static void expect(int holds, const char* what) {
  if (!holds) {
    printf("%s\n", what);
    failed = 1;
  }
}

static void same_frame(pose_wall_engine* first, pose_wall_engine* second) {
  const uint32_t count = roadway_scan(roadways[0], 0, points);
  pose_wall_cloud cloud;
  pose_wall_cloud_xyz32(&cloud, points, count, sizeof points[0], 0);
  pose_wall_result a, b;
  a.struct_size = b.struct_size = sizeof a;
  expect(pose_wall_process(first, &cloud, &a) == POSE_WALL_OK, "the first version refused a frame");
  expect(second_pose_wall_process(second, &cloud, &b) == POSE_WALL_OK, "the second version refused a frame");
  expect(memcmp(&a, &b, sizeof a) == 0, "the two versions differ in a frame's result");
  expect(a.floor.found == 1, "the frame shows no floor");
}

/* Each sums up its own code, which is not the other's. */
static void own_code(void) {
  pose_wall_self_test_report a, b;
  a.struct_size = b.struct_size = sizeof a;
  expect(pose_wall_self_test(first_block, sizeof first_block, &a) == POSE_WALL_OK, "the first fails its self test");
  second_pose_wall_self_test(second_block, sizeof second_block, &b); /* its digest may tell another version */
  expect(b.frames == a.frames && b.values_wrong == 0, "the second measures wrongly in its self test");
  expect(a.code_bytes > 0 && b.code_bytes > 0 && a.code_bytes != b.code_bytes, "both sum up the same code");
}

int main(void) {
  pose_wall_config config, second_config;
  pose_wall_config_init(&config);
  second_pose_wall_config_init_2(&second_config);
  expect(strcmp(pose_wall_version(), second_pose_wall_version()) != 0, "both say they are the same version");
  pose_wall_engine *first = NULL, *second = NULL;
  const uint64_t bytes = sizeof first_block - 64;
  expect(pose_wall_open(&config, first_block + 64, bytes, &first) == POSE_WALL_OK, "the first asks for 128 bytes, too");
  expect(second_pose_wall_open(&second_config, second_block + 64, bytes, &second) == POSE_WALL_E_BLOCK_ALIGN,
         "the second is content with 64 bytes, too");
  expect(second_pose_wall_open(&second_config, second_block, bytes, &second) == POSE_WALL_OK,
         "the second does not open");
  if (failed == 0) same_frame(first, second);
  own_code();
  return failed;
}

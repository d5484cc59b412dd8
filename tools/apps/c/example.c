/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * The engine from plain C: one static block, one frame, seven values.
 *
 *     cc -std=c99 -Iinclude tools/apps/c/example.c build/release/libpose_wall.a -lm -o example
 *     ./example             a roadway 4 m wide, the machine turned left by 3 degrees
 *     ./example frame.xyz   points from a file: native float32 x y z, 12 bytes each
 */

#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "pose_wall.h"

#define POINTS_MAX 200000
#define BLOCK_BYTES (5 * 1024 * 1024) /* pose_wall_memory_needed says how much; 4.6 MiB by default */

static float points[POINTS_MAX][3];

/* C99 has no alignment keyword: take more, and start at the first aligned byte. */
static unsigned char memory[BLOCK_BYTES + POSE_WALL_BLOCK_ALIGNMENT];

static void* aligned_block(void) {
  const uintptr_t alignment = POSE_WALL_BLOCK_ALIGNMENT;
  const uintptr_t start = (uintptr_t)memory;
  return memory + (alignment - start % alignment) % alignment;
}

static const double pi = 3.14159265358979;

/* One scan of a straight roadway, from 1 m above the floor by a machine turned left: rays at even angles, each to the
 * first surface. Points spread evenly over the walls would look full of holes, and so would walls without a roof. */
static uint32_t make_roadway(void) {
  const double half_width_m = 2.0, floor_m = -1.0, roof_m = 1.8, turned_left_rad = 3.0 * pi / 180.0;
  const double c = cos(turned_left_rad), s = sin(turned_left_rad);
  uint32_t count = 0;
  for (int ring = 0; ring < 64; ++ring) {
    for (int column = 0; column < 1024 && count < POINTS_MAX; ++column) {
      const double up = (-22.5 + 45.0 * ring / 63.0) * pi / 180.0, round = 2.0 * pi * column / 1024.0;
      const double ray[3] = {cos(up) * cos(round), cos(up) * sin(round), sin(up)};
      const double to_wall_m = half_width_m / fmax(fabs(ray[1]), 1e-9);
      const double to_level_m = (ray[2] < 0.0 ? floor_m : roof_m) / ray[2];
      const double range_m = fmin(to_wall_m, to_level_m);
      if (range_m > 60.0) continue;
      points[count][0] = (float)(range_m * (c * ray[0] + s * ray[1]));
      points[count][1] = (float)(range_m * (-s * ray[0] + c * ray[1]));
      points[count][2] = (float)(range_m * ray[2]);
      ++count;
    }
  }
  return count;
}

static uint32_t read_points(const char* path) {
  FILE* file = fopen(path, "rb");
  if (file == NULL) return 0;
  const size_t count = fread(points, sizeof points[0], POINTS_MAX, file);
  fclose(file);
  return (uint32_t)count;
}

static int refuse(const char* call, int32_t status) {
  fprintf(stderr, "%s: %s\n", call, pose_wall_status_text(status));
  return 1;
}

static void print_result(const pose_wall_result* result) {
  for (uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value* value = &result->quantity[q];
    const int is_angle = q <= POSE_WALL_YAW;
    const double scale = is_angle ? 180.0 / pi : 1.0;
    printf("%-6s %8.3f %-3s within %.3f  %s", pose_wall_quantity_name(q), value->value * scale, is_angle ? "deg" : "m",
           value->protection_level * scale, pose_wall_state_name(value->state));
    for (uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
      if (value->reasons >> bit & 1U) printf(" %s", pose_wall_reason_name(bit));
    }
    printf("\n");
  }
}

int main(int argc, char** argv) {
  const uint32_t count = argc > 1 ? read_points(argv[1]) : make_roadway();
  if (count == 0) {
    fprintf(stderr, "no points could be read\n");
    return 1;
  }

  pose_wall_config config;
  pose_wall_config_init(&config);
  int32_t status = pose_wall_config_set(&config, "forward_axis", "+X");
  if (status != POSE_WALL_OK) return refuse("pose_wall_config_set", status);

  pose_wall_engine* engine = NULL;
  status = pose_wall_open(&config, aligned_block(), BLOCK_BYTES, &engine);
  if (status != POSE_WALL_OK) return refuse("pose_wall_open", status);

  pose_wall_cloud cloud;
  status = pose_wall_cloud_xyz32(&cloud, points, count, sizeof points[0], 0);
  if (status != POSE_WALL_OK) return refuse("pose_wall_cloud_xyz32", status);

  pose_wall_result result;
  result.struct_size = sizeof result;
  status = pose_wall_process(engine, &cloud, &result);
  if (status != POSE_WALL_OK) return refuse("pose_wall_process", status);
  print_result(&result);
  /* Of the roadway above every value is known. */
  return argc > 1 || result.quantity[POSE_WALL_YAW].state == POSE_WALL_VALID ? 0 : 1;
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints what a motion makes of the first frames of each roadway, a line each as pose_wall_digest does: the digest is
 * over every byte of the results, and of the map in the end. Values: the frames after the first, of which so many were
 * measured. */

#include <stdio.h>
#include <stdlib.h>

#include "digest.h"
#include "pose_wall_motion.h"

#define FRAMES 8u
#define MAP_POINTS 4096u
#define BLOCK_BYTES (6u << 20)

static uint64_t block[BLOCK_BYTES / sizeof(uint64_t)] __attribute__((aligned(POSE_WALL_BLOCK_ALIGNMENT)));
static float scanned[ROADWAY_POINTS_MAX][3];
static float map[MAP_POINTS][3];

static uint64_t hashed(uint64_t hash, const void* data, uint64_t bytes) { /* FNV-1a */
  const unsigned char* const byte = data;
  for (uint64_t i = 0; i < bytes; ++i) hash = (hash ^ byte[i]) * 0x100000001B3u;
  return hash;
}

static int32_t open_motion(const roadway* road, pose_wall_motion** motion) {
  pose_wall_config config;
  int32_t status = pose_wall_config_init(&config);
  for (uint32_t k = 0; road->settings[k].key != NULL && status == POSE_WALL_OK; ++k) {
    status = pose_wall_config_set(&config, road->settings[k].key, road->settings[k].value);
  }
  return status == POSE_WALL_OK ? pose_wall_motion_open(&config, NULL, block, sizeof block, motion) : status;
}

static int32_t take_frame(digest* d, pose_wall_motion* motion, uint32_t count) {
  pose_wall_cloud cloud;
  pose_wall_motion_result result;
  int32_t status = pose_wall_cloud_xyz32(&cloud, scanned, count, sizeof scanned[0], (int64_t)d->frames * 100000000);
  result.struct_size = sizeof result;
  if (status == POSE_WALL_OK) status = pose_wall_motion_process(motion, &cloud, &result);
  if (status != POSE_WALL_OK) return status;
  d->input = hashed(d->input, scanned, (uint64_t)count * sizeof scanned[0]);
  d->output = hashed(d->output, &result, sizeof result);
  d->values += d->frames > 0 ? 1 : 0;
  d->measured += d->frames > 0 && result.along_state == POSE_WALL_ALONG_MEASURED ? 1 : 0;
  d->frames += 1;
  d->points += count;
  return status;
}

static int32_t take_map(digest* d, const pose_wall_motion* motion) {
  uint32_t total = 0;
  int32_t status = pose_wall_motion_map(motion, 0, NULL, 0, &total);
  for (uint32_t first = 0; first < total && status == POSE_WALL_OK; first += MAP_POINTS) {
    const uint32_t count = total - first < MAP_POINTS ? total - first : MAP_POINTS;
    status = pose_wall_motion_map(motion, first, map[0], count, &total);
    d->output = hashed(d->output, map, (uint64_t)count * sizeof map[0]);
  }
  return status;
}

int main(void) {
  for (uint32_t k = 0; k < roadway_count; ++k) {
    const uint64_t start = 0xCBF29CE484222325u;
    digest d = {roadways[k]->name, 0, 0, start, start, 0, 0};
    pose_wall_motion* motion = NULL;
    int32_t status = open_motion(roadways[k], &motion);
    while (d.frames < FRAMES && status == POSE_WALL_OK) {
      status = take_frame(&d, motion, roadway_scan(roadways[k], (uint32_t)d.frames, scanned));
    }
    if (status == POSE_WALL_OK) status = take_map(&d, motion);
    if (status != POSE_WALL_OK) {
      fprintf(stderr, "%s: the motion refused it with status %d\n", d.name, (int)status);
      return EXIT_FAILURE;
    }
    char line[DIGEST_LINE_BYTES];
    fwrite(line, 1, digest_line(&d, &line), stdout);
  }
  return EXIT_SUCCESS;
}

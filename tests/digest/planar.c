/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints what the planar library makes of the first frames of each roadway, a line each as pose_wall_digest does. The
 * digest is over every range of the scans, every result of SLAM and stop, the saved trail and the saved map. Values:
 * the scans after the first, of which so many were tracked. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "digest.h"
#include "pose_wall_planar.h"

#define FRAMES 8u
#define BLOCKS 5u

static float scanned[ROADWAY_POINTS_MAX][3];
static void* taken[BLOCKS]; /* of one roadway */

typedef struct parts {
  pose_wall_engine* engine;
  pose_wall_planar_scanner* scanner;
  pose_wall_planar_slam* slam;
  pose_wall_planar_map* map;
  pose_wall_planar_stop* stop;
} parts;

static uint64_t hashed(uint64_t hash, const void* data, uint64_t bytes) { /* FNV-1a */
  const unsigned char* const byte = data;
  for (uint64_t i = 0; i < bytes; ++i) hash = (hash ^ byte[i]) * 0x100000001B3u;
  return hash;
}

/* NaN has many bit patterns, and one meaning. */
static uint64_t hashed_ranges(uint64_t hash, const float* range_m, uint32_t count) {
  for (uint32_t k = 0; k < count; ++k) {
    const float nothing = -1.0f;
    hash = hashed(hash, range_m[k] == range_m[k] ? &range_m[k] : &nothing, sizeof(float));
  }
  return hash;
}

static void* block_of(uint32_t number, uint64_t bytes) {
  const size_t whole = (size_t)bytes + POSE_WALL_BLOCK_ALIGNMENT;
  unsigned char* const memory = malloc(whole);
  taken[number] = memory;
  if (memory == NULL) return NULL;
  memset(memory, 0xA5, whole);
  return memory + (POSE_WALL_BLOCK_ALIGNMENT - (uintptr_t)memory % POSE_WALL_BLOCK_ALIGNMENT);
}

static int32_t open_scanner_and_engine(const roadway* road, pose_wall_config* config, parts* p) {
  uint64_t bytes = 0;
  pose_wall_planar_scanner_settings scanning;
  int32_t status = pose_wall_config_init(config);
  for (uint32_t k = 0; road->settings[k].key != NULL && status == POSE_WALL_OK; ++k) {
    status = pose_wall_config_set(config, road->settings[k].key, road->settings[k].value);
  }
  if (status == POSE_WALL_OK) status = pose_wall_memory_needed(config, &bytes);
  if (status == POSE_WALL_OK) status = pose_wall_open(config, block_of(0, bytes), bytes, &p->engine);
  if (status == POSE_WALL_OK) status = pose_wall_planar_scanner_settings_init(&scanning);
  if (status == POSE_WALL_OK) status = pose_wall_planar_scanner_memory_needed(&scanning, &bytes);
  if (status == POSE_WALL_OK) {
    status = pose_wall_planar_scanner_open(config, &scanning, block_of(1, bytes), bytes, &p->scanner);
  }
  return status;
}

static int32_t open_parts(const roadway* road, parts* p) {
  uint64_t bytes = 0;
  pose_wall_config config;
  pose_wall_planar_slam_settings settings;
  pose_wall_planar_stop_settings stopping;
  int32_t status = open_scanner_and_engine(road, &config, p);
  if (status == POSE_WALL_OK) status = pose_wall_planar_slam_settings_init(&settings);
  settings.keyframes_most = 64;
  if (status == POSE_WALL_OK) status = pose_wall_planar_slam_memory_needed(&settings, &bytes);
  if (status == POSE_WALL_OK) status = pose_wall_planar_slam_open(&settings, block_of(2, bytes), bytes, &p->slam);
  if (status == POSE_WALL_OK) status = pose_wall_planar_map_memory_needed(NULL, &bytes);
  if (status == POSE_WALL_OK) status = pose_wall_planar_map_open(NULL, block_of(3, bytes), bytes, &p->map);
  if (status == POSE_WALL_OK) status = pose_wall_planar_stop_settings_init(&stopping);
  if (status == POSE_WALL_OK) status = pose_wall_planar_stop_memory_needed(&bytes);
  if (status == POSE_WALL_OK)
    status = pose_wall_planar_stop_open(&config, &stopping, block_of(4, bytes), bytes, &p->stop);
  return status;
}

/* The members of a result that are numbers; those that may be NaN count by their sign of life alone. */
static void hash_stop(digest* d, const pose_wall_planar_stop_result* stop) {
  const uint32_t words[] = {stop->state, stop->reasons, stop->points_used, stop->thing_cells, stop->blind_cells};
  d->output = hashed(d->output, words, sizeof words);
  d->output = hashed(d->output, &stop->allowed_speed_m_s, sizeof stop->allowed_speed_m_s);
}

static int32_t take_frame(digest* d, const parts* p, uint32_t count) {
  const int64_t stamp_ns = (int64_t)d->frames * 100000000;
  pose_wall_cloud cloud;
  pose_wall_result stands = {.struct_size = sizeof stands};
  pose_wall_planar_floor floor = {.struct_size = sizeof floor};
  pose_wall_planar_scan scan = {.struct_size = sizeof scan};
  pose_wall_planar_slam_result where = {.struct_size = sizeof where};
  pose_wall_planar_map_report report = {.struct_size = sizeof report};
  pose_wall_planar_stop_result stop = {.struct_size = sizeof stop};
  int32_t status = pose_wall_cloud_xyz32(&cloud, scanned, count, sizeof scanned[0], stamp_ns);
  if (status == POSE_WALL_OK) status = pose_wall_process(p->engine, &cloud, &stands);
  if (status == POSE_WALL_OK) status = pose_wall_planar_floor_of(&stands, &floor);
  if (status == POSE_WALL_OK) status = pose_wall_planar_scanner_process(p->scanner, &cloud, &floor, &scan, NULL);
  if (status == POSE_WALL_OK) status = pose_wall_planar_slam_process(p->slam, &scan, NULL, &where);
  if (status == POSE_WALL_OK) status = pose_wall_planar_map_insert(p->map, &scan, &where.pose, &report);
  if (status == POSE_WALL_OK) status = pose_wall_planar_stop_process(p->stop, &cloud, NULL, stamp_ns, &stop);
  if (status != POSE_WALL_OK) return status;
  d->input = hashed(d->input, scanned, (uint64_t)count * sizeof scanned[0]);
  d->output = hashed_ranges(d->output, scan.range_m, scan.beams);
  d->output = hashed(d->output, &where, sizeof where);
  d->output = hashed(d->output, &report, sizeof report);
  hash_stop(d, &stop);
  d->values += d->frames > 0 ? 1 : 0;
  d->measured += d->frames > 0 && where.state == POSE_WALL_PLANAR_SLAM_TRACKED ? 1 : 0;
  d->frames += 1;
  d->points += count;
  return status;
}

static int32_t take_saved(digest* d, const parts* p) {
  uint64_t trail = 0, map = 0;
  int32_t status = pose_wall_planar_slam_save_bytes(p->slam, &trail);
  if (status == POSE_WALL_OK) status = pose_wall_planar_map_save_bytes(p->map, &map);
  unsigned char* const saved = malloc((size_t)(trail + map));
  if (saved == NULL) return POSE_WALL_E_BUFFER_SMALL;
  if (status == POSE_WALL_OK) status = pose_wall_planar_slam_save(p->slam, saved, trail, &trail);
  if (status == POSE_WALL_OK) status = pose_wall_planar_map_save_all(p->map, saved + trail, map, &map);
  d->output = hashed(d->output, saved, trail + map);
  free(saved);
  return status;
}

static int32_t take_roadway(digest* d, const roadway* road) {
  parts p = {NULL, NULL, NULL, NULL, NULL};
  int32_t status = open_parts(road, &p);
  while (d->frames < FRAMES && status == POSE_WALL_OK) {
    status = take_frame(d, &p, roadway_scan(road, (uint32_t)d->frames, scanned));
  }
  if (status == POSE_WALL_OK) status = take_saved(d, &p);
  for (uint32_t k = 0; k < BLOCKS; ++k) {
    free(taken[k]);
    taken[k] = NULL;
  }
  return status;
}

int main(void) {
  for (uint32_t k = 0; k < roadway_count; ++k) {
    const uint64_t start = 0xCBF29CE484222325u;
    digest d = {roadways[k]->name, 0, 0, start, start, 0, 0};
    const int32_t status = take_roadway(&d, roadways[k]);
    if (status != POSE_WALL_OK) {
      fprintf(stderr, "%s: refused with status %d: %s\n", d.name, (int)status, pose_wall_planar_status_text(status));
      return EXIT_FAILURE;
    }
    char line[DIGEST_LINE_BYTES];
    fwrite(line, 1, digest_line(&d, &line), stdout);
  }
  return EXIT_SUCCESS;
}

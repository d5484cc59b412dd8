/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

#include "digest.h"

#include <stddef.h>

#define BLOCK_BYTES (8u << 20)
#define PERIOD_NS 100000000

static uint64_t block[BLOCK_BYTES / sizeof(uint64_t)] __attribute__((aligned(POSE_WALL_BLOCK_ALIGNMENT)));
static float scanned[ROADWAY_POINTS_MAX][3];
static pose_wall_engine* engine;

static uint64_t hashed(uint64_t hash, const void* data, uint64_t bytes) { /* FNV-1a */
  const unsigned char* const byte = data;
  for (uint64_t i = 0; i < bytes; ++i) hash = (hash ^ byte[i]) * 0x100000001B3u;
  return hash;
}

int32_t digest_open(digest* d, const char* name, const setting* settings) {
  const uint64_t start = 0xCBF29CE484222325u;
  const digest empty = {name, 0, 0, start, start, 0, 0};
  *d = empty;
  pose_wall_config config;
  int32_t status = pose_wall_config_init(&config);
  for (uint32_t k = 0; settings[k].key != NULL && status == POSE_WALL_OK; ++k) {
    status = pose_wall_config_set(&config, settings[k].key, settings[k].value);
  }
  if (status != POSE_WALL_OK) return status;
  d->output = hashed(d->output, &config, sizeof config); /* numbers read from text, too */
  return pose_wall_open(&config, block, sizeof block, &engine);
}

static void take_result(digest* d, const pose_wall_result* result) {
  d->output = hashed(d->output, result, sizeof *result);
  for (uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const uint32_t state = result->quantity[q].state;
    d->measured += state == POSE_WALL_VALID || state == POSE_WALL_DEGRADED ? 1 : 0;
    d->values += 1;
  }
}

static int32_t take_points(digest* d) {
  pose_wall_points points;
  const int32_t status = pose_wall_last_points(engine, &points);
  if (status != POSE_WALL_OK) return status;
  d->output = hashed(d->output, points.x_base_m, points.count * sizeof(float));
  d->output = hashed(d->output, points.y_base_m, points.count * sizeof(float));
  d->output = hashed(d->output, points.z_base_m, points.count * sizeof(float));
  d->output = hashed(d->output, points.label, points.count);
  return POSE_WALL_OK;
}

int32_t digest_frame(digest* d, const float (*points)[3], uint32_t count, int64_t stamp_ns) {
  d->input = hashed(d->input, points, (uint64_t)count * sizeof points[0]);
  d->frames += 1;
  d->points += count;
  pose_wall_cloud cloud;
  int32_t status = pose_wall_cloud_xyz32(&cloud, points, count, sizeof points[0], stamp_ns);
  if (status != POSE_WALL_OK) return status;
  pose_wall_result result;
  result.struct_size = sizeof result;
  status = pose_wall_process(engine, &cloud, &result);
  if (status != POSE_WALL_OK) return status;
  take_result(d, &result);
  return take_points(d);
}

/* Bits by chance, read as floats: every kind of NaN, infinities, numbers too small and too large. */
static void spoil(uint32_t count, uint64_t seed) {
  for (uint32_t i = 0; i < count; i += 5) {
    const uint64_t bits = scramble(seed ^ i);
    const union {
      uint32_t bits;
      float number;
    } strange = {(uint32_t)bits};
    scanned[i][(bits >> 40) % 3] = strange.number;
  }
}

/* What frame by frame befalls a faulty roadway; stamps in periods. */
typedef struct fault {
  int32_t stamp;
  enum { NONE, EMPTY, HALF, FROZEN, SPOILT } cloud;
} fault;

static const fault kFaults[] = {{0, NONE}, {1, NONE},  {2, EMPTY},   {2, NONE},  {1, NONE},    {2, SPOILT},
                                {3, HALF}, {50, NONE}, {51, FROZEN}, {52, HALF}, {53, SPOILT}, {54, NONE}};

static const fault* fault_of(const roadway* road, uint32_t frame) {
  return road->faulty != 0 && frame < sizeof kFaults / sizeof kFaults[0] ? &kFaults[frame] : NULL;
}

int32_t digest_roadway(digest* d, const roadway* road) {
  int32_t status = digest_open(d, road->name, road->settings);
  uint32_t count = 0;
  for (uint32_t frame = 0; frame < road->frames && status == POSE_WALL_OK; ++frame) {
    const fault* const what = fault_of(road, frame);
    if (what == NULL || what->cloud != FROZEN) count = roadway_scan(road, frame, scanned);
    if (what != NULL && what->cloud == SPOILT) spoil(count, frame);
    const uint32_t given =
        what == NULL ? count : (what->cloud == EMPTY ? 0 : (what->cloud == HALF ? count / 2 : count));
    const int64_t stamp = what == NULL ? (int64_t)frame : what->stamp;
    status = digest_frame(d, (const float(*)[3])scanned, given, stamp * PERIOD_NS);
  }
  return status;
}

int32_t digest_self_test(pose_wall_self_test_report* report) {
  report->struct_size = sizeof *report;
  return pose_wall_self_test(block, sizeof block, report);
}

typedef struct line_end {
  char* text;
  uint32_t length;
} line_end;

static void put(line_end* end, char c) {
  if (end->length + 1 < DIGEST_LINE_BYTES) end->text[end->length++] = c;
}

static void put_text(line_end* end, const char* text) {
  for (; *text != '\0'; ++text) put(end, *text);
  put(end, ' ');
}

static void put_hex(line_end* end, uint64_t number) {
  for (int shift = 60; shift >= 0; shift -= 4) put(end, "0123456789abcdef"[(number >> shift) & 15u]);
  put(end, ' ');
}

static void put_number(line_end* end, uint64_t number, char behind) {
  uint64_t power = 1;
  while (number / power >= 10) power *= 10;
  for (; power > 0; power /= 10) put(end, (char)('0' + number / power % 10));
  put(end, behind);
}

uint32_t digest_line(const digest* d, char (*line)[DIGEST_LINE_BYTES]) {
  line_end end = {*line, 0};
  put_text(&end, d->name);
  put_number(&end, d->frames, ' ');
  put_number(&end, d->points, ' ');
  put_hex(&end, d->input);
  put_hex(&end, d->output);
  put_number(&end, d->measured, '/');
  put_number(&end, d->values, '\n');
  return end.length;
}

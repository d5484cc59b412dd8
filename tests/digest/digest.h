/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * What an engine makes of frames, in 16 digits: FNV-1a over every byte of config, results and labelled points. Needs
 * the C ABI and nothing else, no library either.
 */

#ifndef POSE_WALL_TESTS_DIGEST_DIGEST_H
#define POSE_WALL_TESTS_DIGEST_DIGEST_H

#include <stdint.h>

#include "pose_wall.h"
#include "roadway.h"

#define DIGEST_LINE_BYTES 160u

/* An engine on static memory: one sequence at a time. */
typedef struct digest {
  const char* name;
  uint64_t frames, points;   /* that were given */
  uint64_t input, output;    /* digests; of the points, and of all that came out */
  uint64_t measured, values; /* of all values that were asked for, so many are valid or degraded */
} digest;

/* 0, or the status of the call that was refused. Settings end with a key of NULL. */
int32_t digest_open(digest* d, const char* name, const setting* settings);
int32_t digest_frame(digest* d, const float (*points)[3], uint32_t count, int64_t stamp_ns);

/* All of a roadway's frames, and the faults of one that is faulty. */
int32_t digest_roadway(digest* d, const roadway* road);

/* The library's own self test, in the same memory: its status. */
int32_t digest_self_test(pose_wall_self_test_report* report);

/* "name frames points input output measured/values\n"; returns its length. */
uint32_t digest_line(const digest* d, char (*line)[DIGEST_LINE_BYTES]);

#endif

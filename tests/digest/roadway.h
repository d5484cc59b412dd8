/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * Roadways whose points are the same bits on every machine and from every compiler: nothing here but whole numbers and
 * +, -, *, / of doubles, which IEEE 754 rounds in one way only; no library function, so that it also runs where there
 * is no library. Angles are given by the tangent of their half, which makes sine and cosine quotients.
 *
 * They are there to lead the engine through its branches, not to be measured against a truth: that is the simulator's
 * business.
 */

#ifndef POSE_WALL_TESTS_DIGEST_ROADWAY_H
#define POSE_WALL_TESTS_DIGEST_ROADWAY_H

#include <stdint.h>

#define ROADWAY_POINTS_MAX 131072u
#define ROADWAY_BOXES_MAX 12u

typedef struct range_of {
  double from, to;
} range_of;

typedef struct box {
  range_of x, y, z; /* m, in the road: x along it, z = 0 on the floor */
} box;

/* Lines at elevations between two half tangents; 0 lines: every ray has an elevation by chance. */
typedef struct scanner {
  uint32_t lines, turns; /* turns: rays of one line */
  range_of elevation_t;
} scanner;

typedef struct setting {
  const char *key, *value;
} setting;

typedef struct roadway {
  const char* name;
  struct scanner scanner;                  /* so it is C++, too */
  double half_width_m, height_m, face_x_m; /* face_x_m: the heading's face */
  double rough_m, steel_m;                 /* bumps of the rock; how far steel sets stand out, 0: none */
  double noise_m;                          /* of a range, standard deviation */
  range_of door_x;                         /* a gap of the right wall, empty: none */
  double sensor_y_m, sensor_z_m;
  double roll_t, pitch_t, yaw_t; /* half tangents: of the machine in the road */
  double mount_yaw_t;            /* of the sensor on the machine */
  double step_m;                 /* the machine moves so far from frame to frame */
  uint32_t box_count, frames, faulty;
  box boxes[ROADWAY_BOXES_MAX];
  const setting* settings; /* ends with a key of NULL */
} roadway;

extern const roadway* const roadways[];
extern const uint32_t roadway_count;

/* Points of one frame, x y z in m in the sensor's frame. Returns how many; room for ROADWAY_POINTS_MAX. */
uint32_t roadway_scan(const roadway* road, uint32_t frame, float (*points)[3]);

/* A whole number that looks like chance, from another. */
uint64_t scramble(uint64_t x);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * Two sensors, an engine for each, and a comparison before anything is released. C99 and the archive alone.
 *
 *     cc -std=c99 -Iinclude tools/apps/c/two_engines.c build/release/libpose_wall.a -lm -o two_engines
 *     ./two_engines            twelve frames: the values of both sensors agree within their levels
 *     ./two_engines scaled     one sensor measures 10 % too far, from the first frame on: no engine sees that alone
 *     ./two_engines blind      from the seventh frame on one sensor sees nothing
 *     ./two_engines bit        in the seventh frame a twin, which gets the same bytes, comes to another result
 *
 * TWO SENSORS  Each value v with the level l claims that the truth lies in v - l .. v + l. Two claims contradict each
 * other iff |v1 - v2| > l1 + l2: then at least one of them is wrong, and nobody can say which. So neither is released.
 * A value is released where both are valid and agree; it is the one of the narrower level. (Two of two: a sensor that
 * fails takes the value away. That is safe only where the machine is safe without a value.)
 *
 * TWIN  A second engine with the settings and frames of the first gives the same bytes, always. Where it does not, a
 * processor or a memory is broken. There is no tolerance and no second try: everything is withheld from then on.
 *
 * ON DISAGREEMENT  withhold the value at once; let the machine go on without it, as it does when a value is invalid;
 * count. After LATCH_AFTER frames in a row the quantity stays withheld until a person has looked and starts again: a
 * mounting that has moved comes and goes with the place. Note the stamps: the frames around them tell which was wrong.
 *
 * COMMON CAUSES  Both engines are the same code, and both sensors look through the same air. What deceives both alike
 * (spray, a mounting plate that bends, wrong settings for both, an error in this library) agrees. See
 * include/SAFETY.md.
 */

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "pose_wall.h"

#define FRAMES 12
#define FAULT_FROM 6
#define LATCH_AFTER 3
#define RINGS 32
#define COLUMNS 720
#define POINTS_MAX (RINGS * COLUMNS)
#define BLOCK_BYTES (5 * 1024 * 1024) /* pose_wall_memory_needed says how much; 4.5 MiB by default */

typedef struct channel {
  double x_m, y_m, z_m, yaw_rad; /* where the sensor sits on the machine, and how it is turned */
  pose_wall_engine* engine;
  pose_wall_result result;
  unsigned char memory[BLOCK_BYTES + POSE_WALL_BLOCK_ALIGNMENT];
} channel;

/* Of one quantity, from frame to frame. */
typedef struct comparison {
  uint32_t agreed, disagreed, missing; /* frames */
  uint32_t in_a_row;                   /* disagreements */
  int latched;
} comparison;

static channel front = {1.2, 0.3, 0.2, 0.0, NULL, {0}, {0}};
static channel rear = {-1.0, -0.2, 0.4, 3.0, NULL, {0}, {0}};
static channel twin; /* of front */
static comparison compared[POSE_WALL_QUANTITIES];
static float points[POINTS_MAX][3];

static int refuse(const char* call, int32_t status) {
  fprintf(stderr, "%s: %s\n", call, pose_wall_status_text(status));
  return 0;
}

/* Each channel has settings, a block and an engine of its own; nothing is shared. */
static int open_channel(channel* c) {
  const uintptr_t alignment = POSE_WALL_BLOCK_ALIGNMENT, start = (uintptr_t)c->memory;
  unsigned char* const block = c->memory + (alignment - start % alignment) % alignment;
  pose_wall_self_test_report report;
  report.struct_size = sizeof report;
  int32_t status = pose_wall_self_test(block, BLOCK_BYTES, &report);
  if (status != POSE_WALL_OK) return refuse("pose_wall_self_test", status);
  pose_wall_config config;
  pose_wall_config_init(&config);
  status = pose_wall_config_set_number(&config, "extrinsic_x", c->x_m);
  if (status == POSE_WALL_OK) status = pose_wall_config_set_number(&config, "extrinsic_y", c->y_m);
  if (status == POSE_WALL_OK) status = pose_wall_config_set_number(&config, "extrinsic_z", c->z_m);
  if (status == POSE_WALL_OK) status = pose_wall_config_set_number(&config, "extrinsic_yaw", c->yaw_rad);
  if (status == POSE_WALL_OK) status = pose_wall_open(&config, block, BLOCK_BYTES, &c->engine);
  return status == POSE_WALL_OK ? 1 : refuse("pose_wall_open", status);
}

/* What stands for a sensor: rays at even angles, each to the first surface of a straight roadway in which the machine
 * is turned left by 2 degrees. Each frame's rays begin elsewhere: the same points again would be a frozen sensor. */
static uint32_t scan(const channel* c, int frame, double scale) {
  const double pi = 3.14159265358979, turned_left_rad = 2.0 * pi / 180.0;
  const double to_left_m = 2.3, to_right_m = 2.7, to_floor_m = 1.2, to_roof_m = 1.9, to_face_m = 40.0;
  const double cm = cos(turned_left_rad), sm = sin(turned_left_rad);
  const double x_m = cm * c->x_m - sm * c->y_m, y_m = sm * c->x_m + cm * c->y_m;
  uint32_t count = 0;
  for (int ring = 0; ring < RINGS; ++ring) {
    for (int column = 0; column < COLUMNS; ++column) {
      const double up = (-22.5 + 45.0 * ring / (RINGS - 1)) * pi / 180.0,
                   round = 2.0 * pi * (column + 0.382 * frame) / COLUMNS;
      const double ray[3] = {cos(up) * cos(round), cos(up) * sin(round), sin(up)};
      const double yaw = c->yaw_rad + turned_left_rad;
      const double along = cos(yaw) * ray[0] - sin(yaw) * ray[1], across = sin(yaw) * ray[0] + cos(yaw) * ray[1];
      const double to_side_m = across > 0.0 ? (to_left_m - y_m) / across : (-to_right_m - y_m) / across;
      const double to_level_m = ray[2] < 0.0 ? (-to_floor_m - c->z_m) / ray[2] : (to_roof_m - c->z_m) / ray[2];
      const double to_end_m = along > 0.0 ? (to_face_m - x_m) / along : (-to_face_m - x_m) / along;
      const double range_m = scale * fmin(fmin(to_side_m, to_level_m), to_end_m);
      for (int axis = 0; axis < 3; ++axis) points[count][axis] = (float)(range_m * ray[axis]);
      ++count;
    }
  }
  return count;
}

static int process(channel* c, uint32_t count, int64_t stamp_ns) {
  pose_wall_cloud cloud;
  int32_t status = pose_wall_cloud_xyz32(&cloud, points, count, sizeof points[0], stamp_ns);
  c->result.struct_size = sizeof c->result;
  if (status == POSE_WALL_OK) status = pose_wall_process(c->engine, &cloud, &c->result);
  return status == POSE_WALL_OK ? 1 : refuse("pose_wall_process", status);
}

/* Only what was measured in this frame and is valid counts as a claim. NaN fails. */
static int claims(const pose_wall_value* v) {
  return v->state == POSE_WALL_VALID && v->protection_level >= 0.0 && v->value == v->value;
}

/* The value to release, or NULL. */
static const pose_wall_value* compare(comparison* kept, const pose_wall_value* a, const pose_wall_value* b) {
  if (!claims(a) || !claims(b)) {
    ++kept->missing; /* neither agreement nor contradiction: a latch stays, a row of contradictions is not ended */
    return NULL;
  }
  if (!(fabs(a->value - b->value) <= a->protection_level + b->protection_level)) {
    ++kept->disagreed;
    if (++kept->in_a_row >= LATCH_AFTER) kept->latched = 1;
    return NULL;
  }
  ++kept->agreed;
  kept->in_a_row = 0;
  if (kept->latched) return NULL;
  return a->protection_level <= b->protection_level ? a : b;
}

/* How many of the seven were released, or -1 where nothing may be any more. */
static int one_frame(int frame, const char* fault) {
  const int now = frame >= FAULT_FROM;
  const int64_t stamp_ns = (int64_t)frame * 100000000;
  const uint32_t seen = scan(&front, frame, 1.0);
  if (!process(&front, seen, stamp_ns)) return -1;
  if (now && strcmp(fault, "bit") == 0) points[0][0] = 0.0f;
  if (!process(&twin, seen, stamp_ns)) return -1;
  if (memcmp(&front.result, &twin.result, sizeof front.result) != 0) {
    printf("frame %d: the twin came to another result of the same bytes: withheld for good\n", frame);
    return -1;
  }
  const double scale = strcmp(fault, "scaled") == 0 ? 1.1 : 1.0;
  const uint32_t seen_behind = now && strcmp(fault, "blind") == 0 ? 0 : scan(&rear, frame, scale);
  if (!process(&rear, seen_behind, stamp_ns)) return -1;
  int released = 0;
  for (uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    released += compare(&compared[q], &front.result.quantity[q], &rear.result.quantity[q]) != NULL ? 1 : 0;
  }
  return released;
}

int main(int argc, char** argv) {
  const char* const fault = argc > 1 ? argv[1] : "none";
  twin.x_m = front.x_m, twin.y_m = front.y_m, twin.z_m = front.z_m, twin.yaw_rad = front.yaw_rad;
  if (!open_channel(&front) || !open_channel(&twin) || !open_channel(&rear)) return 1;
  int released = 0;
  for (int frame = 0; frame < FRAMES && released >= 0; ++frame) {
    released = one_frame(frame, fault);
    printf("frame %2d: %d of 7 released\n", frame, released > 0 ? released : 0);
  }
  for (uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    printf("%-6s agreed %2u, disagreed %2u, missing %2u%s\n", pose_wall_quantity_name(q), (unsigned)compared[q].agreed,
           (unsigned)compared[q].disagreed, (unsigned)compared[q].missing, compared[q].latched ? ", latched" : "");
  }
  return released == POSE_WALL_QUANTITIES ? 0 : 3; /* 3: something is withheld at the end */
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * The SLAM of pose_wall_planar: from planar scans, with odometry or without, to the poses that they were taken from.
 *
 * Every scan is matched with the last metres of the trail. Every keyframe_m the trail gets a keyframe. Where a machine
 * comes to a place that it has been to, the graph of all keyframes is solved anew, a round in each call. So poses of
 * keyframes change: solution counts that. A scan's final pose is its in_keyframe, by that keyframe's final pose.
 *
 *     pose_wall_planar_slam_settings_init(&settings);
 *     pose_wall_planar_slam_memory_needed(&settings, &bytes);
 *     pose_wall_planar_slam_open(&settings, block, bytes, &slam);
 *     result.struct_size = sizeof result;
 *     for every scan: pose_wall_planar_slam_process(slam, &scan, &odometry, &result);
 *     pose_wall_planar_slam_settle(slam);
 *     pose_wall_planar_slam_keyframe(slam, result.keyframe, &keyframe);
 *
 * CLOSURES  a place is the same only if several looks agree about it over metres of travel, if what they saw holds the
 *           place along the road, too, and if no line of sight passes through what the other saw. Where later looks
 *           contradict a belief, it is taken back. Roads that look alike stay apart while odometry keeps them apart.
 * ODOMETRY  a pose of base in any frame that may drift, at the scan's time. It may stall, slip and catch up.
 * SOURCES   surfaces: Biber and Strasser, IROS 2003. Search: Olson, ICRA 2009; Hess and others, ICRA 2016. The graph
 *           and its solution: Lu and Milios 1997; Dellaert and others, IROS 2010.
 *
 * The other rules are those of pose_wall_planar.h.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_SLAM_H
#define POSE_WALL_PLANAR_SLAM_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pose_wall_planar_slam pose_wall_planar_slam;

/* ---------------------------------------------------------------------------------------------- settings */

typedef struct pose_wall_planar_slam_settings {
  uint32_t struct_size; /* sizeof(pose_wall_planar_slam_settings) */
  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_planar_slam_settings.def"
} pose_wall_planar_slam_settings;

/* The defaults. Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_settings_init(pose_wall_planar_slam_settings* settings);

/* Fails iff: settings NULL, struct_size, POSE_WALL_E_VALUE_RANGE. In the last case it writes the first fault to *fault
 * (which may be NULL). */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_settings_check(const pose_wall_planar_slam_settings* settings,
                                                               pose_wall_planar_fault* fault);

/* ---------------------------------------------------------------------------------------------- life */

/* Bytes of the block: some 4.2 kB a keyframe, and 10 MB. settings NULL: the defaults. Fails iff: bytes NULL, settings
 * refused. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_memory_needed(const pose_wall_planar_slam_settings* settings,
                                                              uint64_t* bytes);
/* Bytes that are enough with the default settings, for static arrays. Of this version: a later one may need more, and
 * then refuses the block. */
#define POSE_WALL_PLANAR_SLAM_BLOCK_MOST 33554432 /* 32 MiB */

/* An empty trail in the block, which may hold garbage and must not move. settings NULL: the defaults. Fails iff: block
 * or slam NULL, settings refused, block misaligned (POSE_WALL_BLOCK_ALIGNMENT) or too small. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_open(const pose_wall_planar_slam_settings* settings, void* block,
                                                     uint64_t block_bytes, pose_wall_planar_slam** slam);

/* All calls below fail with POSE_WALL_E_NULL, POSE_WALL_E_ENGINE (not an open SLAM) and POSE_WALL_E_BUSY (another call
 * is inside). Other failures stand beside the call. */

/* Forgets the trail. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_clear(pose_wall_planar_slam* slam);

/* ---------------------------------------------------------------------------------------------- a scan */

enum pose_wall_planar_slam_state {
  POSE_WALL_PLANAR_SLAM_FIRST = 0,    /* the trail begins with this scan, or with the first after a full trail */
  POSE_WALL_PLANAR_SLAM_TRACKED = 1,  /* the scan fits the last metres */
  POSE_WALL_PLANAR_SLAM_DOUBTFUL = 2, /* it fits badly: crowds, or a wrong place. Its pose may be off */
  POSE_WALL_PLANAR_SLAM_BLIND = 3     /* it has too few points to say: the pose is the predicted one */
};
/* "tracked"; static storage. */
const char* pose_wall_planar_slam_state_name(uint32_t state);

typedef struct pose_wall_planar_slam_result {
  uint32_t struct_size;              /* sizeof(pose_wall_planar_slam_result): set it before the call */
  uint32_t state;                    /* pose_wall_planar_slam_state */
  int64_t stamp_ns;                  /* the scan's */
  pose_wall_planar_pose pose;        /* of base in map, as it is known now */
  pose_wall_planar_pose in_keyframe; /* of base in its keyframe */
  uint32_t keyframe;                 /* number of that keyframe, from 0 */
  uint32_t is_keyframe;              /* 1: it began with this scan */
  double explained;    /* share of the points in known parts of the map that lie on its surfaces; 0 for the first */
  double misfit_m;     /* root mean square of these points' distances from the surfaces */
  uint32_t closures;   /* that are believed now */
  uint32_t taken_back; /* closures that were believed once */
  uint32_t keyframes;  /* in the trail */
  uint32_t is_full;    /* 1: the trail takes no more keyframes. Scans are matched with its last metres */
  uint32_t solution;   /* another number whenever poses of earlier keyframes have changed */
  uint32_t is_settled; /* 1: the graph rests */
} pose_wall_planar_slam_result;

/* One scan. odometry may be NULL. Fails iff: struct_size, POSE_WALL_PLANAR_E_SCAN, POSE_WALL_PLANAR_E_POSE (odometry
 * not finite or beyond 1e6 m). The trail and the result are then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_process(pose_wall_planar_slam* slam, const pose_wall_planar_scan* scan,
                                                        const pose_wall_planar_pose* odometry,
                                                        pose_wall_planar_slam_result* result);

/* Goes on with the graph until it rests, at most twelve rounds. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_settle(pose_wall_planar_slam* slam);

/* ---------------------------------------------------------------------------------------------- the trail */

typedef struct pose_wall_planar_keyframe {
  uint32_t struct_size; /* sizeof(pose_wall_planar_keyframe): set it before the call */
  uint32_t points;      /* surface points of its scan */
  int64_t stamp_ns;
  pose_wall_planar_pose pose; /* of base in map */
  double travel_m;            /* since the first keyframe, whichever way */
} pose_wall_planar_keyframe;

/* Fails iff: struct_size, POSE_WALL_E_INDEX. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_keyframe(const pose_wall_planar_slam* slam, uint32_t number,
                                                         pose_wall_planar_keyframe* keyframe);

/* The keyframe's surface points, in its base: x, y, x, y ... Fails iff: POSE_WALL_E_INDEX, POSE_WALL_E_BUFFER_SMALL
 * (capacity counts points). */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_points(const pose_wall_planar_slam* slam, uint32_t number, float* xy_m,
                                                       uint32_t capacity);

typedef struct pose_wall_planar_edge {
  uint32_t struct_size; /* sizeof(pose_wall_planar_edge): set it before the call */
  uint32_t from;        /* keyframes */
  uint32_t to;
  uint32_t is_closure;        /* 0: neighbours along the trail */
  pose_wall_planar_pose step; /* of `to` in the frame of `from`, as it was measured */
  double information[9];      /* of x, y, yaw; row by row. All 0: taken back */
} pose_wall_planar_edge;

/* Fails iff: struct_size, POSE_WALL_E_INDEX: so number runs from 0 until it fails. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_edge(const pose_wall_planar_slam* slam, uint32_t number,
                                                     pose_wall_planar_edge* edge);

/* ---------------------------------------------------------------------------------------------- saved */

/* Of the bytes that pose_wall_planar_slam_save writes. They begin with "PWTL" and this number, 4 bytes each. */
#define POSE_WALL_PLANAR_TRAIL_VERSION 1

/* Bytes that pose_wall_planar_slam_save writes now. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_save_bytes(const pose_wall_planar_slam* slam, uint64_t* bytes);

/* The trail and its graph, with version and CRC-32, low bytes first. Fails iff: POSE_WALL_E_BUFFER_SMALL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_save(const pose_wall_planar_slam* slam, void* buffer,
                                                     uint64_t buffer_bytes, uint64_t* bytes);

/* Takes a saved trail in place of the present one. The next scan is matched about `base`, where the machine stands in
 * map now: by pose_wall_planar_localise.h, or by hand. base NULL: where the saved trail ended. Fails iff:
 * POSE_WALL_PLANAR_E_MAP_FILE (another version, cut off, damaged), POSE_WALL_PLANAR_E_POSE, POSE_WALL_E_BLOCK_SMALL
 * (more keyframes than keyframes_most). The trail is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_planar_slam_load(pose_wall_planar_slam* slam, const void* saved, uint64_t bytes,
                                                     const pose_wall_planar_pose* base);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_SLAM_H */

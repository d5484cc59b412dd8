/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* What the parts of pose_wall_planar share: poses in the plane and planar scans. pose_wall_planar.h is the manual. */

#ifndef POSE_WALL_PLANAR_TYPES_H
#define POSE_WALL_PLANAR_TYPES_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Raised when a struct or function of the planar headers changes incompatibly. */
#define POSE_WALL_PLANAR_ABI_VERSION 2
/* POSE_WALL_PLANAR_ABI_VERSION of the library that is linked. */
uint32_t pose_wall_planar_abi_version(void);

/* Status codes of this library, beside those of pose_wall.h. No other library has these numbers. */
enum pose_wall_planar_status {
  POSE_WALL_PLANAR_E_SCAN = -120,     /* a scan whose beams, angles or ranges are outside their limits */
  POSE_WALL_PLANAR_E_POSE = -121,     /* a pose or a covariance that is not finite, or no covariance */
  POSE_WALL_PLANAR_E_MAP_FILE = -122, /* saved bytes of another version, cut off or damaged */
  POSE_WALL_PLANAR_E_GRID = -123,     /* a grid whose size, cells or resolution are outside their limits */
  POSE_WALL_PLANAR_E_ORDER = -124     /* a call that comes too early or too late */
};
/* The same as pose_wall_status_text, which knows the statuses of all libraries; static storage. */
const char* pose_wall_planar_status_text(int32_t status);

/* Poses that callers give are refused (POSE_WALL_PLANAR_E_POSE) if they are not finite, or beyond these: places of 1 nm
 * and turns of 1e-12 rad are told apart within them. */
#define POSE_WALL_PLANAR_FARTHEST_M 1e6
#define POSE_WALL_PLANAR_TURNED_MOST_RAD 1e4

/* A pose in the plane: a point p of base lies at R(yaw) p + (x, y) in the frame that the pose belongs to. */
typedef struct pose_wall_planar_pose {
  double x_m;
  double y_m;
  double yaw_rad; /* counted from x to y, to the left; results are in (-pi, pi] */
} pose_wall_planar_pose;

/* The planner and the tracker take poses of the machine, everything else takes and gives poses of base (AXES.md). The
 * machine's frame lies at its turning centre, midway between the tracks, with x along forward_axis and y to the left of
 * that. centre_m: x, y of the turning centre in base; NULL: the origin of base. From a pose of base to the machine's,
 * and back; both may be the same struct. yaw_rad of the result is in (-pi, pi]. Fails iff: config or a pose NULL,
 * config not initialised, POSE_WALL_E_VALUE_RANGE (a centre that is not within 20 m), POSE_WALL_PLANAR_E_POSE. */
POSE_WALL_CHECKED int32_t pose_wall_planar_machine_of_base(const pose_wall_config* config, const double centre_m[2],
                                                           const pose_wall_planar_pose* base,
                                                           pose_wall_planar_pose* machine);
POSE_WALL_CHECKED int32_t pose_wall_planar_base_of_machine(const pose_wall_config* config, const double centre_m[2],
                                                           const pose_wall_planar_pose* machine,
                                                           pose_wall_planar_pose* base);

/* A fault of settings: the member's name and its range; static storage. */
typedef struct pose_wall_planar_fault {
  const char* member;
  const char* rule; /* "range_max_m must be from 1 to 200" */
} pose_wall_planar_fault;

/* Beams of a scan at most: a turn in steps of 0.001 rad. */
#define POSE_WALL_PLANAR_BEAMS_MAX 6284

/* A planar scan, as sensor_msgs/LaserScan has it. A beam is
 *     a finite range from range_min_m to range_max_m: the first thing in this direction;
 *     plus infinity: nothing up to range_max_m, all of it was seen;
 *     anything else (NaN, 0, too near, too far): unknown beyond free_m. Unknown is not free. */
typedef struct pose_wall_planar_scan {
  uint32_t struct_size; /* sizeof(pose_wall_planar_scan) */
  uint32_t beams;       /* 1 to POSE_WALL_PLANAR_BEAMS_MAX */
  int64_t stamp_ns;
  pose_wall_planar_pose sensor; /* the scan's origin and zero direction in base */
  double angle_min_rad;         /* of beam 0, about the sensor; -2 pi to 2 pi */
  double angle_step_rad;        /* from beam to beam, not 0; beams x |step| is at most a turn and a step */
  double range_min_m;           /* 0 or more, below range_max_m */
  double range_max_m;           /* at most 1000 */
  double sigma_m;               /* standard deviation of a range: 0.001 to 1 */
  const float* range_m;         /* beams ranges in m, the caller's */
  const float* free_m; /* so far a beam without a range was seen to be free; 0 or NaN: not at all. NULL: of no beam */
} pose_wall_planar_scan;

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_TYPES_H */

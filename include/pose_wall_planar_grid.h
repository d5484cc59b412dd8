/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* A rectangle of cells as nav_msgs/OccupancyGrid has it: what the map fills and what the route planner reads.
 * pose_wall_planar.h is the manual. */

#ifndef POSE_WALL_PLANAR_GRID_H
#define POSE_WALL_PLANAR_GRID_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A cell that nothing was seen of. Every other value is the probability of a thing in per cent: 0 to 100. */
#define POSE_WALL_PLANAR_UNKNOWN (-1)
/* Cells of a side at most. */
#define POSE_WALL_PLANAR_GRID_SIDE_MAX 32768

/* Cell (column, row) covers x from origin_x_m + column * resolution_m, and y from origin_y_m + row * resolution_m,
 * by one resolution_m each. It is cells[row * width + column]. Axes are those of the frame map. */
typedef struct pose_wall_planar_grid {
  uint32_t struct_size; /* sizeof(pose_wall_planar_grid) */
  uint32_t width;       /* columns, 1 to POSE_WALL_PLANAR_GRID_SIDE_MAX */
  uint32_t height;      /* rows, 1 to POSE_WALL_PLANAR_GRID_SIDE_MAX */
  uint32_t reserved;    /* 0 */
  double resolution_m;  /* 0.01 to 1 */
  double origin_x_m;    /* the corner of cell (0, 0), not its middle */
  double origin_y_m;
  const int8_t* cells; /* width * height, row by row from the least y */
} pose_wall_planar_grid;

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_GRID_H */

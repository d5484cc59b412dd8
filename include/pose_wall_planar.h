/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * pose_wall_planar: the roadway as a map, in the plane.
 *
 * Each part stands in a header of its own and can be used alone. This one includes them all.
 *
 * FRAMES    base as in pose_wall.h; map: base where the map began. Angles count from x to y, to the left. Planner and
 *           tracker have poses of the machine instead, x along forward_axis: AXES.md and pose_wall_planar_types.h.
 * UNITS     metres, radians, seconds, nanoseconds (stamps). NaN where there is no number.
 * MEMORY    only the caller's block, one for each part that is opened, and less than 32 kB of stack. No call allocates,
 *           blocks, prints, reads a clock or throws.
 * THREADS   an opened part belongs to one thread at a time; different ones are independent.
 * STRUCTS   begin with struct_size and grow at their end only, as in pose_wall.h.
 * ERRORS    every call that can fail returns POSE_WALL_OK or a negative status. A refused call changes nothing.
 * FLOATS    IEEE 754 without fast-math; the same version and input give the same bits on x86-64 and AArch64.
 * LINKING   libpose_wall_planar.a needs libpose_wall.a behind it, and -lm: `pkg-config --libs pose_wall_planar`.
 *
 * The method of compressing a cloud to a planar scan follows CN114239637A (China Agricultural University). README.md
 * says what commercial users must clear.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_H
#define POSE_WALL_PLANAR_H

#include "pose_wall_planar_grid.h"
#include "pose_wall_planar_localise.h"
#include "pose_wall_planar_map.h"
#include "pose_wall_planar_match.h"
#include "pose_wall_planar_plan.h"
#include "pose_wall_planar_scan.h"
#include "pose_wall_planar_slam.h"
#include "pose_wall_planar_stop.h"
#include "pose_wall_planar_track.h"
#include "pose_wall_planar_types.h"

#endif /* POSE_WALL_PLANAR_H */

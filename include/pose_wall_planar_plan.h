/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/* The route planner of pose_wall_planar: from a pose to a pose through a grid, for a machine on tracks.
 * pose_wall_planar.h is the manual of what all parts share.
 *
 * MACHINE   A rectangle that drives forwards and backwards, in curves, and turns on the spot. A pose is that of its
 *           turning centre, midway between the tracks: x forward, y left. pose_wall_planar_machine_of_base makes one of
 *           a pose of base. A margin goes round the rectangle.
 * GRID      Cells from occupied_from on, unknown cells and all outside the grid are not driven on. A route is free when
 *           no part of the rectangle touches such a cell on the way, turns included. Straight stretches are checked
 *           exactly, turns and curves to within 3 mm and always on the safe side.
 * COST      In metres: the length, times reverse_cost where it goes backwards; turn_cost_m_rad for each radian of
 *           turning, on the spot or in a curve; cusp_cost_m for each change between forwards and backwards.
 * METHOD    Weighted A* (Pohl 1970) over places lattice_m apart and 32 headings, along which the machine drives
 *           straight from place to place (a state lattice; Pivtoraiko, Knepper and Kelly 2009). The distance ahead is
 *           that of the inscribed circle, by Dijkstra's algorithm from the goal, and the turn that is left. If no route
 *           is found so, a second search has half the distance and 64 headings. The route is then pulled taut: corners
 *           are left out, cut and moved as long as the cost falls. Last, corners become curves where there is room.
 * BOUND     result.bound: the route costs at most so many times the cheapest route over the same places and headings.
 *           The search alone keeps it below `weight`, as far as that has grown. Pulling taut lowers it, at times below
 *           1: then bound is 1.
 * TIME      The work is bounded by expansions_max, by the sizes of grid and lists, and by a fixed share for pulling
 *           taut. Why there is no route costs less than a search.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_PLAN_H
#define POSE_WALL_PLANAR_PLAN_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_grid.h"
#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pose_wall_planar_planner pose_wall_planar_planner;

typedef struct pose_wall_planar_plan_settings {
  uint32_t struct_size; /* sizeof(pose_wall_planar_plan_settings) */
  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_planar_plan_settings.def"
} pose_wall_planar_plan_settings;

/* The table's defaults: the roadheader of 4.5 by 1.2 m. Fails iff settings is NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_plan_settings_init(pose_wall_planar_plan_settings* settings);
/* POSE_WALL_OK, or POSE_WALL_E_VALUE_RANGE with the member at fault, if `fault` is not NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_plan_settings_check(const pose_wall_planar_plan_settings* settings,
                                                               pose_wall_planar_fault* fault);

/* Bytes of the block. settings NULL: the defaults. Fails iff: bytes NULL, settings as in the check. */
POSE_WALL_CHECKED int32_t pose_wall_planar_plan_memory_needed(const pose_wall_planar_plan_settings* settings,
                                                              uint64_t* bytes);
/* Bytes that are enough with the default settings, for static arrays. Of this version: a later one may need more, and
 * then refuses the block. */
#define POSE_WALL_PLANAR_PLAN_BLOCK_MOST 46137344 /* 44 MiB */
/* Opens a planner in a block of the caller's, aligned to POSE_WALL_BLOCK_ALIGNMENT; it may hold garbage. settings NULL:
 * the defaults. Fails iff: block or planner NULL, settings as in the check, POSE_WALL_E_BLOCK_ALIGN,
 * POSE_WALL_E_BLOCK_SMALL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_plan_open(const pose_wall_planar_plan_settings* settings, void* block,
                                                     uint64_t block_bytes, pose_wall_planar_planner** planner);

/* Bits of pose_wall_planar_path_pose.flags. */
enum pose_wall_planar_path_flag {
  POSE_WALL_PLANAR_PATH_STOP = 1,      /* the machine stands still here: a cusp, a turn on the spot, or the end */
  POSE_WALL_PLANAR_PATH_CUSP = 2,      /* between forwards and backwards */
  POSE_WALL_PLANAR_PATH_TURN_LEFT = 4, /* it turns on the spot to the left to get here from the pose before */
  POSE_WALL_PLANAR_PATH_TURN_RIGHT = 8 /* or to the right */
};

/* A pose of a route, and how the stretch goes that leads to it. */
typedef struct pose_wall_planar_path_pose {
  pose_wall_planar_pose pose; /* of the turning centre, in the frame of the grid */
  double curvature_1_m;       /* of the stretch, to the machine's left positive, whichever way it drives */
  double along_m;             /* length of the route up to here */
  int32_t drive;              /* 1 forwards, -1 backwards, 0 a turn on the spot; 0 at the first pose */
  uint32_t flags;             /* pose_wall_planar_path_flag */
} pose_wall_planar_path_pose;

enum pose_wall_planar_plan_outcome {
  POSE_WALL_PLANAR_PLAN_FOUND = 0,
  POSE_WALL_PLANAR_PLAN_START_BLOCKED = 1, /* with its margin the rectangle does not fit at the start */
  POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED = 2,  /* likewise at the goal */
  POSE_WALL_PLANAR_PLAN_NOT_CONNECTED = 3, /* no free cells lead from the start to the goal */
  POSE_WALL_PLANAR_PLAN_TOO_NARROW = 4, /* they do, but not even the inscribed circle passes: see place and width_m */
  POSE_WALL_PLANAR_PLAN_TOO_TIGHT = 5,  /* the circle passes, the rectangle was not found to: place is how far it got,
                                    or the goal, if it cannot get away from there */
  POSE_WALL_PLANAR_PLAN_LIST_FULL = 6,  /* the open list or the room for places was full, and no route was found */
  POSE_WALL_PLANAR_PLAN_WORK_LIMIT = 7, /* expansions_max was reached before a route was found */
  POSE_WALL_PLANAR_PLAN_ROOM_SMALL = 8  /* found, but the caller's room is smaller than result.poses: nothing written */
};

typedef struct pose_wall_planar_plan_result {
  uint32_t struct_size;        /* sizeof(pose_wall_planar_plan_result) */
  uint32_t outcome;            /* pose_wall_planar_plan_outcome */
  uint32_t poses;              /* of the route; 0 without one */
  uint32_t cusps;              /* changes between forwards and backwards */
  uint32_t spot_turns;         /* turns on the spot */
  uint32_t expansions;         /* of the searches */
  uint32_t places;             /* that the last search entered */
  uint32_t searches;           /* 0: the way was straight; 1 or 2 */
  double length_m;             /* all below are NaN without a route */
  double turning_rad;          /* all turns, on the spot and in curves */
  double cost_m;               /* of the route as written */
  double search_cost_m;        /* before it was pulled taut; cost_m if nothing was searched */
  double bound;                /* 1 or more: BOUND above */
  pose_wall_planar_pose place; /* TOO_NARROW: the narrowest place of the widest way; TOO_TIGHT: as above; else NaN */
  double width_m;              /* TOO_NARROW: free width there, at most that of the inscribed circle; else NaN */
} pose_wall_planar_plan_result;

/* Plans from start to goal, poses of the turning centre in the grid's frame. Writes up to `capacity` poses; the first
 * is the start and the last is the goal. Set result->struct_size first. That there is no route is an outcome, no error.
 * The grid is read during the call only. Fails iff: NULL (poses may be NULL with capacity 0), a struct_size of another
 * version, POSE_WALL_PLANAR_E_GRID (also: another resolution, or larger than the settings say), POSE_WALL_PLANAR_E_POSE
 * for a start or goal that is none (pose_wall_planar_types.h), not open, POSE_WALL_E_BUSY. */
POSE_WALL_CHECKED int32_t pose_wall_planar_plan(pose_wall_planar_planner* planner, const pose_wall_planar_grid* grid,
                                                const pose_wall_planar_pose* start, const pose_wall_planar_pose* goal,
                                                pose_wall_planar_path_pose* poses, uint32_t capacity,
                                                pose_wall_planar_plan_result* result);

/* "found", "too_narrow", ...; static storage. */
const char* pose_wall_planar_plan_outcome_name(uint32_t outcome);
/* One English sentence; static storage. */
const char* pose_wall_planar_plan_outcome_text(uint32_t outcome);

/* Distance in metres from a point of the grid last planned on to the nearest cell that is not driven on, or to the edge
 * of the grid; at most 5. NaN before the first plan and for a place that is none. A tracker's callback. */
double pose_wall_planar_plan_clearance(const pose_wall_planar_planner* planner, double x_m, double y_m);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_PLAN_H */

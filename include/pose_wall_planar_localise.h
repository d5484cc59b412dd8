/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * The localisation of pose_wall_planar: where in a saved map does the machine stand? After a restart the whole map is
 * searched, in every direction. The answer is one place, or a list of places, or that the map has none.
 *
 *     pose_wall_planar_localise_settings_init(&settings);
 *     pose_wall_planar_localise_memory_needed(&settings, &bytes);
 *     pose_wall_planar_localise_open(&settings, block, bytes, &localise);
 *     for every keyframe of a loaded trail: pose_wall_planar_localise_add(localise, &pose, xy_m, points);
 *     pose_wall_planar_localise_finish(localise);
 *     result.struct_size = sizeof result;
 *     for every scan: pose_wall_planar_localise_process(localise, &scan, &odometry, &result);
 *
 * UNIQUE    every other place of the map is excluded, patch by patch of a square metre, and the one that is left fits
 *           at the level of noise: by its relief, by what is seen through, and along the road. While a road's walls
 *           are smooth and parallel, places along it are not told apart, and the answer stays AMBIGUOUS.
 * WHOLE     if the map may lack roads, unique needs relief, too: of smooth walls and corners there may be others like
 *           them, which the map lacks. The one candidate then stays AMBIGUOUS. map_is_whole = 1: the map lacks none.
 * LIMITS    a place that is not in the map, but has the same relief to a few centimetres as one that is, is taken for
 *           that one. No scan can tell them apart.
 * ODOMETRY  a pose of base in any frame that may drift, at the scan's time. It may stall, leap and catch up: where
 *           walls have relief, the scans notice it. Without it, scans are matched with each other: from one to the next
 *           the machine then moves less than 0.6 m and 0.6 rad.
 * KIDNAPPED three scans in a row that contradict the map at the tracked place, or 8 m of doubt, and it is lost: the
 *           search begins anew. A move along walls that look the same to a scanner is not seen.
 * COST      a call does at most `work` steps of search, some 60 ns each, besides a match.
 * FLIPPED   the block has no sum, unlike the engine's: a bit that flips in it may move the place or end the process.
 * SOURCES   surfaces: Biber and Strasser, IROS 2003. Search: Olson, ICRA 2009.
 *
 * The other rules are those of pose_wall_planar.h.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_LOCALISE_H
#define POSE_WALL_PLANAR_LOCALISE_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_grid.h"
#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pose_wall_planar_localise pose_wall_planar_localise;

/* ---------------------------------------------------------------------------------------------- settings */

typedef struct pose_wall_planar_localise_settings {
  uint32_t struct_size; /* sizeof(pose_wall_planar_localise_settings) */
  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_planar_localise_settings.def"
} pose_wall_planar_localise_settings;

/* The defaults. Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_settings_init(pose_wall_planar_localise_settings* settings);

/* Fails iff: settings NULL, struct_size, POSE_WALL_E_VALUE_RANGE. In the last case it writes the first fault to *fault
 * (which may be NULL). */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_settings_check(const pose_wall_planar_localise_settings* settings,
                                                                   pose_wall_planar_fault* fault);

/* ---------------------------------------------------------------------------------------------- life */

/* Bytes of the block: some 31 kB a tile, and 10 MB. settings NULL: the defaults. Fails iff: bytes NULL, settings
 * refused. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_memory_needed(const pose_wall_planar_localise_settings* settings,
                                                                  uint64_t* bytes);
/* Bytes that are enough with the default settings, for static arrays. Of this version: a later one may need more, and
 * then refuses the block. */
#define POSE_WALL_PLANAR_LOCALISE_BLOCK_MOST 46137344 /* 44 MiB */

/* An empty map in the block, which may hold garbage and must not move. settings NULL: the defaults. Fails iff: block or
 * localise NULL, settings refused, block misaligned (POSE_WALL_BLOCK_ALIGNMENT) or too small. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_open(const pose_wall_planar_localise_settings* settings,
                                                         void* block, uint64_t block_bytes,
                                                         pose_wall_planar_localise** localise);

/* All calls below fail with POSE_WALL_E_NULL, POSE_WALL_E_ENGINE (not an open localisation) and POSE_WALL_E_BUSY
 * (another call is inside). Other failures stand beside the call. */

/* ---------------------------------------------------------------------------------------------- the map */

/* Forgets the map and the place. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_clear(pose_wall_planar_localise* localise);

/* A keyframe of a trail: what was seen from where, as pose_wall_planar_slam_keyframe and pose_wall_planar_slam_points
 * give it. xy_m holds x, y, x, y ... of the surface points in base. The map's square of 4 km has the first keyframe in
 * its middle. Fails iff: POSE_WALL_PLANAR_E_ORDER (the map is finished), POSE_WALL_PLANAR_E_POSE (not finite, or beyond
 * 1e6 m); POSE_WALL_PLANAR_E_SCAN: points not finite or beyond 2000 m, or more than 6284; POSE_WALL_E_BLOCK_SMALL: more
 * than tiles_most, or outside the square. The map then lacks a part of the keyframe. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_add(pose_wall_planar_localise* localise,
                                                        const pose_wall_planar_pose* pose, const float* xy_m,
                                                        uint32_t points);

/* Cells of a grid, as pose_wall_planar_map or a PGM file has them: 65 per cent and more are a surface, 35 and less are
 * free. Cells of 5 cm hold less of the rock's relief than a trail does. Fails as pose_wall_planar_localise_add does,
 * and with POSE_WALL_PLANAR_E_GRID. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_add_grid(pose_wall_planar_localise* localise,
                                                             const pose_wall_planar_grid* grid);

/* After the last keyframe: the map is complete. Takes some 0.1 s a kilometre. Fails iff: POSE_WALL_PLANAR_E_ORDER
 * (empty, or finished before). */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_finish(pose_wall_planar_localise* localise);

/* ---------------------------------------------------------------------------------------------- a scan */

enum pose_wall_planar_localise_state {
  POSE_WALL_PLANAR_LOCALISE_SEARCHING = 0, /* no search has ended since the restart, or since the place was lost */
  POSE_WALL_PLANAR_LOCALISE_UNKNOWN =
      1, /* no place of the map fits: the machine stands elsewhere, or sees too little */
  POSE_WALL_PLANAR_LOCALISE_AMBIGUOUS = 2, /* several places fit, or one that is not certain: see the candidates */
  POSE_WALL_PLANAR_LOCALISE_UNIQUE = 3,    /* one place; it is tracked, and the last scan agrees */
  POSE_WALL_PLANAR_LOCALISE_DOUBTFUL = 4   /* tracked, but the last scan does not say that it is right */
};
/* "unique"; static storage. */
const char* pose_wall_planar_localise_state_name(uint32_t state);

/* What keeps the place from being UNIQUE: the first that does, in this order. */
enum pose_wall_planar_localise_reason {
  POSE_WALL_PLANAR_LOCALISE_NONE = 0,      /* it is */
  POSE_WALL_PLANAR_LOCALISE_NO_SEARCH = 1, /* SEARCHING: the first search goes on */
  POSE_WALL_PLANAR_LOCALISE_NO_FIT = 2,    /* UNKNOWN: no place fits with 60 % of the patches */
  /* AMBIGUOUS */
  POSE_WALL_PLANAR_LOCALISE_SEVERAL = 3, /* several places fit */
  POSE_WALL_PLANAR_LOCALISE_CROWDED = 4, /* more places were likely than the search has room for */
  POSE_WALL_PLANAR_LOCALISE_MISFIT =
      5, /* the one place fits with less than 85 %, a tracked one with 75 %: moved things? */
  POSE_WALL_PLANAR_LOCALISE_UNSEEN = 6,        /* more than a quarter of what is seen is new to the map */
  POSE_WALL_PLANAR_LOCALISE_THROUGH = 7,       /* more than 10 % of the lines of sight pass through surfaces */
  POSE_WALL_PLANAR_LOCALISE_FEW = 8,           /* too few patches of a square metre are seen */
  POSE_WALL_PLANAR_LOCALISE_SLIDES = 9,        /* along the road the place is not certain */
  POSE_WALL_PLANAR_LOCALISE_SMOOTH = 10,       /* walls without relief, and the map may lack a twin: map_is_whole */
  POSE_WALL_PLANAR_LOCALISE_SCAN_DIFFERS = 11, /* the last metres fit, the present scan does not */
  /* DOUBTFUL: MISFIT, FEW, SLIDES, and */
  POSE_WALL_PLANAR_LOCALISE_CONTRADICTED = 12, /* the scan fits with less than half of its patches */
  POSE_WALL_PLANAR_LOCALISE_REPEATED = 13,     /* the very same scan came before: it counts as one that shows nothing */
  POSE_WALL_PLANAR_LOCALISE_REASONS = 14
};
/* "slides"; static storage. */
const char* pose_wall_planar_localise_reason_name(uint32_t reason);

typedef struct pose_wall_planar_localise_result {
  uint32_t struct_size;       /* sizeof(pose_wall_planar_localise_result): set it before the call */
  uint32_t state;             /* pose_wall_planar_localise_state */
  uint32_t reason;            /* pose_wall_planar_localise_reason */
  uint32_t reserved;          /* 0 */
  int64_t stamp_ns;           /* the scan's */
  pose_wall_planar_pose pose; /* of base in map: UNIQUE and DOUBTFUL. NaN otherwise */
  double covariance[9];       /* of x, y, yaw in the axes of map; row by row. NaN without a pose */
  double fits;             /* share of the patches in seen parts of the map that fit at the level of noise; NaN: none */
  double explained;        /* share of the points there that lie on surfaces; NaN: none */
  double misfit_m;         /* root mean square of these points' distances from the surfaces; NaN: none */
  double slide_m;          /* how far the pose may slide along the road by what is seen; 0: not at all; NaN: none */
  double rival;            /* of the last search: standard errors by which the next best place fits worse; NaN: none */
  double progress;         /* of the present search, 0 to 1 */
  uint32_t candidates;     /* of the last search, that can be asked for; 0 while a place is tracked */
  uint32_t candidates_all; /* also those beyond 32 */
  uint32_t searches;       /* that have ended */
  uint32_t lost;           /* times that a place was lost */
} pose_wall_planar_localise_result;

/* One scan. odometry may be NULL. Fails iff: struct_size, POSE_WALL_PLANAR_E_SCAN, POSE_WALL_PLANAR_E_POSE (odometry
 * not finite or beyond 1e6 m), POSE_WALL_PLANAR_E_ORDER (the map is not finished). Nothing has then changed. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_process(pose_wall_planar_localise* localise,
                                                            const pose_wall_planar_scan* scan,
                                                            const pose_wall_planar_pose* odometry,
                                                            pose_wall_planar_localise_result* result);

typedef struct pose_wall_planar_candidate {
  uint32_t struct_size;       /* sizeof(pose_wall_planar_candidate): set it before the call */
  uint32_t reserved;          /* 0 */
  pose_wall_planar_pose pose; /* of base in map, now */
  double weight;              /* of all candidates together 1 */
  double worse_by;            /* standard errors by which it fits worse than the best: 0 to 4 */
  double fits;                /* share of the patches that fit */
  double spread_m;            /* places this far along the road count as the same candidate */
} pose_wall_planar_candidate;

/* A place that the last search did not exclude, the best first. Fails iff: struct_size, POSE_WALL_E_INDEX. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_candidate(const pose_wall_planar_localise* localise,
                                                              uint32_t number, pose_wall_planar_candidate* candidate);

/* Somebody knows where base stands: it is tracked from there, DOUBTFUL until a scan agrees. Fails iff:
 * POSE_WALL_PLANAR_E_POSE, POSE_WALL_E_VALUE_RANGE (sigma_m not from 0.001 to 1, sigma_rad not from 0.001 to 0.5). */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_place(pose_wall_planar_localise* localise,
                                                          const pose_wall_planar_pose* base, double sigma_m,
                                                          double sigma_rad);

/* Forgets the place, not the map: the next scan begins a search. */
POSE_WALL_CHECKED int32_t pose_wall_planar_localise_forget(pose_wall_planar_localise* localise);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_LOCALISE_H */

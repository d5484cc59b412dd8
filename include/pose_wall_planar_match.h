/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * The scan match of pose_wall_planar: where a scan was taken, by scans whose places are known.
 *
 *     pose_wall_planar_match_memory_needed(&bytes);
 *     pose_wall_planar_match_open(block, bytes, &matcher);
 *     pose_wall_planar_match_begin(matcher, x_m, y_m);
 *     for every reference: pose_wall_planar_match_add(matcher, &scan, &pose);
 *     pose_wall_planar_match_input_init(&input);
 *     input.guess = ...;
 *     result.struct_size = sizeof result;
 *     pose_wall_planar_match_scan(matcher, &scan, &input, &result);
 *
 * FRAME     that of the references' poses; all results are in it.
 * WINDOW    surfaces are kept in a square of 102 m about the place of _begin, in cells of 0.1 m. What lies outside is
 *           left out, and so is what does not fit into 24,576 cells: some 2 km of wall seen once.
 * SEARCH    the whole window of reach_m and reach_rad about the guess, in three resolutions. is_whole says whether
 *           anything that was left out could be better. Without a reach the guess is refined only.
 * COVARIANCE  from how far the match can slide before the scan contradicts it, not from slopes at the optimum: along
 *           smooth walls these promise centimetres and are metres off. Points of one surface err alike, so ten count
 *           as one. Where the scan holds nothing, the variance is that of the prior, or of the reach.
 * SOURCES   surfaces: Biber and Strasser, IROS 2003. Search: Olson, ICRA 2009; Hess and others, ICRA 2016.
 * COST      0.1 ms without a search, some milliseconds with one.
 *
 * The other rules are those of pose_wall_planar.h.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_MATCH_H
#define POSE_WALL_PLANAR_MATCH_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pose_wall_planar_matcher pose_wall_planar_matcher;

/* Bytes of the block, some 7 MB. Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_match_memory_needed(uint64_t* bytes);
/* Bytes that are enough, for static arrays. Of this version: a later one may need more, and then refuses the block. */
#define POSE_WALL_PLANAR_MATCH_BLOCK_MOST 8388608 /* 8 MiB */

/* A matcher without references in the block, which may hold garbage and must not move. Fails iff: block or matcher
 * NULL, block misaligned (POSE_WALL_BLOCK_ALIGNMENT) or too small. */
POSE_WALL_CHECKED int32_t pose_wall_planar_match_open(void* block, uint64_t block_bytes,
                                                      pose_wall_planar_matcher** matcher);

/* All calls below fail with POSE_WALL_E_NULL, POSE_WALL_E_ENGINE (not an open matcher) and POSE_WALL_E_BUSY (another
 * call is inside). Other failures stand beside the call. */

/* Forgets the references. The window's middle is here. Fails iff: POSE_WALL_PLANAR_E_POSE (not finite, or beyond 1e6
 * m). */
POSE_WALL_CHECKED int32_t pose_wall_planar_match_begin(pose_wall_planar_matcher* matcher, double x_m, double y_m);

/* A scan that was taken with base at this pose. Fails iff: POSE_WALL_PLANAR_E_SCAN, POSE_WALL_PLANAR_E_POSE (not
 * finite, beyond 1e6 m or 10,000 rad), POSE_WALL_PLANAR_E_ORDER (before _begin, or after the first match). */
POSE_WALL_CHECKED int32_t pose_wall_planar_match_add(pose_wall_planar_matcher* matcher,
                                                     const pose_wall_planar_scan* scan,
                                                     const pose_wall_planar_pose* base);

typedef struct pose_wall_planar_match_input {
  uint32_t struct_size;        /* sizeof(pose_wall_planar_match_input) */
  uint32_t has_prior;          /* 1: the guess joins in with its covariance; 0: it is a place to begin at */
  pose_wall_planar_pose guess; /* of base */
  double reach_m;              /* 0.3: searched to each side of the guess, in x and in y; 0 to 38 */
  double reach_rad;            /* 0.1: likewise in yaw; 0 to pi. Both 0: no search */
  double covariance[9];        /* of the guess: x, y, yaw in the references' axes, row by row. Read with has_prior */
} pose_wall_planar_match_input;

/* No prior, a guess at the origin, and the defaults above. Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_match_input_init(pose_wall_planar_match_input* input);

enum pose_wall_planar_match_state {
  POSE_WALL_PLANAR_MATCH_NONE = 0, /* fewer than ten points lie on surfaces: the pose is NaN */
  POSE_WALL_PLANAR_MATCH_FOUND = 1
};

typedef struct pose_wall_planar_match_result {
  uint32_t struct_size;         /* sizeof(pose_wall_planar_match_result): set it before the call */
  uint32_t state;               /* pose_wall_planar_match_state */
  pose_wall_planar_pose pose;   /* of base */
  double covariance[9];         /* of x, y, yaw in the references' axes; row by row */
  double explained;             /* share of the points in known places that lie on surfaces, 0 to 1 */
  double misfit_m;              /* root mean square of these points' distances from the surfaces */
  double slide_m;               /* the match may slide so far to either side; 0: not at all, 3.2: or further */
  double slide_rad;             /* direction of that, in the references' axes */
  double score;                 /* of the search: mean likelihood of the points, 0 to 1; NaN without a search */
  double second_score;          /* of the best pose that is no neighbour of the best; 0: none */
  pose_wall_planar_pose second; /* that pose; NaN: none */
  uint32_t is_whole;            /* 1: no part of the searched window that was left out can be better */
  uint32_t points;              /* of the scan, in known places */
} pose_wall_planar_match_result;

/* Places a scan on the references. Fails iff: a struct_size, POSE_WALL_PLANAR_E_SCAN, POSE_WALL_PLANAR_E_POSE (the
 * guess, or a covariance that is not finite, symmetric and positive), POSE_WALL_E_VALUE_RANGE (a reach),
 * POSE_WALL_PLANAR_E_ORDER (before _begin). The result is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_planar_match_scan(pose_wall_planar_matcher* matcher,
                                                      const pose_wall_planar_scan* scan,
                                                      const pose_wall_planar_match_input* input,
                                                      pose_wall_planar_match_result* result);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_MATCH_H */

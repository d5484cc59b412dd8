/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * Explains a frame. It is computed once more, and every gate and every considered plane is noted. For people at a desk
 * and for tests. libpose_wall_traced.a is the engine of the same sources with notes; libpose_wall.a holds nothing of
 * this. Both may be in one program: the traced one defines pose_wall_trace_* alone. It is not installed, and no part of
 * the ABI: the notes change with the engine.
 *
 *     pose_wall_save(engine, memento, sizeof memento);     before the frame
 *     pose_wall_process(engine, &cloud, &result);
 *     pose_wall_trace_frame(&config, memento, sizeof memento, &cloud, block, bytes, &again, trace);
 *
 * result and again have the same bits (except stage_ns, which needs a clock), so trace describes both.
 */

#ifndef POSE_WALL_TRACE_H
#define POSE_WALL_TRACE_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a note is about. Quantity q is POSE_WALL_TRACE_QUANTITY + q. */
enum pose_wall_trace_subject {
  POSE_WALL_TRACE_FRAME = 0,
  POSE_WALL_TRACE_FLOOR = 1,
  POSE_WALL_TRACE_LEFT = 2,
  POSE_WALL_TRACE_RIGHT = 3,
  POSE_WALL_TRACE_WALLS = 4, /* both sides at once */
  POSE_WALL_TRACE_AHEAD = 5, /* planes across the road: candidates only, where any were looked for */
  POSE_WALL_TRACE_BEHIND = 6,
  POSE_WALL_TRACE_QUANTITY = 8
};
#define POSE_WALL_TRACE_SUBJECTS (POSE_WALL_TRACE_QUANTITY + POSE_WALL_QUANTITIES)

/* In the order of the pipeline. pose_wall_trace_gate_info has the meaning of each. */
enum pose_wall_trace_gate_id {
  /* the frame */
  POSE_WALL_TRACE_LEAF = 0,
  POSE_WALL_TRACE_VOXELS_FIT,
  POSE_WALL_TRACE_POINTS,
  /* the floor, by radius */
  POSE_WALL_TRACE_FLOOR_POINTS,
  POSE_WALL_TRACE_FLOOR_PLANES,
  POSE_WALL_TRACE_FLOOR_FIT,
  POSE_WALL_TRACE_FLOOR_RIVAL,
  POSE_WALL_TRACE_FLOOR_ALONE,
  POSE_WALL_TRACE_FLOOR_TILT,
  POSE_WALL_TRACE_FLOOR_HEIGHT_MIN,
  POSE_WALL_TRACE_FLOOR_HEIGHT_MAX,
  POSE_WALL_TRACE_FLOOR_STAYED,
  POSE_WALL_TRACE_FLOOR_INLIERS,
  POSE_WALL_TRACE_FLOOR_AREA,
  POSE_WALL_TRACE_FLOOR_NEAR,
  POSE_WALL_TRACE_FLOOR_BESIDE,
  POSE_WALL_TRACE_FLOOR_BY_WALLS,
  /* the choice of the walls */
  POSE_WALL_TRACE_LEVELLED,
  POSE_WALL_TRACE_WALL_PLANES,
  POSE_WALL_TRACE_WALL_INLIERS,
  POSE_WALL_TRACE_WALL_LENGTH,
  POSE_WALL_TRACE_WALL_SOLID,
  POSE_WALL_TRACE_WALL_LEAN,
  POSE_WALL_TRACE_PAIR_PARALLEL,
  POSE_WALL_TRACE_WALL_LENGTH_ALONE,
  POSE_WALL_TRACE_WALLS_PARALLEL,
  POSE_WALL_TRACE_WALL_CHOSEN,
  POSE_WALL_TRACE_ACROSS,
  POSE_WALL_TRACE_WALL_RIVAL,
  POSE_WALL_TRACE_WALL_RIVAL_BEHIND,
  POSE_WALL_TRACE_WALL_RIVAL_ENDS,
  POSE_WALL_TRACE_WALL_RIVAL_STOPS,
  /* the fit of a chosen wall */
  POSE_WALL_TRACE_WALL_FIT,
  POSE_WALL_TRACE_WALL_BEND,
  POSE_WALL_TRACE_SAMPLE_HOLE,
  POSE_WALL_TRACE_SAMPLE_STEP,
  POSE_WALL_TRACE_WALL_AWAY,
  POSE_WALL_TRACE_FIT_INLIERS,
  POSE_WALL_TRACE_FIT_STAYED,
  POSE_WALL_TRACE_WALL_YAW,
  /* the close look */
  POSE_WALL_TRACE_WALL_BRIGHT,
  POSE_WALL_TRACE_WALL_TOP_SEEN,
  POSE_WALL_TRACE_WALL_OPEN_DOUBT,
  POSE_WALL_TRACE_WALL_GROOVES,
  POSE_WALL_TRACE_WALL_SILENT,
  POSE_WALL_TRACE_WALL_ISLAND,
  POSE_WALL_TRACE_WALL_LOW,
  POSE_WALL_TRACE_WALL_LAYER,
  POSE_WALL_TRACE_ALONE_APART,
  POSE_WALL_TRACE_WALL_NEAR,
  /* time and the outcome */
  POSE_WALL_TRACE_STAMP_STILL,
  POSE_WALL_TRACE_STAMP_BACK,
  POSE_WALL_TRACE_STAMP_LEAP,
  POSE_WALL_TRACE_INPUTS,
  POSE_WALL_TRACE_REPEATED,
  POSE_WALL_TRACE_FROZEN,
  POSE_WALL_TRACE_PROTECTION_RAW,
  POSE_WALL_TRACE_RATE,
  POSE_WALL_TRACE_INNOVATION,
  POSE_WALL_TRACE_DOUBTED,
  POSE_WALL_TRACE_CONFIRMED,
  POSE_WALL_TRACE_PROTECTION_SMOOTHED,
  POSE_WALL_TRACE_EVER,
  POSE_WALL_TRACE_PROTECTION_HELD,
  POSE_WALL_TRACE_HELD_AGE,
  POSE_WALL_TRACE_HELD_BEFORE,
  POSE_WALL_TRACE_WORK,
  POSE_WALL_TRACE_GATES
};

/* Effect on the subject when the gate does not hold. */
enum pose_wall_trace_effect {
  POSE_WALL_TRACE_TELLS = 0,  /* the next step differs */
  POSE_WALL_TRACE_DOUBTS = 1, /* at best degraded, or a wider protection level */
  POSE_WALL_TRACE_REFUSES = 2 /* not measured in this frame */
};

enum pose_wall_trace_sense {
  POSE_WALL_TRACE_AT_LEAST = 0, /* passes if the value is the limit or more */
  POSE_WALL_TRACE_AT_MOST = 1,
  POSE_WALL_TRACE_IS_SO = 2, /* value 1 passes, 0 does not: no amounts */
  POSE_WALL_TRACE_BELOW = 3  /* passes if the value is less than the limit */
};

typedef struct pose_wall_trace_info {
  const char* name; /* "wall_length" */
  const char* key;  /* config key of the limit; "" for a constant of the engine. Two keys divided by '|': for angles and
                       for distances */
  const char* unit; /* of value and limit: "m", "m2", "rad", "s", "points", "share" (of 1), "frames", or "": a bare
                       number, or the subject's own unit (PROTECTION_*, INNOVATION) */
  const char* asks; /* "the wall is supported along the road": meaning of the value */
  const char* limit;  /* as the table has it: "0.5", "s.wall_length_min", "BY_CALLER" where each frame has its own */
  const char* origin; /* source of the limit: "key", "definition", a scene, or a judgement and its date */
  uint32_t sense;     /* pose_wall_trace_sense */
  uint32_t effect;    /* pose_wall_trace_effect */
  uint32_t reasons;   /* pose_wall_reason bits that it sets when it does not hold */
  uint32_t reserved;
} pose_wall_trace_info;

/* Static storage. Fails iff: NULL, POSE_WALL_E_INDEX. */
int32_t pose_wall_trace_gate_info(uint32_t gate, pose_wall_trace_info* info);

/* Replaces the limit of a gate in all following traced frames, in every thread. For a gate without amounts 0 lets
 * everything pass. FLOOR_PLANES takes 1 or more, because the fit needs a plane. For sweeps: `pose_wall campaign
 * --sweep` sets limits before the frames, none while they run. Fails iff: POSE_WALL_E_INDEX. */
int32_t pose_wall_trace_set_limit(uint32_t gate, double limit);
/* In all following traced frames, in every thread, the gate judges and notes as before but stops nothing. Where the
 * engine uses the gate's limit for other purposes, as to bound a search, it still does. For `pose_wall campaign
 * --ablate`. Fails iff: POSE_WALL_E_INDEX; POSE_WALL_E_VALUE_RANGE for FLOOR_PLANES, because the fit needs a plane. */
int32_t pose_wall_trace_let_pass(uint32_t gate);
/* Restores the table's limits, and lets no gate pass any more. */
void pose_wall_trace_forget_limits(void);

enum pose_wall_trace_answer {
  POSE_WALL_TRACE_FAILED = 0,
  POSE_WALL_TRACE_PASSED = 1,
  POSE_WALL_TRACE_ANSWERED = 2 /* failed on the endless plane, whose place that of the region took (region: on) */
};

typedef struct pose_wall_trace_gate {
  uint32_t subject; /* pose_wall_trace_subject */
  uint32_t gate;    /* pose_wall_trace_gate_id */
  uint32_t attempt; /* floor: which radius, from 0. walls: 0 while planes are chosen, 1 for the fit */
  uint32_t passed;  /* pose_wall_trace_answer */
  double value;
  double limit;
} pose_wall_trace_gate;

/* The fate of a considered plane. */
enum pose_wall_trace_fate {
  POSE_WALL_TRACE_CHOSEN = 0,
  POSE_WALL_TRACE_RIVAL = 1,  /* nearly as good: the protection level reaches to it */
  POSE_WALL_TRACE_WEAKER = 2, /* passed its gates; another one has a higher score */
  POSE_WALL_TRACE_GATES_FAILED = 3,
  POSE_WALL_TRACE_OUT_OF_RANGE = 4, /* tilt or height (floor), direction or lean (wall) */
  POSE_WALL_TRACE_UNSUPPORTED = 5,  /* too few points support it: the fit failed, or it may be chance */
  POSE_WALL_TRACE_REPEATS = 6,      /* the same surface as another one */
  POSE_WALL_TRACE_MUCH_BELOW = 7,   /* floor: too much is seen below it */
  POSE_WALL_TRACE_REFLECTION = 8    /* floor: seen through open floor, a mirror image in wet ground */
};

typedef struct pose_wall_trace_candidate {
  uint32_t subject; /* floor, left, right, ahead, behind */
  uint32_t attempt; /* floor: which radius */
  uint32_t fate;    /* pose_wall_trace_fate */
  uint32_t reasons; /* pose_wall_reason bits of the gates it fails */
  double normal[3]; /* floor: base frame. walls: levelled frame */
  double d_m;
  double height_m; /* floor: of the sensor above it */
  double tilt_rad; /* floor: against base. walls: lean from the vertical */
  double score_m2; /* decides the choice: open or solid area, less the evidence against it */
  double area_m2;
  double length_m; /* walls: supported along the road */
  double seen_through;
  double inliers; /* walls: measured points on it */
  double support; /* floor: approximate share of the tested points on it */
} pose_wall_trace_candidate;

#define POSE_WALL_TRACE_GATES_MAX 512
#define POSE_WALL_TRACE_CANDIDATES_MAX 192
#define POSE_WALL_TRACE_ATTEMPTS_MAX 16

typedef struct pose_wall_trace {
  uint32_t gates;
  uint32_t candidates;
  uint32_t dropped;        /* notes without room */
  uint32_t floor_attempts; /* radii that were tried */
  uint32_t floor_attempt;  /* the one that was taken */
  uint32_t reserved;
  double floor_radius_m[POSE_WALL_TRACE_ATTEMPTS_MAX];
  pose_wall_trace_gate gate[POSE_WALL_TRACE_GATES_MAX];
  pose_wall_trace_candidate candidate[POSE_WALL_TRACE_CANDIDATES_MAX];
  uint64_t failed[2]; /* bit g % 64 of word g / 64: gate g failed at least once, perhaps on a plane without a note */
} pose_wall_trace;

/* Computes one frame by a fresh engine in block (pose_wall_memory_needed bytes, POSE_WALL_BLOCK_ALIGNMENT), and fills
 * trace with its notes. The engine first loads memento; NULL: it starts without memory. Set result->struct_size first.
 * Fails as pose_wall_open, pose_wall_load and pose_wall_process do; trace is then empty. One frame per thread at a
 * time. */
int32_t pose_wall_trace_frame(const pose_wall_config* config, const void* memento, uint64_t memento_bytes,
                              const pose_wall_cloud* cloud, void* block, uint64_t block_bytes, pose_wall_result* result,
                              pose_wall_trace* trace);

/* Saves the memory of the engine that pose_wall_trace_frame left in block, as pose_wall_save does: for a sequence of
 * frames. Fails as pose_wall_save does. */
int32_t pose_wall_trace_save(const void* block, void* memento, uint64_t memento_bytes);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_TRACE_H */

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * The motion library with other limits than its table has (src/motion/gates.def), and with a count of how often each
 * gate was asked and failed. For sweeps, ablations and tests. libpose_wall_motion_traced.a is of the same sources as
 * libpose_wall_motion.a, which holds nothing of this. Both may be in one program: the traced one defines
 * pose_wall_motion_trace_* alone. It is not installed, and no part of the ABI.
 *
 * A pose_wall_motion that pose_wall_motion_trace_open has opened goes to pose_wall_motion_trace_frame alone.
 */

#ifndef POSE_WALL_MOTION_TRACE_H
#define POSE_WALL_MOTION_TRACE_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

#define POSE_WALL_MOTION_TRACE_GATES 20

typedef struct pose_wall_motion_trace_info {
  const char* name;   /* "matched" */
  const char* sense;  /* how the value has to stand to the limit: "at least", "at most", "above", "below" */
  const char* limit;  /* as the table has it */
  const char* unit;   /* of value and limit: "ratio", "share", "deviations", "m", "s", or what is counted */
  const char* origin; /* source of the limit */
  const char* asks;   /* meaning of the value, and what follows if it does not pass */
} pose_wall_motion_trace_info;

/* Static storage. Gates are numbered from 0 in the order in which a frame meets them. Fails iff: NULL,
 * POSE_WALL_E_INDEX. */
int32_t pose_wall_motion_trace_gate_info(uint32_t gate, pose_wall_motion_trace_info* info);

/* Replaces the limit of a gate in all following traced frames, in every thread. To be set before the frames. Fails iff:
 * POSE_WALL_E_INDEX; POSE_WALL_E_VALUE_RANGE unless the limit is from 0 to 1e9. */
int32_t pose_wall_motion_trace_set_limit(uint32_t gate, double limit);
/* In all following traced frames, in every thread, the gate judges and counts as before and lets everything pass. Where
 * the library uses its limit for other purposes, it still does. Fails iff: POSE_WALL_E_INDEX. */
int32_t pose_wall_motion_trace_let_pass(uint32_t gate);
/* Restores the table's limits, and lets no gate pass any more. */
void pose_wall_motion_trace_forget_limits(void);

/* Of one frame, by gate. */
typedef struct pose_wall_motion_trace {
  uint32_t asked[POSE_WALL_MOTION_TRACE_GATES];
  uint32_t failed[POSE_WALL_MOTION_TRACE_GATES]; /* of those asked */
} pose_wall_motion_trace;

/* As pose_wall_motion_open. */
int32_t pose_wall_motion_trace_open(const pose_wall_config* config, const pose_wall_motion_settings* settings,
                                    void* block, uint64_t block_bytes, pose_wall_motion** motion);
/* As pose_wall_motion_process, with the same bits where no limit is set. Fills trace, or fails with POSE_WALL_E_NULL.
 */
int32_t pose_wall_motion_trace_frame(pose_wall_motion* motion, const pose_wall_cloud* cloud,
                                     pose_wall_motion_result* result, pose_wall_motion_trace* trace);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_MOTION_TRACE_H */

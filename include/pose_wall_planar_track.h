/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * The tracker of pose_wall_planar: drives a machine on tracks along a route. pose_wall_planar.h is the manual of what
 * all parts share. The library drives nothing itself: commands go to the caller.
 *
 * POSES     of the turning centre, x forward and y left, as in pose_wall_planar_plan.h, in the frame of the route.
 *           pose_wall_planar_machine_of_base makes one of a pose of base. Speeds are along forward_axis then.
 * METHOD    Regulated pursuit (Macenski, Singh, Martin and Gines 2023: speed falls with curvature, with nearness and
 *           towards stops), with the law of a path follower in place of a point ahead: the route's own curvature, and
 *           feedback of the cross error and of the heading that lets both fade without overshoot within settle_m of
 *           way. Commands of the last delay_s and since the pose's time have not shown yet: the pose is carried
 *           forward by them, through a model of the drive (Smith 1957). How much the tracks slip, and to which side,
 *           is learnt on the way.
 * STOPS     The machine stops at cusps, before and after turns on the spot, and at the end, within stop_within_m. It
 *           goes on when its speed has died down by the model, and by measurement where there is one.
 * FAILURES  Without a pose, with one that is none, too uncertain, too old or of the future, the command is 0 at once
 *           and the state NO_POSE. It goes on by itself with the next good pose. Too far from the route, or turned too
 *           far off it, the command is 0 and the state OFF_PATH until a new route is set.
 * SAFETY    The tracker avoids nothing. The obstacle stop is a part of its own (pose_wall_planar_stop.h).
 * COST      A step takes some 2 microseconds, without the clearance callback.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_TRACK_H
#define POSE_WALL_PLANAR_TRACK_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_plan.h"
#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pose_wall_planar_tracker pose_wall_planar_tracker;

/* Distance in m from a point to the nearest thing, for instance of pose_wall_planar_plan_clearance. NaN: not known,
 * which slows as much as no room at all. */
typedef double (*pose_wall_planar_clearance)(void* context, double x_m, double y_m);

typedef struct pose_wall_planar_track_settings {
  uint32_t struct_size; /* sizeof(pose_wall_planar_track_settings) */
  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_planar_track_settings.def"
} pose_wall_planar_track_settings;

POSE_WALL_CHECKED int32_t pose_wall_planar_track_settings_init(pose_wall_planar_track_settings* settings);
/* POSE_WALL_OK, or POSE_WALL_E_VALUE_RANGE with the member at fault, if `fault` is not NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_track_settings_check(const pose_wall_planar_track_settings* settings,
                                                                pose_wall_planar_fault* fault);
/* Bytes of the block. settings NULL: the defaults. Fails iff: bytes NULL, settings as in the check. */
POSE_WALL_CHECKED int32_t pose_wall_planar_track_memory_needed(const pose_wall_planar_track_settings* settings,
                                                               uint64_t* bytes);
/* Bytes that are enough with the default settings, for static arrays. Of this version: a later one may need more, and
 * then refuses the block. */
#define POSE_WALL_PLANAR_TRACK_BLOCK_MOST 524288
/* As pose_wall_planar_plan_open. */
POSE_WALL_CHECKED int32_t pose_wall_planar_track_open(const pose_wall_planar_track_settings* settings, void* block,
                                                      uint64_t block_bytes, pose_wall_planar_tracker** tracker);

/* Copies a route, as pose_wall_planar_plan wrote it, and begins at its first pose. What was learnt of slip stays.
 * `clearance` may be NULL: nothing is near. Fails iff: NULL, not open, POSE_WALL_E_VALUE_RANGE for no pose or more than
 * path_max, POSE_WALL_PLANAR_E_POSE for a pose that is none, a curvature or length that is not finite, or lengths that
 * fall. The route before is then kept. */
POSE_WALL_CHECKED int32_t pose_wall_planar_track_route(pose_wall_planar_tracker* tracker,
                                                       const pose_wall_planar_path_pose* poses, uint32_t count,
                                                       pose_wall_planar_clearance clearance, void* context);

typedef struct pose_wall_planar_track_input {
  uint32_t struct_size;       /* sizeof(pose_wall_planar_track_input) */
  uint32_t has_pose;          /* 1: pose is new or at least valid; 0: there is none */
  int64_t now_ns;             /* time of this step; rising */
  int64_t pose_ns;            /* time of the pose */
  pose_wall_planar_pose pose; /* of the turning centre */
  double pose_level_m;        /* how far off it may be */
  double speed_m_s;           /* measured along the machine, backwards negative; NaN: not measured */
} pose_wall_planar_track_input;

enum pose_wall_planar_track_state {
  POSE_WALL_PLANAR_TRACK_IDLE = 0,      /* no route */
  POSE_WALL_PLANAR_TRACK_FOLLOWING = 1, /* drives along the route */
  POSE_WALL_PLANAR_TRACK_TURNING = 2,   /* on the spot */
  POSE_WALL_PLANAR_TRACK_STOPPING = 3,  /* at a cusp, or before or after a turn: waits to stand still */
  POSE_WALL_PLANAR_TRACK_DONE = 4,      /* stands at the end */
  POSE_WALL_PLANAR_TRACK_OFF_PATH = 5,  /* too far from the route: a new one is needed */
  POSE_WALL_PLANAR_TRACK_NO_POSE = 6    /* no good pose: stands until there is one */
};

enum pose_wall_planar_track_slowed_by {
  POSE_WALL_PLANAR_SLOWED_BY_NOTHING = 0,
  POSE_WALL_PLANAR_SLOWED_BY_CURVE = 1,
  POSE_WALL_PLANAR_SLOWED_BY_CLEARANCE = 2,
  POSE_WALL_PLANAR_SLOWED_BY_STOP = 3 /* a cusp, a turn on the spot, or the end is near */
};

typedef struct pose_wall_planar_track_command {
  uint32_t struct_size; /* sizeof(pose_wall_planar_track_command) */
  uint32_t state;       /* pose_wall_planar_track_state */
  uint32_t slowed_by;   /* pose_wall_planar_track_slowed_by */
  uint32_t pose_index;  /* of the route: the last pose that was passed */
  double speed_m_s;     /* backwards negative; 0 unless following */
  double turn_rad_s;    /* positive to the left */
  double left_m_s;      /* the same as speeds of the two tracks */
  double right_m_s;
  double cross_error_m;     /* of the pose given, to the left of the route as driven; NaN where none is known */
  double heading_error_rad; /* likewise, to the left */
  double along_m;           /* length of the route up to there; NaN where none is known */
  double remaining_m;       /* from there to the end; NaN where none is known */
  double slip;              /* learnt: part of the commanded speed that is lost; 0 before anything is known */
  double drift_1_m;         /* learnt: curvature to the left that uneven tracks add */
} pose_wall_planar_track_command;

/* One step, 5 to 100 times a second. Set command->struct_size first. A bad pose is no error but NO_POSE. A time that
 * does not rise is taken for the step before it. Fails iff: NULL, a struct_size of another version, not open,
 * POSE_WALL_E_BUSY. */
POSE_WALL_CHECKED int32_t pose_wall_planar_track_step(pose_wall_planar_tracker* tracker,
                                                      const pose_wall_planar_track_input* input,
                                                      pose_wall_planar_track_command* command);

/* The machine got another command than the last step gave: the obstacle stop, or a driver, has changed it. The model of
 * the drive goes on with this one; without the call the tracker takes a stop for slip. Fails iff: NULL, not open,
 * POSE_WALL_E_BUSY, POSE_WALL_E_VALUE_RANGE (not within 1000 m/s and rad/s); nothing has then changed. */
POSE_WALL_CHECKED int32_t pose_wall_planar_track_obeyed(pose_wall_planar_tracker* tracker, double speed_m_s,
                                                        double turn_rad_s);

/* "following", ...; static storage. */
const char* pose_wall_planar_track_state_name(uint32_t state);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_TRACK_H */

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * pose_wall_planar_stop: stops the machine before it touches anything. It needs no map, no engine and no other part.
 *
 * Per frame it reads the raw cloud and the machine's motion, and gives a state (go, slow, stop) and the speed at which
 * the machine can still stop before it touches anything.
 *
 *     pose_wall_planar_stop_settings settings;
 *     pose_wall_planar_stop_settings_init(&settings);
 *     pose_wall_planar_stop_memory_needed(&bytes);
 *     pose_wall_planar_stop *stop;
 *     pose_wall_planar_stop_open(&config, &settings, block, bytes, &stop);
 *     result.struct_size = sizeof result;
 *     for every frame:    pose_wall_planar_stop_process(stop, &cloud, &motion, now_ns, &result);
 *     at least each 20 ms: pose_wall_planar_stop_tick(stop, now_ns, &result);
 *     for a controller:    pose_wall_planar_stop_image_fill(&result, &image);
 *
 * RULE      a status other than POSE_WALL_OK means: stop. So does silence of the caller: no result is no permission.
 * FREE      a place is free only where that was seen. A ray must have passed over it low enough to hit the smallest
 *           thing there; another one where a person would stand; and one below top_m, where something may hang. Places
 *           without such rays are blind. Blind places stop like things.
 * SWEEP     the footprint along the arc of the motion, from now to standstill, without gaps between samples. It
 *           includes the turn of the tail. Margins grow with the bounds of speed and turn rate.
 * TIME      from the stamp to the first effect of the brakes may pass: scan_s + stale_s + delay_s + latency_s. The
 *           machine may be anywhere that it can reach in this time and the braking time.
 * CLOCK     now_ns and the stamps are of one clock. While now_ns does not rise, nothing tells how old a frame is: the
 *           heartbeat stands, and after 100 such calls the state is stop (STALE). So a controller must watch the
 *           heartbeat. A clock that was set back is told (INVALID), and all is forgotten as by _reset. That is so where
 *           now_ns goes back by more than 5 ms, or where the stamps of two frames in a row do. The stop then goes on by
 *           itself as after the start: no reset is needed, but someone must look again where the sensor sees nothing.
 * DUST      a few returns are doubtful. They count where four are about one place, in a frame or over delay_s. That
 *           takes at most delay_s, which is part of TIME. More count at once. A few returns at a place where
 *           rays went through every smallest thing are dust, or thinner than what is found for certain. They count
 *           once they come in more frames in turn than dust as thick as around them would bring in an hour.
 * MEMORY    of places: what was seen low, or of what hangs, is remembered for memory_s, until the errors of the way
 *           since then reach drift_max_m. Things stay until they are seen gone. A person is excluded only by
 *           rays of the last delay_s. After the start nothing is known of places that the sensor cannot see;
 *           pose_wall_planar_stop_confirm tells that someone has looked.
 * FRAMES    base as in pose_wall.h. Footprint, motion and results are in base; forward is forward_axis of the config.
 * UNITS     metres, radians, seconds, nanoseconds (stamps). NaN where there is no number.
 * FLIPPED   the block has no sum, unlike the engine's: a bit that flips in it may hide a place. Use memory that mends
 *           errors, and let a controller watch the heartbeat.
 * THREADS   an opened stop belongs to one thread at a time.
 *
 * NOT COVERED   planar_stop.md of the package states what is guaranteed, for which things, and under which assumptions.
 *           The library is no certified safety component.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_STOP_H
#define POSE_WALL_PLANAR_STOP_H

#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define POSE_WALL_PLANAR_STOP_CORNERS_MAX 12

/* Extrinsic, forward_axis, range_min, range_max and the body boxes come from the engine's config. Returns beyond
 * range_max show nothing: give the sensor's own reach, or long roads are blind. */
typedef struct pose_wall_planar_stop_settings {
  uint32_t struct_size; /* set by pose_wall_planar_stop_settings_init */
  uint32_t corners;     /* 3 to POSE_WALL_PLANAR_STOP_CORNERS_MAX corners of the footprint */
  /* x, y of the corners in base, counter-clockwise, strictly convex. The footprint holds the origin of base. Every
   * part of the machine that can touch anything is above it, the boom as well. Edges are 0.1 m at least; no corner is
   * further than 5 m from base. */
  double corner_m[POSE_WALL_PLANAR_STOP_CORNERS_MAX][2];

  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_planar_stop_settings.def"
} pose_wall_planar_stop_settings;

/* A roadheader of 4.5 x 1.2 m. Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_settings_init(pose_wall_planar_stop_settings* settings);
/* The four corners of a rectangle, front and left as forward_axis +X has them. Fails iff: NULL, struct_size. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_rectangle(pose_wall_planar_stop_settings* settings, double x_min_m,
                                                          double x_max_m, double y_min_m, double y_max_m);
/* Fails iff: settings NULL, not initialised (POSE_WALL_E_STRUCT_SIZE), POSE_WALL_E_VALUE_RANGE (*fault is written then,
 * unless fault is NULL). */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_settings_check(const pose_wall_planar_stop_settings* settings,
                                                               pose_wall_planar_fault* fault);

/* The machine's motion, each part with its bit. Give both the measured motion and the command under way: the stop
 * covers all between them. Turn only once the stop has answered that command: people beside the machine count for
 * what moves towards them. Where no measured motion is given, that of the odometry counts (_note_odometry), with its
 * own levels. Without any the stop assumes every motion that the settings allow. Speeds are along forward_axis,
 * negative backwards; turns are to the left. */
enum pose_wall_planar_stop_given { POSE_WALL_PLANAR_STOP_MEASURED = 1, POSE_WALL_PLANAR_STOP_COMMANDED = 2 };
typedef struct pose_wall_planar_stop_motion {
  uint32_t struct_size; /* sizeof(pose_wall_planar_stop_motion) */
  uint32_t given;       /* pose_wall_planar_stop_given bits */
  double speed_m_s;     /* measured, of the origin of base along forward_axis */
  double turn_rad_s;
  double command_speed_m_s;
  double command_turn_rad_s;
} pose_wall_planar_stop_motion;

enum pose_wall_planar_stop_state {
  POSE_WALL_PLANAR_STOP_STOP = 0,
  POSE_WALL_PLANAR_STOP_SLOW = 1, /* drive no faster than allowed_speed_m_s */
  POSE_WALL_PLANAR_STOP_GO = 2
};
/* "stop"; static storage. */
const char* pose_wall_planar_stop_state_name(uint32_t state);

/* Why, in bits. */
enum pose_wall_planar_stop_reason {
  POSE_WALL_PLANAR_STOP_R_STALE = 1 << 0,     /* no frame, one older than stale_s, or a clock that stands */
  POSE_WALL_PLANAR_STOP_R_BLIND = 1 << 1,     /* a place in the way was not seen free */
  POSE_WALL_PLANAR_STOP_R_INVALID = 1 << 2,   /* a clock or stamp went back, a stamp of the future, few returns */
  POSE_WALL_PLANAR_STOP_R_FROZEN = 1 << 3,    /* the cloud, or 10 degrees of it and more, came before */
  POSE_WALL_PLANAR_STOP_R_MISSING = 1 << 4,   /* no motion was given, or it is not finite: every motion is assumed */
  POSE_WALL_PLANAR_STOP_R_THING = 1 << 5,     /* a thing is in the way */
  POSE_WALL_PLANAR_STOP_R_LOW = 1 << 6,       /* it is a low one */
  POSE_WALL_PLANAR_STOP_R_NEARING = 1 << 7,   /* it may walk into the way */
  POSE_WALL_PLANAR_STOP_R_SPEED = 1 << 8,     /* the machine is faster than it can stop */
  POSE_WALL_PLANAR_STOP_R_DUST = 1 << 9,      /* doubtful returns were seen near the way: dust, or a thin thing */
  POSE_WALL_PLANAR_STOP_R_NO_FLOOR = 1 << 10, /* the floor was not seen: the machine's own plane is used */
  POSE_WALL_PLANAR_STOP_R_RESTART = 1 << 11   /* the way is clear, but not for restart_s yet */
};
#define POSE_WALL_PLANAR_STOP_REASON_COUNT 12
/* "stale", and one English sentence; static storage. */
const char* pose_wall_planar_stop_reason_name(uint32_t bit_index);
const char* pose_wall_planar_stop_reason_text(uint32_t bit_index);

/* Heights of a thing. */
enum pose_wall_planar_stop_height {
  POSE_WALL_PLANAR_STOP_NONE = 0,     /* nothing is in the way */
  POSE_WALL_PLANAR_STOP_LOW = 1,      /* below thing_height_m */
  POSE_WALL_PLANAR_STOP_HIGH = 2,     /* above, and perhaps hanging */
  POSE_WALL_PLANAR_STOP_STANDING = 3, /* from below thing_height_m to above it */
  POSE_WALL_PLANAR_STOP_UNSEEN = 4    /* a blind place */
};

typedef struct pose_wall_planar_stop_result {
  uint32_t struct_size; /* set by the caller to sizeof(pose_wall_planar_stop_result) before the call */
  uint32_t state;       /* pose_wall_planar_stop_state */
  uint32_t reasons;     /* pose_wall_planar_stop_reason bits */
  uint32_t heartbeat;   /* one more with every call of a later now_ns (see CLOCK); after 4294967295 comes 0 */
  int64_t stamp_ns;     /* of the last frame */
  int64_t now_ns;       /* of this call */
  uint64_t frames;      /* since it was opened or reset */

  /* The machine may move along the given motion so that its fastest point has this speed. 0 while state is stop. */
  double allowed_speed_m_s;
  double allowed_turn_rad_s; /* the turn rate of that motion */
  double rim_speed_m_s;      /* speed of the fastest point now, measured or commanded */
  double stop_speed_m_s;     /* above this speed the machine is stopped: no slack */
  double time_to_contact_s;  /* at this speed, without braking; infinite: none within the reach of the sweep */

  /* what limits the speed most, things and blind places; NaN without */
  double nearest_m[2];       /* in base */
  double nearest_distance_m; /* from the footprint as it stands */
  double nearest_size_m;     /* across, of what hangs together within 1 m */
  double nearest_age_s;      /* it has been there for so long */
  uint32_t nearest_height;   /* pose_wall_planar_stop_height */
  uint32_t points_in;
  uint32_t points_used; /* returns within range, not of the machine */
  uint32_t thing_cells; /* places of 0.1 m with a thing */
  uint32_t blind_cells; /* in the way at top speed */
  uint32_t doubtful_cells;
  double floor_height_m; /* of the floor under base, in base */
  double floor_slope[2]; /* along x and y of base */
  /* measured motion that was reckoned with, given or of the odometry, and by how much it may err; NaN without */
  double speed_m_s, speed_error_m_s;
  double turn_rad_s, turn_error_rad_s;

  uint32_t settings_crc32; /* pose_wall_planar_stop_settings_crc() of the config and settings that decided */
  uint32_t mark; /* set by the library: shows pose_wall_planar_stop_image_fill that a stop wrote this result */
} pose_wall_planar_stop_result;

typedef struct pose_wall_planar_stop pose_wall_planar_stop;

/* Bytes of the block, whatever the settings. Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_memory_needed(uint64_t* bytes);
/* Bytes that are enough, for static arrays. Of this version: a later one may need more, and then refuses the block. */
#define POSE_WALL_PLANAR_STOP_BLOCK_MOST 3145728 /* 3 MiB */

/* Places a stop in block, which may hold anything, stays the caller's and must not move. settings may be NULL:
 * defaults. Fails iff: config or stop or block NULL, config or settings not initialised, POSE_WALL_E_CONFIG_RULE,
 * POSE_WALL_E_VALUE_RANGE, POSE_WALL_E_BLOCK_SMALL, POSE_WALL_E_BLOCK_ALIGN. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_open(const pose_wall_config* config,
                                                     const pose_wall_planar_stop_settings* settings, void* block,
                                                     uint64_t block_bytes, pose_wall_planar_stop** stop);

/* Forgets all, as if just opened. Fails iff: NULL, not open (POSE_WALL_E_ENGINE), POSE_WALL_E_BUSY. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_reset(pose_wall_planar_stop* stop);

/* Someone has looked: within confirm_m of the footprint nothing lies lower than tall_m or hangs. Known things stay.
 * Fails as reset does. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_confirm(pose_wall_planar_stop* stop);

/* Where an odometry saw base at the stamp of a frame: as pose_wall_motion_give fills it for that frame. The frame may
 * be the next one, or one of the last 31 that were processed: an odometry that comes late is not waited for. From it
 * the stop has the way of what it remembers, so that errors of the speed do not add up, and the measured motion.
 * Odometries of other stamps, of frames before one that had an odometry, and of infinite levels have no effect. Fails
 * as reset does and iff: odometry NULL, POSE_WALL_E_INPUT (run 0, a place that is not finite, no unit quaternion, a
 * negative level). */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_note_odometry(pose_wall_planar_stop* stop,
                                                              const pose_wall_odometry* odometry, int64_t stamp_ns);

/* One frame in, one result out. now_ns is of the clock of the stamps: see CLOCK. motion may be NULL: nothing is given.
 * Fails as pose_wall_cloud_check does and iff: stop, cloud or result NULL, a struct_size, an unknown bit in given, not
 * open, busy. All is then unchanged; treat it as a stop. Cost: planar_stop.md has it. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_process(pose_wall_planar_stop* stop, const pose_wall_cloud* cloud,
                                                        const pose_wall_planar_stop_motion* motion, int64_t now_ns,
                                                        pose_wall_planar_stop_result* result);

/* The result for a moment without a frame. It is that of the last frame, until this is older than stale_s or the clock
 * goes back or stands: then stop. Fails iff: NULL, struct_size, not open, busy. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_tick(pose_wall_planar_stop* stop, int64_t now_ns,
                                                     pose_wall_planar_stop_result* result);

/* ---------------------------------------------------------------------------------------------- process image */

/* One answer for a controller, in 13 words, 26 Modbus registers. The rules of the process images of pose_wall.h hold
 * (NUMBERS, BYTES, CRC, VERSION there), with the CRC-32C of image 2. Its version continues theirs, so words 0 and 1
 * identify every image. FB_PoseWallStop reads it.
 *
 * HEARTBEAT  is the result's. A controller permits driving only while it goes on by small steps. It never counts one
 *            that lies behind another that was seen, since old images would look the same. So a program that is started
 *            again sets result.heartbeat to a count that went on meanwhile: 100 times the seconds of a clock that
 *            nobody sets back, and from there one more with every answer. Else a person must confirm the restart at
 *            the controller.
 * CLOCK      now_ns of the calls. A controller compares its own clock with answered_ms, and so finds images that waited
 *            on their way. A clock that is set back costs a new start of the block.
 * OLD        results stay old: filled again, they have the same heartbeat.
 * WORSE      you may make a result worse before you fill the image: state, allowed_speed_m_s, reasons, heartbeat. */
#define POSE_WALL_PLANAR_STOP_IMAGE_VERSION 4

/* From here on written by tools/apps/plc/generate.py from tools/apps/plc/image.def. */

#define POSE_WALL_PLANAR_STOP_IMAGE_BYTES 52

/* One answer of the obstacle stop for a controller. 52 bytes. */
typedef struct pose_wall_planar_stop_image {
  uint32_t struct_size;       /* bytes: POSE_WALL_PLANAR_STOP_IMAGE_BYTES */
  uint32_t version;           /* POSE_WALL_PLANAR_STOP_IMAGE_VERSION */
  uint32_t crc32c;            /* CRC-32C of every byte but its own four */
  uint32_t heartbeat;         /* one more with every answer, of a frame or of silence; after 4294967295 comes 0 */
  uint32_t settings_crc32;    /* pose_wall_planar_stop_settings_crc() of config and settings */
  uint32_t library_version;   /* major * 65536 + minor * 256 + patch */
  uint32_t stamp_low;         /* the last frame's stamp_ns, bits 0 to 31 */
  uint32_t stamp_high;        /* and bits 32 to 63 */
  uint32_t state;             /* pose_wall_planar_stop_state: 0 stop, 1 slow, 2 go */
  int32_t allowed_speed_mm_s; /* mm/s: of the machine's fastest point, rounded down; 0 exactly if it must stop */
  uint32_t reasons;           /* pose_wall_planar_stop_reason */
  uint32_t age_ms;            /* ms: of the last frame at this answer, rounded up; 4294967295: not known, or none yet */
  uint32_t answered_ms;       /* ms: when this answer was given, by the clock of now_ns; after 4294967295 comes 0 */
} pose_wall_planar_stop_image;

/* Up to here. */

/* The number by which a controller knows the settings: over the config and the used members of settings, which may be
 * NULL: defaults. Fails iff: config or crc NULL, config or settings not initialised. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_settings_crc(const pose_wall_config* config,
                                                             const pose_wall_planar_stop_settings* settings,
                                                             uint32_t* crc);

/* Writes the image of a result, of any stop. Set image->struct_size = sizeof *image first. A state that is none, and a
 * speed that is no number or below 1 mm/s, become a stop. Fails iff: NULL, a struct_size, a result that no stop made
 * (POSE_WALL_E_RESULT). The image is then unchanged: show the controller nothing new. From any thread. Cost: some
 * hundred simple operations. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_image_fill(const pose_wall_planar_stop_result* result,
                                                           pose_wall_planar_stop_image* image);

/* POSE_WALL_OK for an image as pose_wall_planar_stop_image_fill left it. Fails iff: NULL, POSE_WALL_E_IMAGE_VERSION,
 * POSE_WALL_E_IMAGE_CRC. */
POSE_WALL_CHECKED int32_t pose_wall_planar_stop_image_check(const pose_wall_planar_stop_image* image);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_STOP_H */

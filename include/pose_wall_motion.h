/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * pose_wall_motion: how the machine moves along its roadway, from the same LiDAR frames.
 *
 * Per frame it gives the pose of base, the travel along the road, and for each of six directions a standard deviation
 * and a protection level. Along a road most odometries stand still or slip without a warning. This one reads the
 * relief of the rock, and gives a state along the road: measured, ambiguous, unobservable or lost.
 *
 *     pose_wall_motion_settings settings;
 *     pose_wall_motion_settings_init(&settings);
 *     uint64_t bytes = pose_wall_motion_memory_needed();
 *     pose_wall_motion *motion;
 *     pose_wall_motion_open(&config, &settings, block, bytes, &motion);
 *     result.struct_size = sizeof result;
 *     for every frame: pose_wall_motion_process(motion, &cloud, &result);
 *     with an engine:  pose_wall_motion_process_both(motion, engine, &cloud, &result, &engine_result);
 *
 * Check the status that each call returns; this sketch leaves it out.
 *
 * FRAMES    base as in pose_wall.h. start: base as it stood at the first frame; poses are in it. Pose: a point p of
 *           base lies at R p + position in start, with R of the quaternion. road: the axis along which the road gives
 *           least hold, horizontal in the main; along is positive where forward_axis points at the first frame.
 * TIME      a pose is that of the frame's stamp_ns. Where the cloud has a time field, each point is taken to be
 *           measured so long after it, and the machine's motion is taken out of the scan.
 * UNITS     metres, radians, seconds, nanoseconds (stamps). NaN where there is no number.
 * MEMORY    only the caller's block, and less than 32 kB of stack. No call allocates, blocks, prints, reads a clock or
 *           throws.
 * FLIPPED   the block has no sum, unlike the engine's: a bit that flips in it may give a wrong pose or end the
 *           process. What the engine takes from motion it judges by its own floor and walls. Run motion in a process of
 *           its own where that is not enough.
 * THREADS   one motion belongs to one thread at a time; different ones are independent.
 * STRUCTS   begin with struct_size and grow at their end only, as in pose_wall.h.
 * FLOATS    IEEE 754 without fast-math; the same version and input give the same bits on x86-64 and AArch64.
 * LINKING   libpose_wall_motion.a needs libpose_wall.a behind it, and -lm: `pkg-config --libs pose_wall_motion`, or
 *           -lpose_wall_motion -lpose_wall -lm.
 *
 * METHOD    the stages of Shan and Englot, LeGO-LOAM, IROS 2018: range image, ground, clusters, features, and two
 *           steps of Levenberg-Marquardt. The first step finds roll, pitch and height, the second yaw and the position
 *           across. These tell nothing about the way along the road. There, heights of the rock above its own planes
 *           are matched with a map of them, and planes that face along where there are some.
 */
/* clang-format on */

#ifndef POSE_WALL_MOTION_H
#define POSE_WALL_MOTION_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Raised when a struct or function of this header changes incompatibly. */
#define POSE_WALL_MOTION_ABI_VERSION 1
/* POSE_WALL_MOTION_ABI_VERSION of the library that is linked. */
uint32_t pose_wall_motion_abi_version(void);

/* ---------------------------------------------------------------------------------------------- settings */

/* Settings that the engine's config does not hold. In pose_wall.yaml they are the keys motion_speed_max, _turn_max_deg
 * (in degrees there), _range_max and _keyframe. The command reads these; pose_wall_config_set does not know them.
 * Extrinsic, forward_axis, range_min, body boxes and integrity_risk come from the engine's config. */
typedef struct pose_wall_motion_settings {
  uint32_t struct_size; /* set by pose_wall_motion_settings_init */
  uint32_t reserved;    /* 0 */
  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_motion_settings.def"
} pose_wall_motion_settings;

/* 2 m/s, a quarter turn a second, 30 m, 0.2 m. Fails iff: NULL. */
int32_t pose_wall_motion_settings_init(pose_wall_motion_settings* settings);

/* A fault of the settings: the member's name and its range, static storage. */
typedef struct pose_wall_motion_fault {
  const char* member;
  const char* rule; /* "speed_max_m_s must be from 0.01 to 30" */
} pose_wall_motion_fault;
/* Fails iff: settings NULL, not initialised (POSE_WALL_E_STRUCT_SIZE), POSE_WALL_E_VALUE_RANGE (*fault is written then,
 * unless fault is NULL). */
POSE_WALL_CHECKED int32_t pose_wall_motion_settings_check(const pose_wall_motion_settings* settings,
                                                          pose_wall_motion_fault* fault);

/* ---------------------------------------------------------------------------------------------- result */

/* State of the travel along the road in this frame. */
enum pose_wall_along_state {
  POSE_WALL_ALONG_LOST = 0,         /* no pose: the scan fits the map nowhere, and the map begins anew with it; or the
                                       frame shows nothing (few_points, repeated), and the map stays */
  POSE_WALL_ALONG_UNOBSERVABLE = 1, /* no feature shows the travel along the road: dead reckoning by the last measured
                                       or given speed, and the level grows by the top speed */
  POSE_WALL_ALONG_AMBIGUOUS = 2, /* two places fit alike, as with periodic steel sets. The pose is the place nearer to
                                    the expected one, and the level covers both */
  POSE_WALL_ALONG_MEASURED = 3
};
/* "measured"; static storage. */
const char* pose_wall_motion_along_state_name(uint32_t state);

/* Why, in bits; pinned by a test. */
enum pose_wall_motion_reason {
  POSE_WALL_MOTION_R_FIRST = 1 << 0,         /* the map begins with this frame */
  POSE_WALL_MOTION_R_FEW_POINTS = 1 << 1,    /* too few points with a surface around them */
  POSE_WALL_MOTION_R_FEW_MATCHES = 1 << 2,   /* too few of them lie on the map */
  POSE_WALL_MOTION_R_SMOOTH = 1 << 3,        /* the relief does not distinguish a place from its neighbours */
  POSE_WALL_MOTION_R_FEW_PATCHES = 1 << 4,   /* too few patches of rock determine the place: one person, one prop */
  POSE_WALL_MOTION_R_HALVES_DIFFER = 1 << 5, /* two halves of the rock fit different places */
  POSE_WALL_MOTION_R_SECOND_PEAK = 1 << 6,   /* another place fits nearly as well */
  POSE_WALL_MOTION_R_AT_EDGE = 1 << 7,       /* the best place lies further off than the machine can have moved */
  POSE_WALL_MOTION_R_NO_GROUND = 1 << 8,     /* roll, pitch and height come from walls and roof alone */
  POSE_WALL_MOTION_R_STAMP = 1 << 9,  /* the stamp stood still or went back: the frame is not used, its pose is the last
                                         one. The second stamp in a row that went back is accepted */
  POSE_WALL_MOTION_R_GAP = 1 << 10,   /* frames are missing before this one: a wide search found it */
  POSE_WALL_MOTION_R_PRIOR = 1 << 11, /* the frame's inputs contradict what was measured, and were not used */
  POSE_WALL_MOTION_R_MAP_FULL = 1 << 12, /* the oldest part of the map gave way to the newest */
  POSE_WALL_MOTION_R_REPEATED = 1 << 13  /* the cloud, or 10 degrees of it and more, came before: sensor or driver hang.
                                            The frame is lost and not used; the map stays */
};
#define POSE_WALL_MOTION_REASON_COUNT 14
/* "halves_differ", and one English sentence; static storage. */
const char* pose_wall_motion_reason_name(uint32_t bit_index);
const char* pose_wall_motion_reason_text(uint32_t bit_index);

/* Directions of sigma and protection_level: in the road, about the axes of start. */
enum pose_wall_motion_direction {
  POSE_WALL_MOTION_ALONG = 0,
  POSE_WALL_MOTION_ACROSS = 1,
  POSE_WALL_MOTION_UP = 2,
  POSE_WALL_MOTION_ROLL = 3,
  POSE_WALL_MOTION_PITCH = 4,
  POSE_WALL_MOTION_YAW = 5,
  POSE_WALL_MOTION_DIRECTIONS = 6
};
/* "along"; static storage. */
const char* pose_wall_motion_direction_name(uint32_t direction);

typedef struct pose_wall_motion_result {
  uint32_t struct_size; /* set by the caller to sizeof(pose_wall_motion_result) before the call */
  uint32_t along_state; /* pose_wall_along_state */
  uint32_t reasons;     /* pose_wall_motion_reason bits */
  uint32_t mark;        /* set by the library: shows pose_wall_motion_image_fill that a motion wrote this result */
  int64_t stamp_ns;     /* the frame's */
  uint64_t frame_index; /* counts processed frames from 0 */

  /* the pose of base in start; NaN while lost */
  double position_m[3];
  double quaternion[4]; /* x, y, z, w; unit, w >= 0 */
  /* of that pose, accumulated since the first frame. |pose - truth| stays within protection_level */
  double sigma[POSE_WALL_MOTION_DIRECTIONS];
  double protection_level[POSE_WALL_MOTION_DIRECTIONS]; /* infinite while lost */
  double road_axis[3]; /* unit, in start: the direction that along means in this frame */
  double along_m;      /* travel along the road since the first frame, backwards subtracts; NaN while lost */

  /* step from the last frame with a pose to this one, in base of that frame; NaN in the first frame and while lost */
  double step_m[3];
  double step_rad[3]; /* rotation vector */
  double step_s;
  double step_sigma[POSE_WALL_MOTION_DIRECTIONS];
  double step_protection_level[POSE_WALL_MOTION_DIRECTIONS];

  /* evidence for the travel along the road; NaN without a search */
  double contrast;    /* how much worse other places fit: (median - best) / best of the search curve */
  double patches;     /* how many patches of rock agree: their mean gain over its own standard error */
  double halves_m;    /* by how much two halves of the rock differ */
  double second_m;    /* where the second best place lies from the best */
  double second_gain; /* its share of the best one's gain, 0 to 1 */

  uint32_t points_in;
  uint32_t points_used;   /* in the range image */
  uint32_t ground_points; /* marked as ground */
  uint32_t clusters;      /* of 30 points or more */
  uint32_t edge_points;
  uint32_t plane_points;
  uint32_t matched; /* plane points on the map's surfaces */
  uint32_t tiles;   /* square metres of surface in the map */
  uint32_t keyframes;
  uint32_t wide_start; /* 1: the frame was searched without a starting guess */

  uint64_t run;          /* poses of one run are comparable: another number after each new start; 0 while lost */
  uint32_t config_crc32; /* pose_wall_config_crc() of the config that the motion was opened with */
  uint32_t source_id;    /* of that config */
} pose_wall_motion_result;

/* ---------------------------------------------------------------------------------------------- motion */

typedef struct pose_wall_motion pose_wall_motion;

/* Bytes of the block, the same for all settings. It cannot fail, so it gives them itself. */
uint64_t pose_wall_motion_memory_needed(void);
/* Bytes that are enough, for static arrays. Of this version: a later one may need more, and then refuses the block. */
#define POSE_WALL_MOTION_BLOCK_MOST 6291456 /* 6 MiB */

/* Places a motion in block, which may hold anything, stays the caller's and must not move. settings may be NULL:
 * defaults. Fails iff: config or motion or block NULL, config or settings not initialised (POSE_WALL_E_STRUCT_SIZE),
 * POSE_WALL_E_CONFIG_RULE, POSE_WALL_E_VALUE_RANGE, POSE_WALL_E_BLOCK_SMALL, POSE_WALL_E_BLOCK_ALIGN. */
POSE_WALL_CHECKED int32_t pose_wall_motion_open(const pose_wall_config* config,
                                                const pose_wall_motion_settings* settings, void* block,
                                                uint64_t block_bytes, pose_wall_motion** motion);

/* Forgets map and pose, as if just opened. Fails iff: NULL, not open (POSE_WALL_E_ENGINE). */
POSE_WALL_CHECKED int32_t pose_wall_motion_reset(pose_wall_motion* motion);

/* One frame in, one result out. Set result->struct_size first. The motion uses the cloud's time and ring fields if
 * present, and of its inputs the speed, the turn rate and standing. Fails as pose_wall_process does, with the result
 * unchanged. Cost: reading the cloud plus a bounded part. However long no frame came, the wide search for the
 * scan takes at most 5 million steps of 11 to 14 instructions. The whole frame takes some three ordinary ones at most:
 * measured with 64 rings of 1024 points. */
POSE_WALL_CHECKED int32_t pose_wall_motion_process(pose_wall_motion* motion, const pose_wall_cloud* cloud,
                                                   pose_wall_motion_result* result);

/* The last frame's pose in the form that the engine takes. Sets POSE_WALL_INPUT_ODOMETRY and inputs->odometry; the rest
 * is unchanged. Where that frame has no pose, nothing is known of its place, and its motion within the scan only by the
 * machine's limits. Before the first frame clears the bit. Set inputs->struct_size = sizeof *inputs first. The run's
 * frame is that of the map. Fails iff: NULL, not open, struct_size. */
POSE_WALL_CHECKED int32_t pose_wall_motion_give(const pose_wall_motion* motion, pose_wall_inputs* inputs);

/* Both libraries for one frame. Calls pose_wall_motion_process, then pose_wall_process with the frame's inputs. This
 * pose replaces an odometry of the caller's. So the engine's held values move with the machine, its measured ones know
 * the road behind, and the scan's motion is removed from a cloud with times. Give every frame to both. Fails as either
 * does. If the motion refuses a frame, the engine does not see it. A damaged or busy engine refuses after the motion
 * has taken the frame: then continue with the next one. */
POSE_WALL_CHECKED int32_t pose_wall_motion_process_both(pose_wall_motion* motion, pose_wall_engine* engine,
                                                        const pose_wall_cloud* cloud,
                                                        pose_wall_motion_result* motion_result,
                                                        pose_wall_result* result);

/* The result for a moment without a frame: no pose (NaN, levels infinite, lost). Of the last frame it has stamp_ns and
 * frame_index (before the first: 2^64 - 1), nothing else. Set result->struct_size first. The motion is unchanged. Fails
 * iff: NULL, not open, struct_size. */
POSE_WALL_CHECKED int32_t pose_wall_motion_blank(const pose_wall_motion* motion, pose_wall_motion_result* result);

/* ---------------------------------------------------------------------------------------------- process image */

/* One frame's motion for a controller, in 33 words. The rules of the process images of pose_wall.h hold (NUMBERS,
 * BYTES, CRC, SEQUENCE, VERSION there), with the CRC-32C of image 2. Where there is no pose, or the frame before had
 * none, values are POSE_WALL_IMAGE_NO_VALUE and levels POSE_WALL_IMAGE_NO_BOUND. Its version continues theirs, so words
 * 0 and 1 identify every image. */
#define POSE_WALL_MOTION_IMAGE_VERSION 3

/* From here on written by tools/apps/plc/generate.py from tools/apps/plc/image.def. */

#define POSE_WALL_MOTION_IMAGE_BYTES 132

/* One frame's motion for a controller. 132 bytes. */
typedef struct pose_wall_motion_image {
  uint32_t struct_size;           /* bytes: POSE_WALL_MOTION_IMAGE_BYTES */
  uint32_t version;               /* POSE_WALL_MOTION_IMAGE_VERSION */
  uint32_t crc32c;                /* CRC-32C of every byte but its own four */
  uint32_t sequence;              /* frames since the motion was opened or reset: 0 before the first */
  uint32_t publication;           /* changes with every publication, of a frame or of silence */
  uint32_t run;                   /* changes where the map begins anew: places before it do not compare; 0: no pose */
  uint32_t config_crc32;          /* pose_wall_config_crc() of the motion's config */
  uint32_t library_version;       /* major * 65536 + minor * 256 + patch */
  uint32_t stamp_low;             /* the frame's stamp_ns, bits 0 to 31 */
  uint32_t stamp_high;            /* and bits 32 to 63 */
  uint32_t source_id;             /* which sensor or engine of several, of the config */
  uint32_t latency_ms;            /* ms: from reception to publication, rounded up; 4294967295: not known */
  uint32_t thinning;              /* of every so many returns one was used; 0: not known */
  uint32_t told_by;               /* 1: a frame, 2: silence, 0: not known */
  uint32_t along_state;           /* pose_wall_along_state; 0 without a pose */
  uint32_t reasons;               /* pose_wall_motion_reason */
  int32_t travel_mm;              /* mm: along the road since the first frame; backwards subtracts */
  int32_t travel_protection_mm;   /* mm: protection level of travel and of the position along the road, rounded up */
  int32_t x_mm;                   /* mm: position of base, in base as it stood at the first frame */
  int32_t y_mm;                   /* mm: likewise */
  int32_t z_mm;                   /* mm: likewise */
  int32_t across_protection_mm;   /* mm: of the position across the road, rounded up */
  int32_t up_protection_mm;       /* mm: of its height, rounded up */
  int32_t roll_mdeg;              /* 0.001 deg: of base since the first frame: turned by yaw, pitch, roll in turn */
  int32_t pitch_mdeg;             /* 0.001 deg: likewise */
  int32_t yaw_mdeg;               /* 0.001 deg: likewise; right-handed as the others: positive to the left */
  int32_t roll_protection_mdeg;   /* 0.001 deg: rounded up */
  int32_t pitch_protection_mdeg;  /* 0.001 deg: rounded up */
  int32_t yaw_protection_mdeg;    /* 0.001 deg: rounded up */
  int32_t speed_mm_s;             /* mm/s: along the road, since the frame before; backwards negative */
  int32_t speed_protection_mm_s;  /* mm/s: rounded up */
  int32_t turn_mdeg_s;            /* 0.001 deg/s: about the first frame's z; positive to the left */
  int32_t turn_protection_mdeg_s; /* 0.001 deg/s: rounded up */
} pose_wall_motion_image;

/* Up to here. */

/* Writes the image of a result, of any motion. Set image->struct_size = sizeof *image first. source as in
 * pose_wall_image2_fill (held_thinning is not in this image). If source is NULL, its members are unknown and
 * publication equals sequence. Fails iff: result or image NULL, a struct_size of another version, a result that no
 * motion made (POSE_WALL_E_RESULT). The image is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_motion_image_fill(const pose_wall_motion_result* result,
                                                      const pose_wall_image_source* source,
                                                      pose_wall_motion_image* image);

/* POSE_WALL_OK for an image as pose_wall_motion_image_fill left it. Fails iff: NULL, POSE_WALL_E_IMAGE_VERSION,
 * POSE_WALL_E_IMAGE_CRC. */
POSE_WALL_CHECKED int32_t pose_wall_motion_image_check(const pose_wall_motion_image* image);

/* The map's surface points, in start, for pictures. Writes up to `capacity` of them as x, y, z, beginning with number
 * first, and gives their total. Fails iff: motion or total NULL, xyz_m NULL with capacity > 0, not open. */
POSE_WALL_CHECKED int32_t pose_wall_motion_map(const pose_wall_motion* motion, uint32_t first, float* xyz_m,
                                               uint32_t capacity, uint32_t* total);

/* ---------------------------------------------------------------------------------------------- for a runtime */

/* The functions above, for a program that runs a motion without linking it: pose_wall_runtime_options.motion. */
typedef struct pose_wall_motion_functions {
  uint32_t struct_size;
  uint32_t abi_version; /* POSE_WALL_MOTION_ABI_VERSION */
  int32_t (*settings_check)(const pose_wall_motion_settings* settings, pose_wall_motion_fault* fault);
  uint64_t (*memory_needed)(void);
  int32_t (*open)(const pose_wall_config* config, const pose_wall_motion_settings* settings, void* block,
                  uint64_t block_bytes, pose_wall_motion** motion);
  int32_t (*reset)(pose_wall_motion* motion);
  int32_t (*process)(pose_wall_motion* motion, const pose_wall_cloud* cloud, pose_wall_motion_result* result);
  int32_t (*give)(const pose_wall_motion* motion, pose_wall_inputs* inputs);
  int32_t (*blank)(const pose_wall_motion* motion, pose_wall_motion_result* result);
  int32_t (*image_fill)(const pose_wall_motion_result* result, const pose_wall_image_source* source,
                        pose_wall_motion_image* image);
} pose_wall_motion_functions;

/* Static storage. */
const pose_wall_motion_functions* pose_wall_motion_functions_get(void);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_MOTION_H */

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * pose_wall: the attitude and position of a tunnelling machine in its roadway, from one 3D LiDAR.
 *
 * The engine gives seven quantities per frame. Roll and pitch come from the floor, yaw from the side walls. Four
 * distances lead from two points of the machine's centre line (s_front ahead, s_back behind) to the left and the
 * right wall. Each quantity carries its own standard deviation, protection level, state, reasons and age.
 *
 *     Check the status that every call returns; this sketch leaves it out.
 *
 *     pose_wall_config config;
 *     pose_wall_config_init(&config);                        defaults of every key
 *     pose_wall_config_set(&config, "forward_axis", "+X");   as in pose_wall.yaml
 *     uint64_t bytes;
 *     pose_wall_memory_needed(&config, &bytes);              a block of this size, aligned to
 *                                                            POSE_WALL_BLOCK_ALIGNMENT, is all the memory there is
 *     pose_wall_engine *engine;
 *     pose_wall_open(&config, block, bytes, &engine);
 *     for every frame: pose_wall_process(engine, &cloud, &result);
 *                                                            nothing to close: free the block
 *
 * FRAMES   lidar: as the sensor delivers. base: lidar moved by the extrinsic of the config, +Z up. All results are in
 *          base or in the levelled frame. levelled (_level): same origin as base, turned by R_level = Ry(pitch) *
 *          Rx(roll), which takes the floor's normal to +Z.
 * SIGNS    roll = atan2(n_y, n_z), pitch = atan2(-n_x, sqrt(n_y^2 + n_z^2)) with n the floor's upward normal in base.
 *          Both are about base X and Y, whatever forward_axis is. yaw is the angle about +Z from the machine's forward
 *          axis to the road: a machine turned LEFT by 5 degrees reports yaw = -5 degrees. In words, with forward +X:
 *          roll > 0 is right side down, pitch > 0 is nose down. With -X both change sign for the driver. With +Y or -Y
 *          the driver's pitch is roll, and the driver's roll is pitch. Distances are >= 0. AXES.md of the package
 *          compares the axes and signs of all libraries.
 * REGIONS  floor and walls are those beside the machine: the plane, by one formula, of what is really there from
 *          floor_region_min to floor_region_max ahead and behind on the floor, and within 2.5 m along the walls.
 *          DEFINITIONS.md of the package has regions and formula. Where too little of that is seen, a value is of all
 *          floor or wall in view (the extents of its plane tell), and its level holds how the rock may differ. With the
 *          key region: off, values are of those endless planes.
 * UNITS    metres, radians, nanoseconds (stamps), seconds (ages). NaN where there is no number.
 * MEMORY   only the caller's block, and less than 32 kB of stack. No call allocates, blocks, prints, reads a clock or
 *          throws.
 * THREADS  one engine belongs to one thread at a time; different engines are independent. A call that finds another
 *          one inside its engine is refused (POSE_WALL_E_BUSY). There are no globals.
 * STRUCTS  every struct that begins with struct_size grows at its end only. A library takes structs of any earlier
 *          header of its ABI: it reads missing members as zero and writes no further than struct_size. It refuses
 *          structs of a later header (POSE_WALL_E_STRUCT_NEWER).
 * TIME     every loop over live data has a cap from the config. A frame that has taken work_max steps stops at its
 *          next check of the budget, at most a million steps later. Unfinished results are refused
 *          (POSE_WALL_R_WORK_LIMIT). Reading the cloud is never stopped.
 * ERRORS   every call that can fail returns a status: POSE_WALL_OK (0) or a negative pose_wall_status. A refused call
 *          changes nothing. A status reports a wrong call. A frame that could not be measured is no error: the call
 *          returns POSE_WALL_OK, and the result's states and reasons say so.
 * FLOATS   IEEE 754 without fast-math. The same version and input give the same bits on x86-64, AArch64 and ARMv7, by
 *          GCC and Clang, whatever the block held before.
 */
/* clang-format on */

#ifndef POSE_WALL_H
#define POSE_WALL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------------------------------------- versions */

#define POSE_WALL_VERSION_MAJOR 0
#define POSE_WALL_VERSION_MINOR 2
#define POSE_WALL_VERSION_PATCH 0

/* Raised when a struct or function of this header changes incompatibly. */
#define POSE_WALL_ABI_VERSION 2

/* Marks calls that can fail while a program runs. Compilers that can do so warn when the status is ignored. To ignore
 * it on purpose, write (void) in C++ and assign it in C. */
#if defined(__cplusplus)
#if __cplusplus >= 201703L
#define POSE_WALL_CHECKED [[nodiscard]]
#endif
#elif defined(__GNUC__)
#define POSE_WALL_CHECKED __attribute__((warn_unused_result))
#endif
#ifndef POSE_WALL_CHECKED
#define POSE_WALL_CHECKED
#endif

/* "0.2.0"; static storage. */
const char* pose_wall_version(void);
/* POSE_WALL_ABI_VERSION of the library that is linked; compare it with the header's. */
uint32_t pose_wall_abi_version(void);

/* ---------------------------------------------------------------------------------------------- status */

/* Numbers are pinned by a test and never reused. No two libraries share one: -1 to -89 stand here, -90 to -99 in
 * pose_wall_box.h, -100 to -119 in pose_wall_runtime.h, -120 to -139 in pose_wall_planar_types.h. */
enum pose_wall_status {
  POSE_WALL_OK = 0,

  /* wrong calls */
  POSE_WALL_E_NULL = -1,        /* a required pointer is NULL */
  POSE_WALL_E_STRUCT_SIZE = -2, /* struct_size unknown: set it to sizeof, or call the init function */
  POSE_WALL_E_BLOCK_SMALL = -3, /* block smaller than pose_wall_memory_needed() says */
  POSE_WALL_E_BLOCK_ALIGN = -4, /* block not aligned to POSE_WALL_BLOCK_ALIGNMENT */
  POSE_WALL_E_ENGINE = -5, /* engine pointer does not point to an open engine, or its block was changed from outside:
                              see pose_wall_open */
  POSE_WALL_E_INDEX = -6,  /* index out of range */
  POSE_WALL_E_BUFFER_SMALL = -7,  /* text or memento does not fit the caller's buffer */
  POSE_WALL_E_MEMENTO = -8,       /* not what pose_wall_save wrote, of another version or config, cut off or damaged */
  POSE_WALL_E_BUSY = -9,          /* another call is inside this engine, or inside the engine in this block */
  POSE_WALL_E_ABI = -10,          /* the program was built against the header of ABI 1: build it anew */
  POSE_WALL_E_STRUCT_NEWER = -11, /* a struct of a newer header than the library that is linked */
  POSE_WALL_E_INPUT = -12,        /* an unknown bit in pose_wall_inputs or pose_wall_moment, or a boot_id of zeros */

  /* configuration */
  POSE_WALL_E_KEY_UNKNOWN = -20, /* no such key */
  POSE_WALL_E_VALUE_TYPE = -21,  /* value cannot be read as the key's type, or is not one of its choices. The texts
                                    "nan" and "inf" are no numbers; 2.5 is no integer; the function is for keys of
                                    another type */
  POSE_WALL_E_VALUE_RANGE = -22, /* value outside the key's range, or not finite: a double that is NaN or infinite, a
                                    text beyond any double ("1e999"); of a box also where a minimum is not below its
                                    maximum */
  POSE_WALL_E_CONFIG_RULE = -23, /* two keys contradict each other, or a member of the config was written past the
                                    functions and holds a number out of its key's range (NaN, too), no choice, or a
                                    text without an end; see pose_wall_config_check() */
  POSE_WALL_E_TEXT_LONG = -24,   /* text value longer than POSE_WALL_TEXT_MAX - 1 */

  /* clouds */
  POSE_WALL_E_CLOUD_FIELD = -40, /* x, y or z missing, or a field of an unknown type */
  POSE_WALL_E_CLOUD_STEP = -41,  /* a field reaches past point_step, or a row past row_step */
  POSE_WALL_E_CLOUD_SIZE = -42,  /* data_bytes does not hold width x height points, or those are more than 2^26 */

  /* process images */
  POSE_WALL_E_IMAGE_VERSION = -60, /* an image of another version or size */
  POSE_WALL_E_IMAGE_CRC = -61,     /* the CRC does not fit the bytes: damaged, torn or never filled */
  POSE_WALL_E_RESULT = -62,        /* not a result of an engine: blank, or its head was changed */

  /* self test */
  POSE_WALL_E_SELF_TEST = -80 /* the engine's results are not the noted ones: the report has the differences */
};

/* One English sentence for a status of any library, static storage; "unknown status" for anything else. */
const char* pose_wall_status_text(int32_t status);

/* ---------------------------------------------------------------------------------------------- config */

#define POSE_WALL_TEXT_MAX 64
#define POSE_WALL_CONFIG_NUMBERS 160
#define POSE_WALL_CONFIG_TEXTS 3

/* All settings. Treat the members as private and write through the functions below. They know every key's name, type,
 * unit and range from one table (pose_wall_config_key). Copy it freely. */
typedef struct pose_wall_config {
  uint32_t struct_size; /* set by pose_wall_config_init */
  uint32_t layout;      /* set by pose_wall_config_init: identifies the table of keys */
  double number[POSE_WALL_CONFIG_NUMBERS];
  char text[POSE_WALL_CONFIG_TEXTS][POSE_WALL_TEXT_MAX];
} pose_wall_config;

enum pose_wall_key_type {
  POSE_WALL_KEY_NUMBER = 1,  /* one decimal number */
  POSE_WALL_KEY_INTEGER = 2, /* one whole number */
  POSE_WALL_KEY_CHOICE = 3,  /* one of `choices` (words separated by '|') */
  POSE_WALL_KEY_TEXT = 4,    /* up to POSE_WALL_TEXT_MAX - 1 bytes */
  POSE_WALL_KEY_BOX = 5      /* six numbers: x_min x_max y_min y_max z_min z_max; empty text or "[]": no box */
};

/* A key's row of the table. All pointers are static storage. */
typedef struct pose_wall_key_info {
  const char* name;
  const char* unit;         /* "m", "rad", "deg", "s", "1", ... ; "" for texts and choices */
  const char* choices;      /* for POSE_WALL_KEY_CHOICE, else "" */
  const char* default_text; /* as it would be written in pose_wall.yaml */
  const char* group;        /* heading: "input", "frames", "filter", "ground", "walls", "quality", "temporal" */
  const char* help;         /* its meaning, and what a larger value buys and costs */
  double minimum;           /* inclusive; of each number of a box */
  double maximum;
  uint32_t type; /* pose_wall_key_type */
  uint32_t reserved;
} pose_wall_key_info;

/* Fills every key with its default. Fails iff: NULL. */
int32_t pose_wall_config_init_2(pose_wall_config* config);
/* The name that programs built against ABI 1 call: writes nothing and always returns POSE_WALL_E_ABI. */
int32_t pose_wall_config_init(pose_wall_config* config);
#define pose_wall_config_init pose_wall_config_init_2

/* Sets a key from text, as in pose_wall.yaml ("0.30", "+X", "-2.3 2.3 -0.6 0.6 -1.5 0.4"). Separate the numbers of a
 * box by spaces, one comma or both; a pair of brackets may enclose them. On failure the config is unchanged. Fails iff:
 * NULL, not initialised (POSE_WALL_E_STRUCT_SIZE), POSE_WALL_E_KEY_UNKNOWN, POSE_WALL_E_VALUE_TYPE,
 * POSE_WALL_E_VALUE_RANGE, POSE_WALL_E_TEXT_LONG. */
POSE_WALL_CHECKED int32_t pose_wall_config_set(pose_wall_config* config, const char* key, const char* value);

/* The same for a key of one number or integer. Fails iff: NULL, not initialised, key unknown, a key of another type or
 * a fraction for an integer (POSE_WALL_E_VALUE_TYPE), POSE_WALL_E_VALUE_RANGE. */
POSE_WALL_CHECKED int32_t pose_wall_config_set_number(pose_wall_config* config, const char* key, double value);

/* Reads a key of one number or integer. This call and the two below write on success only. They fail iff: NULL, not
 * initialised, key unknown, a key of another type (POSE_WALL_E_VALUE_TYPE). */
int32_t pose_wall_config_get_number(const pose_wall_config* config, const char* key, double* value);

/* Reads a box into value[6]. All zero: no box. */
int32_t pose_wall_config_get_box(const pose_wall_config* config, const char* key, double value[6]);

/* Reads a text or choice key into buffer, with its closing zero. Fails also iff it does not fit
 * (POSE_WALL_E_BUFFER_SMALL), or the config's member was written past the functions and is no choice
 * (POSE_WALL_E_VALUE_TYPE). */
int32_t pose_wall_config_get_text(const pose_wall_config* config, const char* key, char* buffer, uint64_t bytes);

/* The table, for help texts and checks: its number of rows, and a row by index in data-flow order. Another build may
 * have another order. Fails iff: NULL, POSE_WALL_E_INDEX. To find a key's row by its name, with unit and range:
 *
 *     pose_wall_key_info info;
 *     uint32_t i = 0;
 *     while (pose_wall_config_key(i, &info) == POSE_WALL_OK && strcmp(info.name, "range_max") != 0) ++i;
 *     if (i < pose_wall_config_key_count()) printf("%s: %g to %g\n", info.unit, info.minimum, info.maximum); */
uint32_t pose_wall_config_key_count(void);
int32_t pose_wall_config_key(uint32_t index, pose_wall_key_info* info);

/* A broken rule: either one over several keys, or a member that holds no value of its key. Static storage. */
typedef struct pose_wall_rule_fault {
  const char* key;
  const char* other_key; /* or "" */
  const char* rule;      /* "range_min must be smaller than range_max" */
} pose_wall_rule_fault;

/* Checks every member and the rules over several keys. Fails iff: config NULL, not initialised,
 * POSE_WALL_E_CONFIG_RULE. Only in the last case does it write the first fault to *fault (fault may be NULL).
 * pose_wall_memory_needed and pose_wall_open apply the same rules. */
POSE_WALL_CHECKED int32_t pose_wall_config_check(const pose_wall_config* config, pose_wall_rule_fault* fault);

/* CRC-32 of all settings. With it a controller checks that the engine runs with its approved settings. Two builds with
 * different tables of keys give different numbers for the same file. Fails iff: NULL, not initialised. */
int32_t pose_wall_config_crc(const pose_wall_config* config, uint32_t* crc);

/* ---------------------------------------------------------------------------------------------- clouds */

/* Numbers of sensor_msgs/PointField. */
enum pose_wall_field_type {
  POSE_WALL_FIELD_NONE = 0, /* field absent */
  POSE_WALL_FIELD_INT8 = 1,
  POSE_WALL_FIELD_UINT8 = 2,
  POSE_WALL_FIELD_INT16 = 3,
  POSE_WALL_FIELD_UINT16 = 4,
  POSE_WALL_FIELD_INT32 = 5,
  POSE_WALL_FIELD_UINT32 = 6,
  POSE_WALL_FIELD_FLOAT32 = 7,
  POSE_WALL_FIELD_FLOAT64 = 8
};

typedef struct pose_wall_field {
  uint32_t offset; /* bytes from the start of a point */
  uint32_t type;   /* pose_wall_field_type */
} pose_wall_field;

/* One frame, a sensor_msgs/PointCloud2 taken by reference: nothing is copied or kept after the call. Any field order,
 * any alignment, padding between points and rows, either byte order.
 *
 * Give every return of one scan as the sensor gave it, in the sensor's frame and in any order. Points without a return
 * may be left out, zero or not finite. The engine finds gaps in a wall by the missing returns, direction by direction.
 * A cloud that was cropped or merged from several sensors therefore looks full of holes, and its walls may be refused
 * (POSE_WALL_R_WALL_SEEN_THROUGH). Gaps may go UNNOTICED in a thinned cloud, or where the sensor has fewer than about
 * 600 returns a turn in each 2 degrees of elevation. To leave points out, use range_min, range_max and the body boxes.
 * Synthetic points must form a scan, too: rays at even angles, each to the first surface, with a roof where the walls
 * end. example.c of the package makes one. */
typedef struct pose_wall_cloud {
  uint32_t struct_size; /* sizeof(pose_wall_cloud) */
  uint32_t big_endian;  /* 0 or 1: byte order of the fields */
  const void* data;     /* may be NULL iff width x height is 0 */
  uint64_t data_bytes;
  uint32_t width;      /* points per row */
  uint32_t height;     /* rows */
  uint32_t point_step; /* bytes from point to point */
  uint32_t row_step;   /* bytes from row to row; 0: width x point_step */
  int64_t stamp_ns;    /* nanoseconds of any clock that only goes forward: ages, holding and smoothing use it */
  pose_wall_field x;   /* metres in the lidar frame; FLOAT32 or FLOAT64 */
  pose_wall_field y;
  pose_wall_field z;
  pose_wall_field intensity; /* any type; used only with intensity_weight > 0 */
  pose_wall_field time; /* when each point was measured, any type; read with an odometry, and by pose_wall_motion. In
                           the one of s, ms, us and ns by which the scan takes 0.01 to 1 s. Times from 0 to 1 s count
                           from stamp_ns, others from the smallest of the cloud */
  const struct pose_wall_inputs* inputs; /* the machine's own data of this frame, or NULL */
  pose_wall_field ring;                  /* which of the sensor's rings, any type, from 0. Read by pose_wall_motion */
} pose_wall_cloud;

/* Bits of pose_wall_inputs.given. */
enum pose_wall_input {
  POSE_WALL_INPUT_STANDING = 1,  /* the machine has not moved since the last frame. Its boom may have */
  POSE_WALL_INPUT_SPEED = 2,     /* speed_m_s and its sigma */
  POSE_WALL_INPUT_TURN_RATE = 4, /* turn_rate_rad_s and its sigma */
  POSE_WALL_INPUT_ODOMETRY = 8   /* odometry */
};
#define POSE_WALL_INPUT_BOXES 4

/* Directions of an odometry's levels, in the order of pose_wall_motion_direction: along the road, across it to the
 * left, up, in m; turns about these three, in rad. */
#define POSE_WALL_ODOMETRY_DIRECTIONS 6

/* The machine's pose at this frame's stamp, by an odometry that measures. pose_wall_motion_give fills it; the caller
 * may use an odometry of its own. The engine uses only the difference between two frames of one run. So an odometry may
 * drift and may have any origin. The error of such a difference stays within
 *     level (then) + level (now) + k sqrt(drift_variance (now) - (then)) + drift (now) - (then),
 * where k is the number of standard deviations that integrity_risk leaves beyond: 4.89 for 1e-6. */
typedef struct pose_wall_odometry {
  uint64_t run;               /* poses of one run are comparable; another number after each new start. Not 0 */
  double position_m[3];       /* of base, in the run's frame */
  double quaternion[4];       /* x, y, z, w: turns base into the run's frame; unit within 1e-5 */
  double along[3], across[3]; /* unit, in the run's frame, at right angles: the directions of the levels */
  double level[POSE_WALL_ODOMETRY_DIRECTIONS];          /* error of each frame by itself: m, rad; 0 to infinite */
  double drift_variance[POSE_WALL_ODOMETRY_DIRECTIONS]; /* accumulated since the run began: m2, rad2; never falls */
  double drift[POSE_WALL_ODOMETRY_DIRECTIONS]; /* likewise, the part that is no variance: m, rad; never falls */
  double velocity_m_s[3];                      /* in base, during this scan: removes the skew of a cloud with times;
                                                * without times the levels hold it */
  double turn_rate_rad_s[3];                   /* likewise */
  /* k standard deviations of these two: m/s, rad/s; 0 to infinite. The engine adds them to its levels as variances add
   * up. Of a hard bound say twice as much; what is small beside the cloud's noise needs more. */
  double rate_level[POSE_WALL_ODOMETRY_DIRECTIONS];
} pose_wall_odometry;

/* The machine's own data since the last frame. All of it is optional, and measurements win over all of it. The engine
 * does not use motion that contradicts itself or the measurements, motion out of range, or a box out of range. The
 * frame then has POSE_WALL_R_PRIOR; sound boxes are applied all the same. Without motion the levels of held values grow
 * by hold_rate_angle and hold_rate_distance. With it:
 * STANDING: no level grows (age_s still does).
 * TURN_RATE: a held yaw turns with it, and its level grows by k sigma (k as above). It does not affect roll and
 * pitch.
 * SPEED with TURN_RATE: the levels of distances grow no faster than the sampling points move, |speed| + reach x |turn
 * rate| and their sigmas, where that is less than hold_rate_distance. The direction of that motion is not used.
 * SPEED alone: no effect.
 * ODOMETRY: used instead of the others where the last frame had one of the same run. Held values then move with the
 * machine relative to the last measured floor and walls. Measured values are weighed with those of the way until then,
 * so their levels are no wider than that of the frame by itself, and often narrower. A jump that the motion explains
 * does not count as one. Held levels grow by the odometry's errors, and with the distance travelled by the
 * uncertainty of the wall's own direction. Beyond the measured stretch of a wall a distance may change by as much as
 * the machine travelled there; angles then grow as without odometry. Time through which an odometry carried a value
 * does not count for hold_max. A value whose level meanwhile passed the alert limit may come back. The scan's motion is
 * first removed from a cloud with times, where that narrows the levels.
 * The key `motion` switches ODOMETRY off. */
typedef struct pose_wall_inputs {
  uint32_t struct_size;         /* sizeof(pose_wall_inputs) */
  uint32_t given;               /* pose_wall_input bits; members whose bit is not set are not read, but body_box is */
  double speed_m_s;             /* along forward_axis, negative backwards; -50 to 50 */
  double speed_sigma_m_s;       /* its standard deviation; above 0, to 50 */
  double turn_rate_rad_s;       /* about +Z of base, positive to the left; -10 to 10 */
  double turn_rate_sigma_rad_s; /* its standard deviation; above 0, to 10 */
  double body_box[POSE_WALL_INPUT_BOXES][6]; /* beside the config's: where the boom is in this frame, in base, as
                                                body_box_1: x_min x_max y_min y_max z_min z_max. All zero: none */
  pose_wall_odometry odometry;               /* measured, of this frame */
} pose_wall_inputs;

/* Describes `count` points of three consecutive native floats each, `point_step` bytes apart. Fails iff: cloud NULL,
 * or data NULL with count > 0. */
int32_t pose_wall_cloud_xyz32_3(pose_wall_cloud* cloud, const void* data, uint32_t count, uint32_t point_step,
                                int64_t stamp_ns);
/* The same for programs built against a header whose cloud ends with inputs: writes no further. */
int32_t pose_wall_cloud_xyz32_2(pose_wall_cloud* cloud, const void* data, uint32_t count, uint32_t point_step,
                                int64_t stamp_ns);
/* For programs built against ABI 1, whose cloud is shorter: writes nothing and always returns POSE_WALL_E_ABI. */
int32_t pose_wall_cloud_xyz32(pose_wall_cloud* cloud, const void* data, uint32_t count, uint32_t point_step,
                              int64_t stamp_ns);
#define pose_wall_cloud_xyz32 pose_wall_cloud_xyz32_3

/* Checks whether pose_wall_process would take this cloud: the description only, no point. Fails as it does: NULL,
 * struct_size of cloud or inputs, POSE_WALL_E_CLOUD_*, POSE_WALL_E_INPUT. */
POSE_WALL_CHECKED int32_t pose_wall_cloud_check(const pose_wall_cloud* cloud);

/* ---------------------------------------------------------------------------------------------- result */

/* The seven quantities, in the order of pose_wall_result.quantity. */
enum pose_wall_quantity {
  POSE_WALL_ROLL = 0,
  POSE_WALL_PITCH = 1,
  POSE_WALL_YAW = 2,
  POSE_WALL_D_LF = 3, /* left wall at s_front */
  POSE_WALL_D_LB = 4, /* left wall at s_back */
  POSE_WALL_D_RF = 5, /* right wall at s_front */
  POSE_WALL_D_RB = 6, /* right wall at s_back */
  POSE_WALL_QUANTITIES = 7
};

enum pose_wall_state {
  POSE_WALL_INVALID = 0, /* never measured, or held until it expired (POSE_WALL_R_HOLD_EXPIRED); the last value stays
                            readable, confidence 0 */
  POSE_WALL_HELD = 1,    /* not measured in this frame: the last good value. Its protection level grows, except where an
                            odometry leads back to a measured place */
  POSE_WALL_DEGRADED = 2, /* measured in this frame, but its protection level passes the alert limit, a jump is not yet
                             confirmed, or the cloud came before (POSE_WALL_R_FROZEN) */
  POSE_WALL_VALID = 3     /* measured in this frame, protection level within the alert limit. The level reaches to every
                             reading of the scene that the engine knows of */
};

/* Why a value is not valid, and notes on valid ones. A valid value has none of the doubts FLOOR_AMBIGUOUS,
   WALL_AMBIGUOUS, WALL_SEEN_THROUGH, CURVED and EXTRAPOLATED: its level holds them. Bits; pinned by a test. */
enum pose_wall_reason {
  /* the frame */
  POSE_WALL_R_NO_POINTS = 1 << 0, /* too few points survive the filters */
  POSE_WALL_R_LEAF_GROWN =
      1 << 1, /* of the frame: voxel leaf enlarged to stay within points_max, in this frame or in one shortly before (a
                 note, not a fault). Of a value: even voxels of 0.26 m were too many, and larger ones are not used */
  POSE_WALL_R_STAMP_STILL =
      1 << 2, /* stamp less than 1 ms after the last frame's: counts as the same frame again, and nothing is measured.
                 Held values age by the longer of the last two periods, and at the first such frame also by what the
                 last period fell short of it. They expire at the third in a row. They expire at the first where no
                 period is known: no stamp has advanced by 1 ms to stamp_gap_max yet. In every frame: the stamps are not
                 in nanoseconds */
  POSE_WALL_R_STAMP_BACK = 1 << 3, /* stamp older than the last frame's: held values expire, smoothing restarts */
  POSE_WALL_R_STAMP_LEAP = 1 << 4, /* stamp more than stamp_gap_max ahead: smoothing restarts */
  POSE_WALL_R_FROZEN =
      1 << 5, /* exactly the points of one of the last 64 clouds, or of a part of one of the last 8, under a new stamp:
                 a frozen sensor, or a driver that repeats old packets. A part is 10 degrees, with 256 points or more in
                 whole sectors of 1.4 degrees. Degraded, with a level that grows with the age of the first copy. Held
                 after frozen_frames repeats in a row (repeats under an old stamp count, too), or where the clock went
                 back since the first copy */
  /* the floor */
  POSE_WALL_R_FLOOR_NOT_FOUND = 1 << 6,   /* no plane below the sensor could be a floor */
  POSE_WALL_R_FLOOR_FEW_INLIERS = 1 << 7, /* fewer than ground_inlier_min */
  POSE_WALL_R_FLOOR_THIN = 1 << 8,        /* its points lie nearly on one line, or cover too small an area */
  POSE_WALL_R_FLOOR_AMBIGUOUS =
      1 << 9, /* another level or slope (bench, pile, reflection, uneven ground) fits nearly as well, the machine may
                 stand on other ground than the visible floor (a ramp ahead), or both walls lean against it */
  /* the walls */
  POSE_WALL_R_WALL_NOT_FOUND = 1 << 10,
  POSE_WALL_R_WALL_FEW_INLIERS = 1 << 11, /* fewer than wall_inlier_min */
  POSE_WALL_R_WALL_SHORT = 1 << 12,       /* supported over less than wall_length_min along the road */
  POSE_WALL_R_WALL_LEANS = 1 << 13,       /* leans more than wall_lean_max_deg */
  POSE_WALL_R_WALL_SEEN_THROUGH =
      1 << 14, /* it is not solid like a wall, but may be pipes, props, a conveyor, vehicle or curtain. Rays pass it,
                  its top or both of its ends; or returns are missing where the wall should be, or so sparse that a gap
                  would go unnoticed; or it is visible only low enough to be a conveyor */
  POSE_WALL_R_WALL_AMBIGUOUS = 1 << 15, /* another plane on this side fits nearly as well, or did in one of the three
                                           frames before; or it is grooved along its length like stacked pipes */
  POSE_WALL_R_WALLS_NOT_PARALLEL = 1 << 16,
  POSE_WALL_R_YAW_OUT_OF_RANGE = 1 << 17, /* beyond yaw_max_deg, where side and face become ambiguous */
  POSE_WALL_R_CROSS_ROAD = 1 << 18,       /* a better pair of walls runs across the machine than along it */
  POSE_WALL_R_CURVED = 1 << 19,           /* a wall bends significantly */
  POSE_WALL_R_EXTRAPOLATED =
      1 << 20, /* of a distance: no wall visible around the sampling point, so its plane is extended there; or the wall
                  steps there, or the point lies in the rock. Of yaw: the walls are visible only well ahead or behind */
  /* the outcome */
  POSE_WALL_R_LEVEL_MISSING = 1 << 21, /* walls not searched: this frame has no floor to level by */
  POSE_WALL_R_ALERT_LIMIT = 1 << 22,   /* protection level above the alert limit */
  POSE_WALL_R_INNOVATION = 1 << 23, /* jumped further from the last value than the machine can move, or was refused and
                                       never good before. Three more frames must confirm it */
  POSE_WALL_R_RATE_LIMITED = 1 << 24,  /* smoothed yaw follows by yaw_rate_limit_deg per frame */
  POSE_WALL_R_HOLD_EXPIRED = 1 << 25,  /* held until its protection level passed the alert limit, its age passed
                                          hold_max, or stamps that jumped back or stood still left its age unknown */
  POSE_WALL_R_WALL_TOO_NEAR = 1 << 26, /* returns nearer than range_min block the view to this side */
  POSE_WALL_R_NEVER_MEASURED = 1 << 27,
  /* between frames */
  POSE_WALL_R_NO_FRAME = 1 << 28, /* from pose_wall_age: no frame has come since */
  /* limits and inputs */
  POSE_WALL_R_WORK_LIMIT =
      1 << 29,                /* the frame would have taken more steps than work_max: unfinished results are refused */
  POSE_WALL_R_PRIOR = 1 << 30 /* a part of the frame's pose_wall_inputs was not used: out of range, or contradicted by
                                 another part or by the measurements. Sound boxes were applied all the same */
};
#define POSE_WALL_REASON_COUNT 31

/* Short lower-case names for logs and CSV, static storage: "wall_short", "valid", "d_lf". */
const char* pose_wall_reason_name(uint32_t bit_index);
/* One English sentence for people. */
const char* pose_wall_reason_text(uint32_t bit_index);
const char* pose_wall_state_name(uint32_t state);
const char* pose_wall_quantity_name(uint32_t quantity);

/* The parts of a protection level; index of pose_wall_value.part. */
enum pose_wall_part {
  POSE_WALL_PART_RANDOM = 0,        /* standard deviations of the fit, as many as integrity_risk asks for */
  POSE_WALL_PART_RANGE_BIAS = 1,    /* effect of range_bias_max on this quantity */
  POSE_WALL_PART_BEND = 2,          /* the surface is no plane: bends, waves, ribs, walls that are not parallel */
  POSE_WALL_PART_RIVAL = 3,         /* another surface may be the floor or the wall, in this frame or a moment ago */
  POSE_WALL_PART_EXTRAPOLATION = 4, /* the wall is not visible at the sampling point */
  POSE_WALL_PART_LAG = 5,           /* value is not raw: smoothing */
  POSE_WALL_PART_AGE = 6, /* unknown motion: since the measurement, since a frozen cloud's first copy, or within a scan
                             of an odometry */
  POSE_WALL_PARTS = 7
};
/* "random", "range_bias"; static storage. */
const char* pose_wall_part_name(uint32_t part);

typedef struct pose_wall_value {
  /* The value for a controller to act on, if `state` allows: smoothed, or held; NaN if never measured. Smoothing is of
   * second order over temporal_smoothing_tau: it follows a steady turn without lag. It departs from raw by at most a
   * quarter of raw's level. With an odometry it is the mean of the looks of the way, without lag, that has the
   * narrowest level. */
  double value;
  double raw;   /* this frame's own measurement before smoothing; NaN if none */
  double sigma; /* standard deviation of raw: its random part, on rough rock too (held: of the last raw). Biases that
                   the engine can bound but not know (range bias, rival surfaces) are in the levels only */
  double protection_level; /* |value - truth| stays within it; NaN if never measured. Do not rely on it while invalid:
                              its stamps may have jumped */
  double raw_protection_level; /* |raw - truth| stays within it; NaN if nothing was measured */
  double confidence; /* alert limit / (alert limit + protection level); 0 when invalid; falls and rises with that level
                        while held */
  double age_s;      /* since the frame it was measured in, by the stamps (under ones that stand still: see
                        POSE_WALL_R_STAMP_STILL; under one that went back it does not grow); 0 when measured
                        in this one, or never */
  double part[POSE_WALL_PARTS]; /* of protection_level: they add up to it. Where the quantity was measured they add up
                                   to raw_protection_level without lag; with an odometry to no more than that */
  uint32_t state;               /* pose_wall_state */
  uint32_t reasons;             /* pose_wall_reason bits */
  uint32_t raw_state;           /* of raw by itself: valid, degraded, or invalid where nothing was measured */
  uint32_t cause;               /* pose_wall_part: the largest; POSE_WALL_PARTS where there is no level */
  uint32_t reserved[2];         /* 0 */
} pose_wall_value;

/* A fitted plane n . p + d = 0 of this frame. */
typedef struct pose_wall_plane {
  double normal[3]; /* unit; floor: base frame, pointing up. walls: levelled frame, pointing to the machine */
  double d_m;       /* floor: height of the base origin above it. walls: distance of the origin */
  double rms_m;     /* of the inliers */
  double lean_rad; /* walls: tilt from the vertical of the levelled frame, + leaning away from the machine at the top */
  double extent_min_m; /* from the base origin. walls: the supported span along the road. floor: the circle that it was
                          fitted within, so minus and plus its radius */
  double extent_max_m;
  double area_m2;   /* supported area */
  uint32_t found;   /* 0: of the other members only iterations and reasons are set. 1: a plane was fitted; the states of
                       the quantities show whether it was used */
  uint32_t inliers; /* measured points on the plane: each voxel counts the points it stands for */
  uint32_t
      iterations; /* hypotheses scored, including the last frame's plane. floor: up to ground_iterations, within the
                     radius of the accepted floor. walls: up to wall_iterations, and four more along the other wall */
  uint32_t reasons;
} pose_wall_plane;

/* Stages of the pipeline, in order; index of pose_wall_result.stage_ns. */
enum pose_wall_stage {
  POSE_WALL_STAGE_VOXEL = 0, /* ingest, extrinsic, filter, first voxel pass */
  POSE_WALL_STAGE_OUTLIERS = 1,
  POSE_WALL_STAGE_FLOOR = 2,
  POSE_WALL_STAGE_BAND = 3, /* levelling, wall band, second voxel pass */
  POSE_WALL_STAGE_WALLS = 4,
  POSE_WALL_STAGE_OUTPUT = 5, /* yaw, distances, quality, smoothing */
  POSE_WALL_STAGES = 6
};
const char* pose_wall_stage_name(uint32_t stage);

/* The meaning of a positive angle for a driver who looks along forward_axis. */
enum pose_wall_sense {
  POSE_WALL_SENSE_UNKNOWN = 0,
  POSE_WALL_SENSE_RIGHT_DOWN = 1,
  POSE_WALL_SENSE_LEFT_DOWN = 2,
  POSE_WALL_SENSE_NOSE_DOWN = 3,
  POSE_WALL_SENSE_NOSE_UP = 4,
  POSE_WALL_SENSE_TURNED_RIGHT = 5 /* the machine points to the right of the road: yaw, always */
};
/* "right side down"; static storage. */
const char* pose_wall_sense_name(uint32_t sense);

typedef struct pose_wall_result {
  uint32_t struct_size; /* set by the caller to sizeof(pose_wall_result) before the call */
  uint32_t frame_reasons;
  uint32_t mark;              /* set by the engine: shows that an engine wrote this result */
  uint32_t config_crc32;      /* pose_wall_config_crc() of the engine's config */
  uint32_t source_id;         /* of the config: number of this sensor or engine */
  uint32_t positive_means[3]; /* pose_wall_sense of roll, pitch and yaw, by forward_axis */
  uint64_t publication;       /* counts the results of this engine from 1, including those of pose_wall_age */
  uint64_t work;              /* steps of work in this frame, see work_max; the same on every machine */
  int64_t stamp_ns;           /* the frame's */
  uint64_t frame_index; /* counts processed frames from 0; of pose_wall_age: the last one's, UINT64_MAX before any */
  double confidence;    /* the smallest of the seven */
  pose_wall_value quantity[POSE_WALL_QUANTITIES];
  pose_wall_plane floor;
  pose_wall_plane left;
  pose_wall_plane right;
  double R_level_base[9];               /* row-major; identity when there is no floor */
  double left_right_yaw_difference_rad; /* yaw by the left wall minus yaw by the right one; NaN unless both.
                                           Half of it shows a common range bias when the walls are parallel */
  double voxel_leaf_m;                  /* used in this frame */
  int64_t stage_ns[POSE_WALL_STAGES];   /* 0 without a clock, see pose_wall_set_clock */
  uint32_t points_in;
  uint32_t dropped_not_finite;
  uint32_t dropped_zero; /* exactly at the sensor: a no-return */
  uint32_t dropped_near;
  uint32_t dropped_far;
  uint32_t dropped_body;
  uint32_t voxels;
  uint32_t outliers;
  uint32_t open_points; /* voxels with nothing over or under them, within the radius of the search for the floor */
  uint32_t wall_points; /* voxels of the wall band */
} pose_wall_result;

/* ---------------------------------------------------------------------------------------------- engine */

#define POSE_WALL_BLOCK_ALIGNMENT 64

typedef struct pose_wall_engine pose_wall_engine;

/* Bytes of the block that an engine of this config lives in; depends on points_max only. Fails iff: NULL, not
 * initialised, POSE_WALL_E_CONFIG_RULE. */
POSE_WALL_CHECKED int32_t pose_wall_memory_needed(const pose_wall_config* config, uint64_t* bytes);
/* Bytes that are enough for every config of this points_max, for static arrays: pose_wall_memory_needed asks for no
 * more. Of this version: a later one may need more, and then refuses the block. */
#define POSE_WALL_BLOCK_MOST(points_max) (1703936 + 96 * (points_max))

/* Places an engine in block, which may hold anything and stays the caller's. The block must outlive the engine and not
 * move. The config is copied. Fails iff: NULL, config not initialised (POSE_WALL_E_STRUCT_SIZE),
 * POSE_WALL_E_CONFIG_RULE, block misaligned or too small, or a call is inside an engine in this block
 * (POSE_WALL_E_BUSY). *engine is set only on success. A block in memory that outlives its process stays busy if the
 * process died inside a call. Clear its first POSE_WALL_BLOCK_ALIGNMENT bytes before opening it again.
 * There is nothing to close. Cost: negligible; the engine clears the block as it uses it. A checksum covers settings,
 * memory and pointers in the block, and every call checks it. After any change from outside the engine is refused
 * (POSE_WALL_E_ENGINE) until it is opened again. */
POSE_WALL_CHECKED int32_t pose_wall_open(const pose_wall_config* config, void* block, uint64_t block_bytes,
                                         pose_wall_engine** engine);

/* Forgets all measurements, as if just opened. Fails iff: NULL, engine not open. */
POSE_WALL_CHECKED int32_t pose_wall_reset(pose_wall_engine* engine);

/* Gives the engine a clock for stage_ns: a function that returns monotonic nanoseconds. NULL takes it away. The
 * engine's results never depend on it. Fails iff: engine NULL or not open. */
typedef int64_t (*pose_wall_clock)(void* user);
int32_t pose_wall_set_clock(pose_wall_engine* engine, pose_wall_clock clock, void* user);

/* One frame in, one result out. Set result->struct_size = sizeof *result first. A malformed cloud description is
 * refused with a status, and engine and result stay unchanged. A cloud of garbage points is processed, and the result
 * shows the unmeasured quantities. Fails iff: NULL, engine not open or in use (POSE_WALL_E_BUSY; so in all calls that
 * take an engine), struct_size of cloud, inputs or result, POSE_WALL_E_CLOUD_*, POSE_WALL_E_INPUT. Cost: O(width x
 * height) for reading plus a bounded part, see TIME above. */
POSE_WALL_CHECKED int32_t pose_wall_process(pose_wall_engine* engine, const pose_wall_cloud* cloud,
                                            pose_wall_result* result);

/* The seven quantities at stamp_ns, when no frame has come since the last: for the time in which a sensor is silent.
 * Values are held and aged as in a frame that measures nothing, then invalid, with POSE_WALL_R_NO_FRAME. The argument
 * stamp_ns uses the clock of the frames' stamps; nothing ages at or before the last frame's stamp. The result has the
 * last frame's frame_index (UINT64_MAX before the first), no planes and no counts. Set result->struct_size first. Fails
 * iff: NULL, engine not open, struct_size. The call has one lasting effect: a value that it reported invalid stays so
 * until it is measured again, even if the next frame's stamp says that less time has passed. The next frame is smoothed
 * over its own time since the last one. */
POSE_WALL_CHECKED int32_t pose_wall_age(pose_wall_engine* engine, int64_t stamp_ns, pose_wall_result* result);

/* The time at which a memento is saved or loaded, as far as the caller knows it. Without it the ages of its values are
 * unknown. */
enum pose_wall_moment_known {
  POSE_WALL_MOMENT_BOOT = 1, /* boot_id and stamp_ns: within one boot the stamps' clock goes forward */
  POSE_WALL_MOMENT_WALL = 2, /* wall_ns and stamp_ns: a clock that runs while the machine is off */
  POSE_WALL_MOMENT_SAME_CLOCK =
      4 /* load only: the caller guarantees that the stamps continue the clock of the saved ones */
};
typedef struct pose_wall_moment {
  uint32_t struct_size; /* sizeof(pose_wall_moment) */
  uint32_t known;       /* pose_wall_moment_known bits */
  uint8_t boot_id[16];  /* another one after each start of the machine: /proc/sys/kernel/random/boot_id, or a number
                           drawn at start. All zero: refused where POSE_WALL_MOMENT_BOOT is set */
  int64_t wall_ns;      /* nanoseconds since any fixed date */
  int64_t stamp_ns;     /* now, in the clock of the clouds' stamps */
} pose_wall_moment;

/* The engine's memory from frame to frame, as bytes, the same on every machine. With it any frame can be computed
 * again: an engine of the same version and config loads the memento from before a frame and gives the same bits for
 * that frame. The call load checks length (of a longer one it reads the first pose_wall_memento_bytes), version, config
 * and checksum. It takes nothing of a memento that it refuses: after a change of the config an engine starts without
 * memory. Trust a memento like the config: whoever writes it can make the engine believe a false past. Neither call
 * changes the points of pose_wall_last_points.
 *
 * AGE  values stay held only where load can date them:
 * - in the same boot (POSE_WALL_MOMENT_BOOT at both times, the same boot_id),
 * - by the wall clock (POSE_WALL_MOMENT_WALL at both times, and it did not go back), or
 * - on the caller's word (POSE_WALL_MOMENT_SAME_CLOCK).
 *
 * By the wall clock values age by the time that passed on it, and stamps continue from the moment's stamp_ns.
 * Otherwise, and with now NULL, all values have expired; leaf and planes are still known. Earlier clouds are still
 * known only in the same boot or on the caller's word.
 *
 * Fails iff: engine or memento NULL, engine not open, moment's struct_size, an unknown bit in it or a boot_id of zeros
 * (POSE_WALL_E_INPUT). save fails also with POSE_WALL_E_BUFFER_SMALL, load also with POSE_WALL_E_MEMENTO. Cost: no more
 * than copying. */
uint64_t pose_wall_memento_bytes(void);
POSE_WALL_CHECKED int32_t pose_wall_save(const pose_wall_engine* engine, const pose_wall_moment* now, void* memento,
                                         uint64_t bytes);
POSE_WALL_CHECKED int32_t pose_wall_load(pose_wall_engine* engine, const pose_wall_moment* now, const void* memento,
                                         uint64_t bytes);

enum pose_wall_label {
  POSE_WALL_LABEL_OTHER = 0,
  POSE_WALL_LABEL_FLOOR = 1,
  POSE_WALL_LABEL_LEFT = 2,
  POSE_WALL_LABEL_RIGHT = 3
};

/* The voxel centroids of the last processed frame, base frame, with their labels: for pictures and logs. The pointers
 * lead into the block and are valid until the next call on this engine. Cost: this call computes the labels, about 150
 * instructions a centroid; frames pay nothing for them. Fails iff: NULL, engine not open. */
typedef struct pose_wall_points {
  const float* x_base_m;
  const float* y_base_m;
  const float* z_base_m;
  const uint8_t* label; /* pose_wall_label */
  uint32_t count;
  uint32_t reserved;
} pose_wall_points;
POSE_WALL_CHECKED int32_t pose_wall_last_points(const pose_wall_engine* engine, pose_wall_points* points);

/* ---------------------------------------------------------------------------------------------- self test */

/* For start-up and proof tests. The engine measures a built-in road with built-in settings, through the functions of
 * this header. Every value must be right: valid and within its level of the truth, but not measured beside an open side
 * or without a floor. All outputs (results, process images of layout 1, labelled points) must have the noted bits. The
 * test shows that this processor, compiler and memory compute as the tested ones. It shows nothing about the sensor,
 * your settings, or an engine that is open elsewhere.
 *
 * CODE   a CRC-32 (as that of the process image) over the engine's machine code and constants in this program's memory.
 * Note it when the program is approved and compare it at each start. It is the same in each run of one program. It
 * differs between programs, because a linker fills in addresses. Tables of pointers, which a loader fills in at each
 * start, are left out. The code must be readable: execute-only memory does not work.
 *
 * TIME   POSE_WALL_SELF_TEST_FRAMES frames of at most POSE_WALL_SELF_TEST_POINTS points and one pass over the code:
 * always the same work. */

#define POSE_WALL_SELF_TEST_FRAMES 4
#define POSE_WALL_SELF_TEST_POINTS 19200

typedef struct pose_wall_self_test_report {
  uint32_t struct_size;     /* set by the caller to sizeof(pose_wall_self_test_report) before the call */
  uint32_t frames;          /* measured */
  uint64_t digest_expected; /* FNV-1a, 64 bits, of all outputs: as noted in the library */
  uint64_t digest_found;
  uint64_t code_bytes;   /* under the CRC; 0: the engine was not linked from its archive */
  uint32_t code_crc32;   /* 0 then */
  uint32_t values_wrong; /* of 7 in each frame: wrong, or in the wrong state */
  int32_t refused;       /* status of a refused call of the engine, or POSE_WALL_OK */
  uint32_t reserved;
} pose_wall_self_test_report;

/* Bytes of the block for the self test: below 2.5 MiB. Use the block of an engine before that engine is opened, if you
 * like. */
uint64_t pose_wall_self_test_bytes(void);

/* Runs the self test in a block aligned to POSE_WALL_BLOCK_ALIGNMENT. The block's contents are lost, and afterwards no
 * engine is open in it. Fails iff: NULL, struct_size, block misaligned or too small, each with the report unchanged; or
 * POSE_WALL_E_SELF_TEST, with the report filled: do not measure with this program. */
POSE_WALL_CHECKED int32_t pose_wall_self_test(void* block, uint64_t bytes, pose_wall_self_test_report* report);

/* ---------------------------------------------------------------------------------------------- process image */

/* A result for a controller, in words of 4 bytes without gaps. It fits into one PROFINET submodule or one Modbus read
 * (125 registers). The folder plc of the package has the structured text for it, and a function block that uses it.
 *
 * IMAGES   image 2 (pose_wall_image2, 62 words, 124 registers) is for new controllers. Image 1 (pose_wall_image, 60
 * words, 120 registers) stays as it is, for its present readers. Both hold the same seven quantities.
 *
 * NUMBERS   scaled integers (0.001 deg, mm). Image 1 has floats (rad, m) beside them, never NaN or infinite, because
 * those stop some controllers. Larger numbers saturate at +-2147483647. No value: POSE_WALL_IMAGE_NO_VALUE. No
 * protection level: POSE_WALL_IMAGE_NO_BOUND, the worst there is. A float has the same numbers for them. A protection
 * level is rounded up and includes the rounding of its value: |value - truth| <= protection holds for each pair of
 * numbers in the image. An age that is unknown or too large is 4294967295.
 *
 * BYTES   each word is in the host's order. The CRC is over the bytes as laid out low byte first, whatever the host: a
 * controller of the other order swaps the four bytes of every word, and nothing else.
 *
 * CRC   over all struct_size bytes but its own four, begun and ended with FFFFFFFF, bits reflected. Image 1: CRC-32 of
 * IEEE 802.3 (polynomial 04C11DB7; "123456789" gives CBF43926). Image 2: CRC-32C (Castagnoli, polynomial 1EDC6F41;
 * "123456789" gives E3069283). Frames of Ethernet, and so of EtherCAT and PROFINET, carry the polynomial of image 1.
 * Damage that escapes such a frame's CRC is therefore more likely to escape an image's CRC of the same polynomial.
 * Koopman, 32-Bit Cyclic Redundancy Codes for Internet Applications, DSN 2002, has the distances of both. Either finds
 * damage, not intent.
 *
 * SEQUENCE   frame_index + 1 (low 32 bits): 0 before the first frame, 1 with it. A new frame changes it; while it
 * stands still, the values are old. Images of pose_wall_age have the sequence of the last frame. It restarts with
 * pose_wall_open and pose_wall_reset, and continues from the memento's with pose_wall_load. PUBLICATION (image 2)
 * changes with pose_wall_age, too: while it stands still, nobody publishes.
 *
 * VERSION   raised when a member moves or changes its meaning. New members come at the end and change struct_size. */

#define POSE_WALL_IMAGE_VERSION 1
#define POSE_WALL_IMAGE2_VERSION 2
#define POSE_WALL_IMAGE_NO_VALUE (-2147483647 - 1)
#define POSE_WALL_IMAGE_NO_BOUND 2147483647

/* From here on written by tools/apps/plc/generate.py from tools/apps/plc/image.def. */

#define POSE_WALL_IMAGE_BYTES 240
#define POSE_WALL_IMAGE2_BYTES 248

/* One of the three angles. 28 bytes. */
typedef struct pose_wall_image_angle {
  int32_t value_mdeg;      /* 0.001 deg: what a controller acts on */
  int32_t protection_mdeg; /* 0.001 deg: protection level, rounded up */
  float value_rad;         /* rad: the same as value_mdeg, finer */
  float protection_rad;    /* rad: rounded up */
  uint32_t age_ms;         /* ms: since it was measured, rounded up */
  uint32_t state;          /* pose_wall_state */
  uint32_t reasons;        /* pose_wall_reason */
} pose_wall_image_angle;

/* One of the four distances. 28 bytes. */
typedef struct pose_wall_image_distance {
  int32_t value_mm;      /* mm: what a controller acts on */
  int32_t protection_mm; /* mm: protection level, rounded up */
  float value_m;         /* m: the same as value_mm, finer */
  float protection_m;    /* m: rounded up */
  uint32_t age_ms;       /* ms: since it was measured, rounded up */
  uint32_t state;        /* pose_wall_state */
  uint32_t reasons;      /* pose_wall_reason */
} pose_wall_image_distance;

/* One frame for a controller. 240 bytes. */
typedef struct pose_wall_image {
  uint32_t struct_size;     /* bytes: POSE_WALL_IMAGE_BYTES */
  uint32_t version;         /* POSE_WALL_IMAGE_VERSION */
  uint32_t crc32;           /* CRC-32 of every byte but its own four */
  uint32_t sequence;        /* frames since the engine was opened or reset: 0 before the first */
  uint32_t config_crc32;    /* pose_wall_config_crc() of the engine's config */
  uint32_t library_version; /* major * 65536 + minor * 256 + patch */
  uint32_t stamp_low;       /* the frame's stamp_ns, bits 0 to 31 */
  uint32_t stamp_high;      /* and bits 32 to 63 */
  uint32_t verdict;         /* the worst of the seven states, pose_wall_state */
  uint32_t valid;           /* bit q set: quantity q is valid, q as in pose_wall_quantity */
  uint32_t frame_reasons;   /* pose_wall_reason of the frame */
  pose_wall_image_angle roll;
  pose_wall_image_angle pitch;
  pose_wall_image_angle yaw;
  pose_wall_image_distance d_lf; /* left wall at s_front */
  pose_wall_image_distance d_lb; /* left wall at s_back */
  pose_wall_image_distance d_rf; /* right wall at s_front */
  pose_wall_image_distance d_rb; /* right wall at s_back */
} pose_wall_image;

/* One of the three angles of image 2. 28 bytes. */
typedef struct pose_wall_image2_angle {
  int32_t value_mdeg;      /* 0.001 deg: what a controller acts on */
  int32_t protection_mdeg; /* 0.001 deg: protection level, rounded up */
  uint32_t age_ms;         /* ms: since it was measured, rounded up */
  uint32_t state;          /* pose_wall_state */
  uint32_t reasons;        /* pose_wall_reason */
  uint32_t cause;          /* pose_wall_part: what the level is mostly made of; 7: no level */
  uint32_t positive_means; /* pose_wall_sense: what a positive value means to the driver */
} pose_wall_image2_angle;

/* One of the four distances of image 2. 24 bytes. */
typedef struct pose_wall_image2_distance {
  int32_t value_mm;      /* mm: what a controller acts on */
  int32_t protection_mm; /* mm: protection level, rounded up */
  uint32_t age_ms;       /* ms: since it was measured, rounded up */
  uint32_t state;        /* pose_wall_state */
  uint32_t reasons;      /* pose_wall_reason */
  uint32_t cause;        /* pose_wall_part: what the level is mostly made of; 7: no level */
} pose_wall_image2_distance;

/* One publication for a controller. 248 bytes. */
typedef struct pose_wall_image2 {
  uint32_t struct_size;     /* bytes: POSE_WALL_IMAGE2_BYTES */
  uint32_t version;         /* POSE_WALL_IMAGE2_VERSION */
  uint32_t crc32c;          /* CRC-32C of every byte but its own four */
  uint32_t sequence;        /* frames since the engine was opened or reset: 0 before the first */
  uint32_t publication;     /* changes with every publication, of a frame or of silence */
  uint32_t config_crc32;    /* pose_wall_config_crc() of the engine's config */
  uint32_t library_version; /* major * 65536 + minor * 256 + patch */
  uint32_t stamp_low;       /* the frame's stamp_ns, bits 0 to 31 */
  uint32_t stamp_high;      /* and bits 32 to 63 */
  uint32_t source_id;       /* which sensor or engine of several, of the config */
  uint32_t latency_ms;      /* ms: from reception to publication, rounded up; 4294967295: not known */
  uint32_t thinning;        /* of every so many returns one was used; 0: not known */
  uint32_t held_thinning;   /* the largest thinning of what held values come from; 0: not known */
  uint32_t told_by;         /* 1: a frame, 2: silence, 0: not known */
  uint32_t verdict;         /* the worst of the seven states, pose_wall_state */
  uint32_t valid;           /* bit q set: quantity q is valid, q as in pose_wall_quantity */
  uint32_t frame_reasons;   /* pose_wall_reason of the frame */
  pose_wall_image2_angle roll;
  pose_wall_image2_angle pitch;
  pose_wall_image2_angle yaw;
  pose_wall_image2_distance d_lf; /* left wall at s_front */
  pose_wall_image2_distance d_lb; /* left wall at s_back */
  pose_wall_image2_distance d_rf; /* right wall at s_front */
  pose_wall_image2_distance d_rb; /* right wall at s_back */
} pose_wall_image2;

/* Up to here. */

/* Writes the whole image of a result, of any engine; the config's CRC is the result's. Set image->struct_size = sizeof
 * *image and result->struct_size first. Fails iff: NULL, a struct_size of another version, a result that no engine made
 * (POSE_WALL_E_RESULT); the image is then unchanged. Cost: some thousand simple operations. */
POSE_WALL_CHECKED int32_t pose_wall_image_fill(const pose_wall_result* result, pose_wall_image* image);

/* POSE_WALL_OK for an image as pose_wall_image_fill left it. Fails iff: NULL, POSE_WALL_E_IMAGE_VERSION,
 * POSE_WALL_E_IMAGE_CRC. */
POSE_WALL_CHECKED int32_t pose_wall_image_check(const pose_wall_image* image);

/* A runtime's data of a publication, which no result holds. */
typedef struct pose_wall_image_source {
  uint32_t struct_size;   /* sizeof(pose_wall_image_source) */
  uint32_t cause;         /* 1: a frame, 2: silence, as in pose_wall_runtime_cause; 0: not known */
  uint32_t thinning;      /* as in pose_wall_publication; 0: not known */
  uint32_t held_thinning; /* as in pose_wall_publication; 0: not known */
  uint64_t publication;   /* another number for every publication; the image takes its low 32 bits */
  int64_t latency_ns;     /* from reception to publication; negative: not known */
} pose_wall_image_source;

/* As pose_wall_image_fill, for image 2. source may be NULL: publication is then the result's own, and the other members
 * are unknown. Without a runtime set publication to the result's own, cause 1 (2 for a result of pose_wall_age),
 * thinning and held_thinning 1, and latency_ns by your own clock. Fails iff: result or image NULL, a struct_size of
 * another version, POSE_WALL_E_RESULT; the image is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_image2_fill(const pose_wall_result* result, const pose_wall_image_source* source,
                                                pose_wall_image2* image);

/* POSE_WALL_OK for an image as pose_wall_image2_fill left it. Fails as pose_wall_image_check. */
POSE_WALL_CHECKED int32_t pose_wall_image2_check(const pose_wall_image2* image);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_H */

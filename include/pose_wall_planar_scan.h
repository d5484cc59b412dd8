/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * From a 3D cloud to a planar scan, by the machine's height. A part of pose_wall_planar, whose header has the common
 * rules.
 *
 *     pose_wall_planar_scanner_settings settings;
 *     pose_wall_planar_scanner_settings_init(&settings);
 *     settings.ground_clearance_m = 0.25;                    h_vb of the document
 *     settings.machine_height_m = 1.8;                       h_v_max
 *     pose_wall_planar_scanner_memory_needed(&settings, &bytes);
 *     pose_wall_planar_scanner_open(&config, &settings, block, bytes, &scanner);
 *     for every frame:
 *         pose_wall_process(engine, &cloud, &result);
 *         pose_wall_planar_floor_of(&result, &floor);
 *         pose_wall_planar_scanner_process(scanner, &cloud, &floor, &scan, &view);
 *
 * HEIGHTS   count from the measured floor, along its normal. The sensor's axes play no part. A return belongs to
 *             the floor      below floor_tolerance_m, which widens with the distance by the floor's uncertain tilt;
 *             low things     above that and below the band: the machine passes over them, if they are near;
 *             the band       from h_vb - h_th to h_v_max + h_th: the machine would touch it. Only these are in a scan;
 *             overhead       above the band by less than overhead_m;
 *             the roof       above that.
 *           Beyond the reach of the measured floor the ground may bend by bend_rad. There the band shrinks by as much
 *           at both ends, by a third of it at most, and the returns that leave it are low or overhead. So a road that
 *           rises or falls ahead makes no wall in the scan, and a low thing there is still reported, as low. The
 *           document counts the band from the sensor. Its min_height and max_height, with the measured height of the
 *           sensor (h_l) in them, are in the view.
 * LEVEL     the scan lies in the levelled frame of pose_wall.h: base, turned by roll and pitch. scan.sensor is the
 *           place of the sensor in it; angles count from +X of base. Ranges are horizontal.
 * RANGE     A beam takes the k-th smallest range of the returns in its nearest surface: k is 1, 2, 3 and 4 from 1, 4, 8
 *           and 16 returns on. On average noise makes it too short (the smallest of 16 by 1.77 standard deviations).
 *           That is computed for each beam from k, the number of returns and the share of noise in their scatter, added
 *           to the range, and reported as bias_m. What remains is the near face of the rock. Where a beam is wide or a
 *           wall slants, each return is first moved to the middle of its beam along the slope of the neighbours.
 * BETWEEN   Sensors have fewer directions than a scan of 0.001 rad has beams. Two neighbours up to fill_rad apart that
 *           can be one surface are joined: the beams between them take its ranges and count 0 returns. fill_rad must be
 *           at least the sensor's step: 0.0062 for 1024 columns. Beams between others stay without a range.
 * FREE      Unknown is not free. free_m is how far a ray in this direction was seen to pass inside the band: up to the
 *           thing, or to where the ray that gives the last return left the band. Without a return it is 0. scan.range_m
 *           is plus infinity only where free_m reaches range_max_m.
 * CLEAR     free_m is the evidence of single rays, for maps. clear_m is a guarantee, for stopping: between clear_from_m
 *           and clear_m of this direction there is nothing of thing_m x thing_m (height by width across the ray) or
 *           more, standing on the floor, hanging or floating, with thing_m of its height between the floor and the top
 *           of the band, that the scan does not report. It holds whether or not the thing reflects, since each missing
 *           return leaves a gap between the rays. It ends where two rays above each other are too far apart: 0.2 m over
 *           the step of the rings. It needs a floor that is plane within floor_tolerance_m, and it begins where the
 *           lowest ray comes below thing_m.
 * ALONE     a nearer return that has no other within 0.2 m, in its beam or the next ones, may be dust or a thin thing.
 *           It counts as a thing, or (POSE_WALL_PLANAR_ALONE_IS_APART) the scan shows the surface behind it. alone_m
 *           has it either way, and behind_m the next return. Nothing is dropped.
 * FLOOR     the frame's floor counts if its level of tilt is within tilt_level_max_rad. Up to one degree its tilt may
 *           be off by three standard deviations, beyond by the whole level: then beams know a thing from the ground
 *           less far. Without such a floor, or where that is better than this one of more than a degree, the last one
 *           is held for hold_max_s of the stamps, its tilt growing by the config's hold_rate_angle. After that every
 *           beam is unknown.
 * CONFIG    of pose_wall_config: the extrinsic, range_min, body_box_1 to 4 (and body_box of cloud.inputs), range_noise,
 *           hold_rate_angle. A ray that ends on the machine itself shows nothing.
 * LIMITS    the floor is one plane: where the ground rises further than HEIGHTS allows for, it is a thing. The motion
 *           of the machine during the scan is not removed.
 * COST      one pass over the cloud and one over its returns in the band.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_SCAN_H
#define POSE_WALL_PLANAR_SCAN_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The floor under base, as planar scan and others need it. */
typedef struct pose_wall_planar_floor {
  uint32_t struct_size;  /* sizeof(pose_wall_planar_floor) */
  uint32_t measured;     /* 1: in this frame. 0: the other members are not read */
  double normal[3];      /* in base, unit within 0.001, pointing up, at most 60 degrees from +Z */
  double height_m;       /* of the origin of base above it: -20 to 20 */
  double tilt_sigma_rad; /* standard deviation of roll and pitch, the larger: 0 to 0.5 */
  double tilt_level_rad; /* their protection level, the larger: 0 to infinite */
  double reach_m;        /* the floor was seen up to this distance from base: 0 to infinite */
} pose_wall_planar_floor;

/* From an engine's result; measured is 0 where this frame measured no floor. Set floor->struct_size first. Fails iff:
 * NULL, a struct_size of another version. */
POSE_WALL_CHECKED int32_t pose_wall_planar_floor_of(const pose_wall_result* result, pose_wall_planar_floor* floor);

enum pose_wall_planar_alone {
  POSE_WALL_PLANAR_ALONE_IS_THING = 0, /* the scan ends at it */
  POSE_WALL_PLANAR_ALONE_IS_APART = 1  /* the scan shows the surface behind it, where there is one */
};

typedef struct pose_wall_planar_scanner_settings {
  uint32_t struct_size; /* set by pose_wall_planar_scanner_settings_init */
  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_planar_scanner_settings.def"
} pose_wall_planar_scanner_settings;

/* Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_scanner_settings_init(pose_wall_planar_scanner_settings* settings);
/* Fails iff: NULL, struct_size, POSE_WALL_E_VALUE_RANGE. Only in the last case it writes *fault, which may be NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_scanner_settings_check(const pose_wall_planar_scanner_settings* settings,
                                                                  pose_wall_planar_fault* fault);

/* More returns in the band than these count for the nearest range only, not for its bias and noise. */
#define POSE_WALL_PLANAR_SCAN_RETURNS 131072

enum pose_wall_planar_floor_state {
  POSE_WALL_PLANAR_FLOOR_NONE = 0, /* every beam is unknown */
  POSE_WALL_PLANAR_FLOOR_HELD = 1,
  POSE_WALL_PLANAR_FLOOR_MEASURED = 2
};

/* Beside the scan. The arrays have scan.beams members, lie in the block and are valid until the next call. */
typedef struct pose_wall_planar_scan_view {
  uint32_t struct_size;   /* set by the caller to sizeof(pose_wall_planar_scan_view) */
  uint32_t floor_state;   /* pose_wall_planar_floor_state */
  double floor_age_s;     /* 0 if measured, NaN if none */
  double sensor_height_m; /* h_l, measured; NaN without a floor. So are the next two */
  double min_height_m;    /* the document's -(h_l - h_vb + h_th), from the sensor */
  double max_height_m;    /* the document's h_v_max - h_l + h_th */
  double low_reach_m;     /* so far the tilt is known well enough to tell things lower than the band from the floor */
  const float* free_m;    /* 0: nothing was seen to pass */
  const float* bias_m;    /* what was added to the range; 0 where nothing was */
  const float*
      sigma_m;        /* scatter of the returns of this beam's surface: noise and relief; NaN where there is no range */
  const float* low_m; /* nearest low thing; NaN: none */
  const float* overhead_m;   /* nearest return overhead, or in the top of the band where that shrinks; NaN: none */
  const float* alone_m;      /* a return alone, nearer than any surface; NaN: none */
  const float* behind_m;     /* nearest return in the band behind the range: a speck of dust hides none. NaN: none */
  const float* clear_from_m; /* NaN: no guarantee */
  const float* clear_m;
  const uint16_t* returns; /* of the beam's nearest surface; 0: no range, or one from the neighbours */
  uint32_t points_in;      /* this and all below are 0 without a floor */
  uint32_t dropped;        /* not finite, no-returns, nearer than range_min of the config, beyond 1000 m */
  uint32_t of_body;
  uint32_t of_floor; /* and below it */
  uint32_t of_low;
  uint32_t of_band;
  uint32_t of_overhead;
  uint32_t of_roof;
  uint32_t out_of_scan; /* beside its angles or ranges. These count in the five above, too */
  uint32_t uncounted;   /* returns in the band beyond POSE_WALL_PLANAR_SCAN_RETURNS */
} pose_wall_planar_scan_view;

typedef struct pose_wall_planar_scanner pose_wall_planar_scanner;

/* Bytes of the block. settings NULL: the defaults. Fails iff: bytes NULL, as pose_wall_planar_scanner_settings_check.
 */
POSE_WALL_CHECKED int32_t pose_wall_planar_scanner_memory_needed(const pose_wall_planar_scanner_settings* settings,
                                                                 uint64_t* bytes);
/* Bytes that are enough with the default settings, for static arrays. Of this version: a later one may need more, and
 * then refuses the block. */
#define POSE_WALL_PLANAR_SCANNER_BLOCK_MOST 2097152 /* 2 MiB */
/* settings NULL: the defaults. Fails iff: config, block or scanner NULL, as pose_wall_config_check and
 * pose_wall_planar_scanner_settings_check, POSE_WALL_E_BLOCK_ALIGN, POSE_WALL_E_BLOCK_SMALL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_scanner_open(const pose_wall_config* config,
                                                        const pose_wall_planar_scanner_settings* settings, void* block,
                                                        uint64_t block_bytes, pose_wall_planar_scanner** scanner);
/* Forgets the held floor. Fails iff: NULL, not open, busy. */
POSE_WALL_CHECKED int32_t pose_wall_planar_scanner_reset(pose_wall_planar_scanner* scanner);

/* One frame. floor NULL: none was measured. Set scan->struct_size, and that of view, first; view may be NULL. The scan
 * is complete with free_m; its arrays lie in the block and are valid until the next call. Fails iff: NULL, not open,
 * busy, a struct_size, as pose_wall_cloud_check, a measured floor out of its ranges (POSE_WALL_PLANAR_E_POSE). */
POSE_WALL_CHECKED int32_t pose_wall_planar_scanner_process(pose_wall_planar_scanner* scanner,
                                                           const pose_wall_cloud* cloud,
                                                           const pose_wall_planar_floor* floor,
                                                           pose_wall_planar_scan* scan,
                                                           pose_wall_planar_scan_view* view);

/* ---------------------------------------------------------------------------------------------- LaserScan */

/* The members of sensor_msgs/LaserScan, but header and intensities. */
typedef struct pose_wall_planar_laserscan {
  float angle_min; /* rad */
  float angle_max;
  float angle_increment;
  float time_increment; /* s */
  float scan_time;      /* s */
  float range_min;      /* m */
  float range_max;
  uint32_t count;      /* of ranges */
  const float* ranges; /* m */
} pose_wall_planar_laserscan;

/* A message for this scan; its ranges are the scan's. LaserScan has no free_m: those beams are NaN. Fails iff: NULL, a
 * scan that is none (POSE_WALL_PLANAR_E_SCAN). */
POSE_WALL_CHECKED int32_t pose_wall_planar_laserscan_of(const pose_wall_planar_scan* scan,
                                                        pose_wall_planar_laserscan* message);

/* A scan for this message of a sensor that stands at `sensor` in base. sigma_m: of a range. Drivers fill in infinity
 * both for "nothing up to range_max" and for "no return", which on black rock is another thing. Where
 * infinite_is_open is 0, infinity counts as unknown: ranges_m, with room for count floats, then takes the ranges (it
 * may be NULL where infinite_is_open is 1). Fails iff: NULL, a message that is no scan (POSE_WALL_PLANAR_E_SCAN). */
POSE_WALL_CHECKED int32_t pose_wall_planar_scan_of_laserscan(const pose_wall_planar_laserscan* message,
                                                             const pose_wall_planar_pose* sensor, double sigma_m,
                                                             int64_t stamp_ns, uint32_t infinite_is_open,
                                                             float* ranges_m, pose_wall_planar_scan* scan);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_SCAN_H */

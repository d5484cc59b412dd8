/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * The map of pose_wall_planar: which cells of the plane are free, which hold a thing, and which nothing is known of.
 *
 * CELLS     squares of cell_m in the frame map. Each holds the logarithm of the odds of a thing in steps of 1/16, or
 *           that it was never seen. Unknown is not free: a cell is free only after enough beams went through it.
 * TILES     squares of 64 x 64 cells, at most settings.tiles of them, all in the caller's block. When a new one is
 *           needed and none is left, the oldest or the farthest goes to the callback of pose_wall_planar_map_on_save.
 *           Without a callback, or if it refuses, the tile stays, the new cells are not stored, and the report says so.
 * BEAMS     a beam frees the cells on its way and adds a thing at its end. Within one scan each cell counts once, and
 *           a thing wins over a free beam. Just before its end a beam frees nothing: over one cell (or two sigma_m)
 *           across the surface, which is a long way for a beam that grazes a wall. Behind the end all stays as it was.
 *           A beam to infinity frees its way up to range_max_m. A beam without a range has no effect.
 * DISTANCE  to the nearest thing, exact to the centres of cells, up to distance_cap_m. It is kept up as cells change:
 *           a new thing at once, a vanished one by a bounded share of work in each call. Queries are exact always.
 * SOURCES   log-odds: Moravec and Elfes 1985; their limits and the hit and miss of 0.7 and 0.4: Hornung and others 2013
 *           (OctoMap). Distances that follow changes: after Lau, Sprunk and Burgard 2013, but exact.
 *           Grids: nav_msgs/OccupancyGrid.
 *
 * Cells lie within POSE_WALL_PLANAR_MAP_REACH_M of the frame's origin. The other rules are those of pose_wall_planar.h.
 */
/* clang-format on */

#ifndef POSE_WALL_PLANAR_MAP_H
#define POSE_WALL_PLANAR_MAP_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall_planar_grid.h"
#include "pose_wall_planar_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pose_wall_planar_map pose_wall_planar_map;

#define POSE_WALL_PLANAR_TILE_SIDE 64
#define POSE_WALL_PLANAR_TILE_CELLS (POSE_WALL_PLANAR_TILE_SIDE * POSE_WALL_PLANAR_TILE_SIDE)
/* Poses and places further than this from the origin of map, in x or y, are refused. */
#define POSE_WALL_PLANAR_MAP_REACH_M 100000.0

/* ---------------------------------------------------------------------------------------------- settings */

/* Which tile goes when another is needed. Never one that the present call has written to. */
enum pose_wall_planar_eviction {
  POSE_WALL_PLANAR_OLDEST = 0,  /* whose last scan is longest ago */
  POSE_WALL_PLANAR_FARTHEST = 1 /* whose middle is farthest from the sensor */
};

typedef struct pose_wall_planar_map_settings {
  uint32_t struct_size; /* sizeof(pose_wall_planar_map_settings) */
  /* A member for each row of the table, which has its default, range, unit and meaning. */
#define POSE_WALL_SETTING(type, name, standard, least, most, unit, help) type name;
#include "pose_wall_planar_map_settings.def"
} pose_wall_planar_map_settings;

/* The defaults. Fails iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_settings_init(pose_wall_planar_map_settings* settings);

/* Fails iff: settings NULL, struct_size, POSE_WALL_E_VALUE_RANGE. In the last case it writes the first fault to *fault
 * (which may be NULL). */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_settings_check(const pose_wall_planar_map_settings* settings,
                                                              pose_wall_planar_fault* fault);

/* ---------------------------------------------------------------------------------------------- life */

/* Bytes of the block: 12.9 kB a tile with distances, 4.7 kB without, and 0.2 MB. settings NULL: the defaults.
 * Fails iff: bytes NULL, settings refused. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_memory_needed(const pose_wall_planar_map_settings* settings,
                                                             uint64_t* bytes);
/* Bytes that are enough with the default settings, for static arrays. Of this version: a later one may need more, and
 * then refuses the block. */
#define POSE_WALL_PLANAR_MAP_BLOCK_MOST 16777216 /* 16 MiB */

/* An empty map in the block, which may hold garbage and must not move. settings NULL: the defaults. Fails iff: block or
 * map NULL, settings refused, block misaligned (POSE_WALL_BLOCK_ALIGNMENT) or too small. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_open(const pose_wall_planar_map_settings* settings, void* block,
                                                    uint64_t block_bytes, pose_wall_planar_map** map);

/* All calls below fail with POSE_WALL_E_NULL, POSE_WALL_E_ENGINE (not an open map) and POSE_WALL_E_BUSY (another call
 * is inside this map, or this call comes from its own callback). Other failures stand beside the call. */

/* Forgets all tiles, without saving them. Settings and callback stay. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_clear(pose_wall_planar_map* map);

/* One tile as it is saved: the cells row by row from the least y. */
typedef struct pose_wall_planar_tile {
  uint32_t struct_size; /* sizeof(pose_wall_planar_tile) */
  uint32_t crc32;       /* CRC-32 (IEEE 802.3) of all bytes behind this member, each number low byte first */
  int32_t column;       /* the tile begins at x = column * 64 * cell_m */
  int32_t row;          /* and at y = row * 64 * cell_m */
  double cell_m;
  int64_t stamp_ns;                           /* of the last scan that wrote to it */
  uint64_t scans;                             /* that wrote to it */
  uint8_t cells[POSE_WALL_PLANAR_TILE_CELLS]; /* 0: never seen; 1 to 127: log-odds of a thing are (cell - 64) / 16 */
} pose_wall_planar_tile;

/* Takes a tile that has to go. 0: saved, the map forgets it. Anything else: refused, the map keeps it; nothing more is
 * offered in this call. The record is the map's and ends with the call. A call into the same map from here is refused
 * (POSE_WALL_E_BUSY). */
typedef int32_t (*pose_wall_planar_save)(void* context, const pose_wall_planar_tile* tile);

/* save NULL: no tile ever goes. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_on_save(pose_wall_planar_map* map, pose_wall_planar_save save,
                                                       void* context);

/* ---------------------------------------------------------------------------------------------- a scan */

typedef struct pose_wall_planar_map_report {
  uint32_t struct_size;      /* sizeof(pose_wall_planar_map_report): set it before the call */
  uint32_t tiles;            /* held now */
  uint32_t tiles_new;        /* begun by this call */
  uint32_t tiles_saved;      /* given to the callback and forgotten */
  uint32_t saves_refused;    /* 1: the callback refused, or there is none, and a tile was needed */
  uint32_t beams_not_stored; /* beams some of whose cells had no tile: nothing of these cells is in the map */
  uint32_t things_new;       /* cells that became a thing */
  uint32_t things_gone;      /* cells that are a thing no more */
  uint32_t tiles_stale;      /* whose distances wait to be renewed; 0: all are up to date */
  uint32_t reserved;         /* 0 */
} pose_wall_planar_map_report;

/* Adds a scan that was taken with base at this pose in map. Fails iff: struct_size, POSE_WALL_PLANAR_E_SCAN, and
 * POSE_WALL_PLANAR_E_POSE for a pose that is not finite or outside the reach (yaw: within 10,000 rad). The map and the
 * report are then unchanged. Cost: for 720 beams in a road 5 m wide 0.4 ms; at most beams
 * x beam_max_m / cell_m cells, the renewal of settings.renewals tiles, and a save for each tile held. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_insert(pose_wall_planar_map* map, const pose_wall_planar_scan* scan,
                                                      const pose_wall_planar_pose* base,
                                                      pose_wall_planar_map_report* report);

/* Renews the distances of up to `most` tiles; *stale is how many then wait. stale may be NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_renew(pose_wall_planar_map* map, uint32_t most, uint32_t* stale);

/* ---------------------------------------------------------------------------------------------- queries */

enum pose_wall_planar_cell_state {
  POSE_WALL_PLANAR_CELL_UNKNOWN = 0, /* never seen, or between the two thresholds */
  POSE_WALL_PLANAR_CELL_FREE = 1,
  POSE_WALL_PLANAR_CELL_THING = 2
};

typedef struct pose_wall_planar_cell {
  uint32_t struct_size; /* sizeof(pose_wall_planar_cell) */
  uint32_t state;       /* pose_wall_planar_cell_state */
  double probability;   /* of a thing; NaN: never seen */
  double distance_m;    /* from the cell's middle to that of the nearest thing, at most distance_cap_m (in whole
                           cells); NaN without distances */
} pose_wall_planar_cell;

/* The cell that holds a place. Set cell->struct_size first. Fails iff: struct_size, POSE_WALL_PLANAR_E_POSE. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_cell(const pose_wall_planar_map* map, double x_m, double y_m,
                                                    pose_wall_planar_cell* cell);

enum pose_wall_planar_ray_end {
  POSE_WALL_PLANAR_RAY_UNKNOWN = 0, /* met a cell that is not known to be free */
  POSE_WALL_PLANAR_RAY_OPEN = 1,    /* all free up to range_max_m */
  POSE_WALL_PLANAR_RAY_THING = 2
};

typedef struct pose_wall_planar_ray {
  uint32_t struct_size; /* sizeof(pose_wall_planar_ray) */
  uint32_t end;         /* pose_wall_planar_ray_end */
  double range_m;       /* to the middle of the ray's way through the cell that ended it; range_max_m if open */
} pose_wall_planar_ray;

/* What a beam from this pose would meet: along yaw + angle, up to range_max_m (0 to 1000). through_unknown 0: the first
 * cell that is not free ends it; else only things do. Fails iff: struct_size, POSE_WALL_PLANAR_E_POSE (also for angle),
 * POSE_WALL_E_VALUE_RANGE. Cost: some 3 ns a cell. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_ray(const pose_wall_planar_map* map, const pose_wall_planar_pose* from,
                                                   double angle_rad, double range_max_m, uint32_t through_unknown,
                                                   pose_wall_planar_ray* ray);

typedef struct pose_wall_planar_box {
  uint32_t struct_size; /* sizeof(pose_wall_planar_box) */
  uint32_t tiles;       /* held */
  uint32_t tiles_stale; /* whose distances wait to be renewed */
  uint32_t reserved;    /* 0 */
  uint64_t cells_seen;
  uint64_t things;
  double x_min_m, y_min_m; /* corners about all cells that were seen; NaN: none */
  double x_max_m, y_max_m;
} pose_wall_planar_box;

/* What the map holds. Reads every cell. Set box->struct_size first. Fails iff: struct_size. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_box(const pose_wall_planar_map* map, pose_wall_planar_box* box);

/* Writes width x height cells into the caller's `cells`: -1 never seen, else the probability of a thing in per cent.
 * The first is the one that holds (x_m, y_m). *grid then describes them, with cells in it. Set grid->struct_size first.
 * Fails iff: struct_size, POSE_WALL_PLANAR_E_POSE, POSE_WALL_PLANAR_E_GRID (width or height 0 or above
 * POSE_WALL_PLANAR_GRID_SIDE_MAX), POSE_WALL_E_BUFFER_SMALL (capacity). */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_grid(const pose_wall_planar_map* map, double x_m, double y_m,
                                                    uint32_t width, uint32_t height, int8_t* cells, uint64_t capacity,
                                                    pose_wall_planar_grid* grid);

/* ---------------------------------------------------------------------------------------------- save and load */

/* Adds a saved tile. Where the map has the tile already, the evidence of both is added, so put back only what was
 * forgotten. Fails iff: struct_size, POSE_WALL_PLANAR_E_MAP_FILE (CRC, cells, place, another cell_m),
 * POSE_WALL_E_BUFFER_SMALL (no tile left and none could be saved). The map is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_put_tile(pose_wall_planar_map* map, const pose_wall_planar_tile* tile);

/* Copies tile number `index` (0 to tiles - 1; by rows, then columns) without forgetting it. Set tile->struct_size
 * first. Fails iff: struct_size, POSE_WALL_E_INDEX. Cost: each call sorts the tiles. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_get_tile(pose_wall_planar_map* map, uint32_t index,
                                                        pose_wall_planar_tile* tile);

/* Bytes that pose_wall_planar_map_save writes now: 48 + 4,120 a tile. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_save_bytes(const pose_wall_planar_map* map, uint64_t* bytes);

/* Writes all tiles, by rows and columns, with magic, version, sizes and CRC-32, low bytes first on every machine.
 * Fails iff: POSE_WALL_E_BUFFER_SMALL. *written may be NULL. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_save_all(pose_wall_planar_map* map, void* bytes, uint64_t capacity,
                                                        uint64_t* written);

/* Forgets what the map holds and takes what was saved. Distances are renewed at once. Fails iff:
 * POSE_WALL_PLANAR_E_MAP_FILE (anything that pose_wall_planar_map_save_all did not write, or another cell_m),
 * POSE_WALL_E_BUFFER_SMALL (more tiles than settings.tiles). The map is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_planar_map_load_all(pose_wall_planar_map* map, const void* bytes, uint64_t size);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_PLANAR_MAP_H */

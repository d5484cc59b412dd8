/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * The black box: what went into the engine and what came out of it, as a ring of records in one file. Every record
 * carries what the engine remembered before it (pose_wall_save), so each can be computed again without the others: old
 * ones may be overwritten, damaged ones passed over. In libpose_wall_runtime.a; reads memory, opens no file.
 *
 * FILE. Little-endian throughout; all offsets are multiples of 64. Bytes 0 to 4095 are the header:
 *
 *       0  8 bytes  "PWALLBOX"
 *       8  u32      format version, POSE_WALL_BOX_VERSION
 *      12  u32      bytes of this header, 4096
 *      16  u64      bytes of the file at most (the ring ends there)
 *      24  u32      sizeof(pose_wall_config)        28  u32  sizeof(pose_wall_result)
 *      32  u32      pose_wall_memento_bytes()       36  u32  POSE_WALL_ABI_VERSION
 *      40  24 bytes pose_wall_version(), zeros behind
 *      64           the config, as in memory; zeros behind
 *    4076  u32      sizeof(pose_wall_motion_result)
 *    4080  u32      sizeof(pose_wall_inputs)
 *    4084  u32      number of the run: the start that wrote this header; never 0
 *    4088  u32      pose_wall_config_crc() of the config
 *    4092  u32      CRC-32 of bytes 0 to 4091
 *
 * From byte 4096 on records follow each other. One that does not fit before the end of the ring begins at 4096 again
 * and overwrites the oldest. A record is a multiple of 64 bytes:
 *
 *       0  u32  sync, "PWRC"                         4  u32  kind, pose_wall_box_kind
 *       8  u64  bytes of the record                 16  u64  sequence: counts events from 0; a gap is what was not
 *      24  i64  received_ns, see                             recorded or was lost
 *               pose_wall_publication               32  i64  stamp of the frame, or that was asked for
 *      40  u64  bytes of the cloud in the record    48  u32  thinning
 *      52  u32  CRC-32 of everything behind byte 64 56  u16  number of the run, as in its header
 *      58  u16  lap of the ring: 0 in the run's      60  u32  CRC-32 of bytes 0 to 59
 *               first, then 1 to 65535, 1 ...
 *      64       cloud's description, 128 bytes:      0  u64  digest of the cloud's bytes (FNV-1a, 64 bits)
 *               8 u32 points    12 u32 bytes of a point    16 u32 big_endian    20 u32 left out: not finite
 *              24 u32 left out: zero                28  u32 CRC-32 of the config, as in its header
 *              32  x, y, z, intensity, time, ring: u32 offset, u32 type each; zeros behind
 *     192       inputs of the frame as the engine got them, with the runtime's odometry: a pose_wall_inputs as in
 *               memory; all zero: none
 *               then, each with zeros behind it up to the next multiple of 64:
 *               memento before the event
 *               result as published
 *               motion as published, a pose_wall_motion_result; all zero: none
 *               the cloud's points
 *
 * The head is written last, so a record that was cut off by a crash has none, or an old one whose body's CRC (at 52) no
 * longer holds. A loss of power is another matter: what the sink did not bring onto the disk by then is lost, in parts
 * of any place and order.
 *
 * The header is there once, and the config with it: whoever loses a byte of it cannot compute the box. The results as
 * published can then still be read, record by record. Every start writes its header over the last one's; records of
 * earlier runs remain behind the new ones until they are overwritten, and tell themselves apart by run and config. A
 * lap's number tells the newest records and the lap before, which follow on each other without a gap, from older
 * ones that a longer lap left behind the point where the later ones ended.
 *
 * CRC-32 is that of zlib and Ethernet (reflected 0xEDB88320). It finds accidents; it is no signature.
 */
/* clang-format on */

#ifndef POSE_WALL_BOX_H
#define POSE_WALL_BOX_H

#include <stddef.h>
#include <stdint.h>

#include "pose_wall.h"
#include "pose_wall_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

#define POSE_WALL_BOX_VERSION 3
#define POSE_WALL_BOX_HEADER_BYTES 4096

/* Up to POSE_WALL_RUNTIME_ABI_VERSION 2 these were -80 to -85, which pose_wall.h has taken since. */
enum pose_wall_box_status {
  POSE_WALL_BOX_E_FORMAT = -90,  /* no black box, or its header is damaged */
  POSE_WALL_BOX_E_VERSION = -91, /* of a build whose structs differ from this one's */
  POSE_WALL_BOX_E_END = -92,     /* no further record */
  POSE_WALL_BOX_E_EMPTY = -93,   /* the record holds a digest only: nothing to compute */
  POSE_WALL_BOX_E_RUN = -94,     /* the record is POSE_WALL_BOX_OTHER_RUN */
  POSE_WALL_BOX_E_KIND = -95     /* the record is of no pose_wall_box_kind */
};

enum pose_wall_box_kind {
  POSE_WALL_BOX_FRAME = 1,  /* pose_wall_process */
  POSE_WALL_BOX_SILENCE = 2 /* pose_wall_age */
};

/* Of pose_wall_box_record.damaged: anything but 0 is nothing to compute. */
enum pose_wall_box_damage {
  POSE_WALL_BOX_WHOLE = 0,
  POSE_WALL_BOX_DAMAGED = 1,    /* head whole, but the rest is not what was written or is cut off: of the members only
                                   those from the head hold: sequence, received_ns, stamp_ns, kind, thinning */
  POSE_WALL_BOX_OVERLAPPED = 2, /* as DAMAGED, and heads of further records lie within its bytes: see box_next */
  POSE_WALL_BOX_OTHER_RUN = 3   /* whole, every member holds, but it is of another run or config than the header: its
                                   sequence counts that run's events, and the box's config is not its own */
};

typedef struct pose_wall_box_info {
  pose_wall_config config;
  char version[24]; /* of the library that wrote it, zero-terminated */
  uint64_t box_bytes;
} pose_wall_box_info;

/* Reads the header. Fails iff: NULL, POSE_WALL_BOX_E_FORMAT, POSE_WALL_BOX_E_VERSION; *info is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_box_open_3(const void* bytes, uint64_t count, pose_wall_box_info* info);
/* What programs built against formats 1 and 2 call first: they write nothing, and always give POSE_WALL_E_ABI. */
POSE_WALL_CHECKED int32_t pose_wall_box_open(const void* bytes, uint64_t count, pose_wall_box_info* info);
POSE_WALL_CHECKED int32_t pose_wall_box_open_2(const void* bytes, uint64_t count, pose_wall_box_info* info);
#define pose_wall_box_open pose_wall_box_open_3

/* Of a box of any format: which one, and which library wrote it; for who says why POSE_WALL_BOX_E_VERSION. Fails iff:
 * NULL, POSE_WALL_BOX_E_FORMAT; both are then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_box_written_by(const void* bytes, uint64_t count, uint32_t* format,
                                                   char version[24]);

/* One record. The pointers point into the caller's bytes. */
typedef struct pose_wall_box_record {
  uint64_t offset; /* of its head */
  uint64_t sequence;
  int64_t received_ns;
  int64_t stamp_ns;
  uint64_t digest;
  uint64_t passed_over; /* bytes between the record before, or the search's start, and this one that are none */
  const void* memento;
  const void* result; /* a pose_wall_result; copy it out, it may be misaligned for the machine */
  const void* points; /* NULL: the digest only */
  const void* inputs; /* a pose_wall_inputs, may be misaligned, too; NULL: none were given */
  const void* motion; /* a pose_wall_motion_result, likewise; NULL: none */
  pose_wall_field x, y, z, intensity, time, ring;
  uint32_t kind;    /* pose_wall_box_kind */
  uint32_t damaged; /* pose_wall_box_damage */
  uint32_t thinning;
  uint32_t point_count;
  uint32_t point_bytes;
  uint32_t big_endian;
  uint32_t left_out_not_finite;
  uint32_t left_out_zero;
} pose_wall_box_record;

/* The next record at or behind *offset (begin with POSE_WALL_BOX_HEADER_BYTES), in the order of the file, which is not
 * that of the sequence once the ring has come round. Moves *offset behind it, also behind a damaged one where its head
 * says that it ends (a cut off one: behind its head). Whatever the bytes are, it reads none outside of them, and all
 * calls together take time in proportion to their count. Further records may lie within the bytes of one that is
 * OVERLAPPED, when the disk lost parts of what was written, or somebody forged it: they are found from
 * record->offset + 64 on, at the price of reading these bytes again, which forged ones can make the caller do for every
 * 64 bytes. At the end POSE_WALL_BOX_E_END, with passed_over set. Fails else iff: NULL. */
POSE_WALL_CHECKED int32_t pose_wall_box_next(const void* bytes, uint64_t count, uint64_t* offset,
                                             pose_wall_box_record* record);

/* Computes a record again, on an engine that was opened with the box's config: loads the memento, does what was done
 * with the inputs that were given, and gives the result as the runtime published it (stage_ns apart: there is no
 * clock). Set result->struct_size first. Fails iff: NULL, POSE_WALL_BOX_E_EMPTY, _RUN or _KIND, as pose_wall_load, and
 * as pose_wall_process or pose_wall_age: for these two the engine has loaded the memento already. */
POSE_WALL_CHECKED int32_t pose_wall_box_compute(const pose_wall_box_record* record, pose_wall_engine* engine,
                                                pose_wall_result* result);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_BOX_H */

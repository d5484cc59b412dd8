/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* clang-format off */
/*
 * The black box: the engine's inputs and outputs as a ring of records in one file. Every record carries the engine's
 * memory before it (pose_wall_save). So each can be computed again without the others: old records may be overwritten,
 * damaged ones skipped. In libpose_wall_runtime.a; reads memory, opens no file.
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
 * The head is written last. So a record cut off by a crash has no head, or an old one whose CRC of the body (at 52)
 * no longer holds. A loss of power is different: all bytes that the sink did not bring onto the disk are lost, at any
 * place and in any order.
 *
 * The file has one header, with the config in it. If a byte of it is lost, the box cannot be computed. The published
 * results can then still be read, record by record. Every start writes its header over the last one's. Records of
 * earlier runs remain behind the new ones until they are overwritten; run and config distinguish them. The newest
 * records and the lap before follow each other without a gap. The number of the lap distinguishes them from older
 * records of a longer lap, which remain behind the end of the later laps.
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
  POSE_WALL_BOX_DAMAGED = 1,    /* head whole, but the rest is changed or cut off. Only the members from the head hold:
                                   sequence, received_ns, stamp_ns, kind, thinning */
  POSE_WALL_BOX_OVERLAPPED = 2, /* as DAMAGED, and heads of further records lie within its bytes: see box_next */
  POSE_WALL_BOX_OTHER_RUN = 3 /* whole, every member holds, but from another run or config than the header: its sequence
                                 counts that run's events, and the box's config is not its own */
};

typedef struct pose_wall_box_info {
  pose_wall_config config;
  char version[24]; /* of the library that wrote it, zero-terminated */
  uint64_t box_bytes;
} pose_wall_box_info;

/* Reads the header. Fails iff: NULL, POSE_WALL_BOX_E_FORMAT, POSE_WALL_BOX_E_VERSION; *info is then unchanged. */
POSE_WALL_CHECKED int32_t pose_wall_box_open_3(const void* bytes, uint64_t count, pose_wall_box_info* info);
/* The names that programs built against formats 1 and 2 call: they write nothing and always return POSE_WALL_E_ABI. */
POSE_WALL_CHECKED int32_t pose_wall_box_open(const void* bytes, uint64_t count, pose_wall_box_info* info);
POSE_WALL_CHECKED int32_t pose_wall_box_open_2(const void* bytes, uint64_t count, pose_wall_box_info* info);
#define pose_wall_box_open pose_wall_box_open_3

/* The format of any box, and the version of the library that wrote it: to explain POSE_WALL_BOX_E_VERSION. Fails iff:
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
  uint64_t passed_over; /* bytes that belong to no record, since the record before or the start of the search */
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

/* The next record at or behind *offset (begin with POSE_WALL_BOX_HEADER_BYTES), in the order of the file. That is not
 * the order of the sequence once the ring has wrapped. Moves *offset behind the record. Behind a damaged one it moves
 * to the end that its head names; behind a cut off one, to the end of the head. Whatever the bytes are, the call reads
 * none outside of them, and all calls together take time in proportion to their count. At the end returns
 * POSE_WALL_BOX_E_END, with passed_over set. Fails else iff: NULL. Further records may lie within the bytes of an
 * OVERLAPPED one, when the disk lost parts of the file or somebody forged it. A search from record->offset + 64 on
 * finds them, and reads these bytes again. Forged bytes can force that every 64 bytes. */
POSE_WALL_CHECKED int32_t pose_wall_box_next(const void* bytes, uint64_t count, uint64_t* offset,
                                             pose_wall_box_record* record);

/* Computes a record again, on an engine that was opened with the box's config. Loads the memento, repeats the call with
 * the recorded inputs, and gives the published result (except stage_ns: there is no clock). Set result->struct_size
 * first. Fails iff: NULL, POSE_WALL_BOX_E_EMPTY, _RUN or _KIND, as pose_wall_load, and as pose_wall_process or
 * pose_wall_age. In the last two cases the engine has already loaded the memento. */
POSE_WALL_CHECKED int32_t pose_wall_box_compute(const pose_wall_box_record* record, pose_wall_engine* engine,
                                                pose_wall_result* result);

#ifdef __cplusplus
}
#endif

#endif /* POSE_WALL_BOX_H */

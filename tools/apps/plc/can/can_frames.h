/* SPDX-License-Identifier: BSD-3-Clause
 * Copyright (c) 2026 the pose_wall authors
 *
 * Process images as frames of CAN: plain ones of 11 bits, or those of SAE J1939 (29 bits). C99, with the public headers
 * and, for the checks of the images, the libraries of engine, motion and planar. pose_walld sends these frames, and so
 * may you. README.md beside it is the manual of the bytes.
 */
#ifndef POSE_WALL_CAN_FRAMES_H
#define POSE_WALL_CAN_FRAMES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define POSE_WALL_CAN_NUMBERS 64 /* of frames: each has an identifier, or a PGN, of its own */
/* CiA 301, 7.3.5: CANopen restricts 601h to 67Fh (SDO) and 6E0h to 6FFh; what lies between is free. */
#define POSE_WALL_CAN_FIRST_ID 0x680
/* SAE J1939-21: PGNs FF00h to FFFFh are proprietary B, to all. */
#define POSE_WALL_CAN_FIRST_PGN 0xFF00
/* SAE J1939-81: addresses 128 to 247 are for whoever configures himself. */
#define POSE_WALL_CAN_ADDRESS 128

/* On which identifiers frames go. The frame of number n has `first` + n. */
typedef struct pose_wall_can_bus {
  uint32_t is_j1939; /* 0: identifiers of 11 bits */
  uint32_t first;    /* identifier of number 0 (0 to 7BFh), or its PGN (FF00h to FFC0h) */
  uint32_t address;  /* J1939: the sender's, 0 to 253 */
} pose_wall_can_bus;

typedef struct pose_wall_can_frame {
  uint32_t id;      /* of 11 or 29 bits */
  uint32_t is_long; /* 1: of 29 bits */
  uint8_t data[8];
} pose_wall_can_frame;

/* How a word of an image becomes a signal: as can.def has it. */
enum pose_wall_can_how { POSE_WALL_CAN_BITS, POSE_WALL_CAN_LIMIT, POSE_WALL_CAN_SIGNED, POSE_WALL_CAN_LEVEL };

typedef struct pose_wall_can_signal {
  uint8_t number, priority; /* of the frame; signals of one frame follow each other */
  uint8_t word;             /* of the image */
  uint8_t how;              /* pose_wall_can_how */
  uint8_t start, bits;      /* in the frame */
} pose_wall_can_signal;

/* 1 where all numbers have an identifier on the bus. */
uint32_t pose_wall_can_bus_is_sound(const pose_wall_can_bus* bus);

/* What the functions of can_images.h are made of. Returns how many frames it wrote. */
uint32_t pose_wall_can_pack(const void* image, uint32_t counter_word, const pose_wall_can_signal* signals,
                            uint32_t count, const pose_wall_can_bus* bus, pose_wall_can_frame* frames);

/* Of a frame: AUTOSAR's CRC8H2F (polynomial 2Fh, begun and ended with FFh; "123456789" gives DFh) over its number, then
 * its bytes 1 to 7. Byte 0 must equal it. */
uint8_t pose_wall_can_crc8(uint8_t number, const uint8_t data[8]);

/* What a controller commands its drive, in one frame that pose_walld reads: bytes 2 and 3 are the speed, 4 and 5 the
 * turn, each 16 bits with a sign, the low byte first. Bytes 6 and 7 are 0. The CRC is of number 7. */
#define POSE_WALL_CAN_COMMAND_NUMBER 7
typedef struct pose_wall_can_command {
  uint32_t counter;    /* 0 to 255: another one for each command */
  int32_t speed_mm_s;  /* along forward_axis; negative: backwards */
  int32_t turn_mrad_s; /* positive: to the left */
} pose_wall_can_command;

/* Returns 0, and writes nothing, for numbers that do not fit. */
uint32_t pose_wall_can_write_command(const pose_wall_can_command* command, uint8_t data[8]);
/* Returns 0, and writes nothing, where the CRC is wrong or bytes 6 and 7 are not 0. */
uint32_t pose_wall_can_read_command(const uint8_t data[8], pose_wall_can_command* command);

#ifdef __cplusplus
}
#endif

#endif

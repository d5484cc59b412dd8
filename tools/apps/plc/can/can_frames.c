/* SPDX-License-Identifier: BSD-3-Clause
 * Copyright (c) 2026 the pose_wall authors */

#include "can_frames.h"

#include <string.h>

enum {
  kFrameBytes = 8,     /* of classic CAN (ISO 11898-1) */
  kIdMost = 0x7FF,     /* of 11 bits */
  kPgnMost = 0xFFFF,   /* proprietary B, SAE J1939-21 */
  kAddressMost = 253,  /* 254 is nobody, 255 everybody (SAE J1939-81) */
  kPolynomial = 0x2F,  /* CRC8H2F of AUTOSAR_SWS_CRCLibrary; finds any 3 flipped bits in 72 */
  kCrcBegin = 0xFF,    /* likewise */
  kPriorityShift = 26, /* in an identifier of 29 bits: priority, PGN, address (SAE J1939-21) */
  kPgnShift = 8
};

uint32_t pose_wall_can_bus_is_sound(const pose_wall_can_bus* bus) {
  if (!bus->is_j1939) return bus->first <= kIdMost - (POSE_WALL_CAN_NUMBERS - 1);
  return bus->first >= POSE_WALL_CAN_FIRST_PGN && bus->first <= kPgnMost - (POSE_WALL_CAN_NUMBERS - 1) &&
         bus->address <= kAddressMost;
}

static uint8_t crc8_with(uint8_t crc, uint8_t byte) {
  int bit;
  crc = (uint8_t)(crc ^ byte);
  for (bit = 0; bit < 8; ++bit) crc = (uint8_t)((unsigned)crc << 1U ^ (crc & 0x80U ? kPolynomial : 0U));
  return crc;
}

uint8_t pose_wall_can_crc8(uint8_t number, const uint8_t data[8]) {
  uint8_t crc = crc8_with(kCrcBegin, number);
  int i;
  for (i = 1; i < kFrameBytes; ++i) crc = crc8_with(crc, data[i]);
  return (uint8_t)(crc ^ kCrcBegin);
}

static uint32_t word_at(const void* image, uint32_t word) {
  uint32_t value;
  memcpy(&value, (const unsigned char*)image + word * sizeof(value), sizeof(value));
  return value;
}

/* A number that does not fit must not pass for another one: a value becomes none, a level unbounded. */
static uint32_t signal_of(uint32_t word, uint32_t how, uint32_t bits) {
  const uint32_t ones = bits < 32 ? (1U << bits) - 1U : 0xFFFFFFFFU;
  const int64_t number = word < 0x80000000U ? (int64_t)word : (int64_t)word - 0x100000000LL;
  const int64_t most = (int64_t)(ones >> 1U);
  switch (how) {
    case POSE_WALL_CAN_BITS:
      return word & ones;
    case POSE_WALL_CAN_LIMIT:
      return word < ones ? word : ones;
    case POSE_WALL_CAN_SIGNED:
      return number >= -most && number <= most ? word & ones : ones - (ones >> 1U);
    default: /* POSE_WALL_CAN_LEVEL */
      return number >= 0 && number < (int64_t)ones ? word : ones;
  }
}

static uint32_t id_of(const pose_wall_can_bus* bus, uint32_t number, uint32_t priority) {
  const uint32_t own = bus->first + number;
  return bus->is_j1939 ? priority << kPriorityShift | own << kPgnShift | bus->address : own;
}

uint32_t pose_wall_can_pack(const void* image, uint32_t counter_word, const pose_wall_can_signal* signals,
                            uint32_t count, const pose_wall_can_bus* bus, pose_wall_can_frame* frames) {
  uint32_t written = 0, i = 0;
  while (i < count) {
    pose_wall_can_frame* frame = frames + written++;
    const uint8_t number = signals[i].number;
    uint64_t bits = (uint64_t)(word_at(image, counter_word) & 0xFFU) << 8U;
    int byte;
    frame->id = id_of(bus, number, signals[i].priority);
    frame->is_long = bus->is_j1939 ? 1 : 0;
    for (; i < count && signals[i].number == number; ++i) {
      bits |= (uint64_t)signal_of(word_at(image, signals[i].word), signals[i].how, signals[i].bits) << signals[i].start;
    }
    for (byte = 0; byte < kFrameBytes; ++byte) frame->data[byte] = (uint8_t)(bits >> 8 * byte & 0xFFU);
    frame->data[0] = pose_wall_can_crc8(number, frame->data);
  }
  return written;
}

static int32_t signed_16_of(uint8_t low, uint8_t high) {
  const int32_t word = (int32_t)low | (int32_t)high << 8;
  return word < 0x8000 ? word : word - 0x10000;
}

static int fits_16(int32_t number) {
  return number >= -0x8000 && number < 0x8000;
}

uint32_t pose_wall_can_write_command(const pose_wall_can_command* command, uint8_t data[8]) {
  uint32_t speed, turn;
  if (!command || !data || command->counter > 0xFFU) return 0;
  if (!fits_16(command->speed_mm_s) || !fits_16(command->turn_mrad_s)) return 0;
  speed = (uint32_t)command->speed_mm_s;
  turn = (uint32_t)command->turn_mrad_s;
  memset(data, 0, kFrameBytes);
  data[1] = (uint8_t)command->counter;
  data[2] = (uint8_t)(speed & 0xFFU), data[3] = (uint8_t)(speed >> 8U & 0xFFU);
  data[4] = (uint8_t)(turn & 0xFFU), data[5] = (uint8_t)(turn >> 8U & 0xFFU);
  data[0] = pose_wall_can_crc8(POSE_WALL_CAN_COMMAND_NUMBER, data);
  return 1;
}

uint32_t pose_wall_can_read_command(const uint8_t data[8], pose_wall_can_command* command) {
  if (!data || !command || data[6] != 0 || data[7] != 0) return 0;
  if (data[0] != pose_wall_can_crc8(POSE_WALL_CAN_COMMAND_NUMBER, data)) return 0;
  command->counter = data[1];
  command->speed_mm_s = signed_16_of(data[2], data[3]);
  command->turn_mrad_s = signed_16_of(data[4], data[5]);
  return 1;
}

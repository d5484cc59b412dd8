/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* The orders of bytes in which a bus may deliver a word: 1 as it is, 2 to 4 with its bytes or halves exchanged. */

#ifndef PLC_ORDER_OF_WORDS_H
#define PLC_ORDER_OF_WORDS_H

#include <stdint.h>

static uint32_t swapped(uint32_t word, int order) {
  if (order == 2 || order == 4) word = (word & 0x00FF00FFu) << 8 | (word >> 8 & 0x00FF00FFu);
  if (order == 2 || order == 3) word = word << 16 | word >> 16;
  return word;
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* What FB_PoseWallStop is connected to: a stop that answers every 20 ms, and a fieldbus that loses, delays, tears and
 * repeats. All by one seed. */

#ifndef PLC_STOP_WORLD_H
#define PLC_STOP_WORLD_H

#include <string.h>

#include "order_of_words.h"
#include "pose_wall_planar_stop.h"

#define ANSWER_MS 20
#define WATCHDOG_MS 200
#define AGE_MS 500
#define WORDS 62 /* of the block's array */
#define IMAGE_WORDS (POSE_WALL_PLANAR_STOP_IMAGE_BYTES / 4)
#define RING 64
#define KEPT 256 /* images that may come back: rings of every fourth one */
#define SETTINGS 0xC0FFEEu

/* Faults that go on for a while; each has its own clock. */
enum fault {
  STUCK,      /* the bus shows what it showed */
  IN_TURN,    /* a ring of old images */
  ANY_OLD,    /* old images in any order */
  QUEUE,      /* images in their order, from now on or from long ago, slower than they are made */
  HANGS,      /* nobody answers */
  BLIND,      /* no frames; half of the stops do not mind */
  WORD,       /* states that are none, speeds that are none */
  SAME,       /* other states under the same heartbeat, worse and better */
  SETTINGS_2, /* a stop of other settings answers */
  TORN,       /* half an image */
  FLIPPED,    /* some bits are turned */
  GARBAGE,    /* random words */
  PARAMETERS, /* times and numbers at the ends of their types */
  CONFIRMED,  /* a person confirms a restart, needed or not, but not while a queue is there */
  FAULTS
};

struct image {
  uint32_t words[IMAGE_WORDS];
  uint32_t heartbeat;
  int approved;
  int32_t state, speed;
  int64_t made_ms, frame_ms;
};

struct world {
  uint64_t random;
  int32_t cycle_ms;
  int64_t now_ms, next_ms, frame_ms, until_ms[FAULTS];
  uint32_t heartbeat;
  int32_t state, speed;
  struct image kept[KEPT]; /* [0]: the newest */
  struct image ring[RING];
  int ring_size, turn, minds, order;
  int64_t waiting; /* images in the queue */
  uint32_t bus[WORDS];
  int whole; /* what lies there is undamaged: */
  struct image seen;
};

static uint32_t below(struct world* w, uint32_t count) {
  w->random = w->random * 6364136223846793005ULL + 1442695040888963407ULL;
  return (uint32_t)((w->random >> 33) % count);
}
static int once_in(struct world* w, uint32_t count) {
  return below(w, count) == 0;
}
static int on(const struct world* w, enum fault fault) {
  return w->now_ms < w->until_ms[fault];
}

/* By bits, as no table of the block does it. */
static uint32_t castagnoli(const uint32_t* words) {
  uint32_t crc = 0xFFFFFFFFu;
  for (uint32_t i = 0; i < IMAGE_WORDS; ++i) {
    if (i == 2) continue;
    crc ^= words[i];
    for (int bit = 0; bit < 32; ++bit) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0x82F63B78u : 0u);
  }
  return ~crc;
}

/* The clock of the answers goes on by ANSWER_MS a beat. */
static void write_words_at(uint32_t* words, uint32_t heartbeat, int32_t state, int32_t speed, uint32_t age_ms,
                           uint32_t settings, uint32_t answered_ms) {
  pose_wall_planar_stop_image i;
  memset(&i, 0, sizeof i);
  i.struct_size = sizeof i;
  i.version = POSE_WALL_PLANAR_STOP_IMAGE_VERSION;
  i.heartbeat = heartbeat;
  i.settings_crc32 = settings;
  i.state = (uint32_t)state;
  i.allowed_speed_mm_s = speed;
  i.age_ms = age_ms;
  i.answered_ms = answered_ms;
  memcpy(words, &i, sizeof i);
  words[2] = castagnoli(words);
}
static inline void write_words(uint32_t* words, uint32_t heartbeat, int32_t state, int32_t speed, uint32_t age_ms,
                               uint32_t settings) {
  write_words_at(words, heartbeat, state, speed, age_ms, settings, heartbeat * ANSWER_MS);
}

static void keep(struct world* w, int32_t state, int32_t speed) {
  struct image next;
  memset(&next, 0, sizeof next);
  next.heartbeat = w->heartbeat;
  next.approved = !on(w, SETTINGS_2);
  next.state = state, next.speed = speed;
  next.made_ms = w->next_ms, next.frame_ms = w->frame_ms;
  write_words_at(next.words, next.heartbeat, state, speed, (uint32_t)(w->next_ms - w->frame_ms),
                 next.approved ? SETTINGS : SETTINGS + 1, (uint32_t)w->next_ms);
  memmove(&w->kept[1], &w->kept[0], sizeof w->kept[0] * (KEPT - 1));
  w->kept[0] = next;
  ++w->waiting;
}

static void answer(struct world* w) {
  if (on(w, HANGS)) return;
  const int64_t period_ms = 100;
  if (!on(w, BLIND) && w->next_ms - w->frame_ms >= period_ms) w->frame_ms = w->next_ms - (int64_t)below(w, 30);
  if (once_in(w, 60)) {
    w->state = (int32_t)below(w, 4);
    if (w->state == 3) w->state = 2;
    w->speed = w->state == 0 ? 0 : 1 + (int32_t)below(w, 2000);
  }
  int32_t state = w->state, speed = w->speed;
  if (w->minds && w->next_ms - w->frame_ms > 250) state = speed = 0;
  if (on(w, WORD) && once_in(w, 3)) state = 3 + (int32_t)below(w, 2000000000u);
  if (on(w, WORD) && once_in(w, 3)) speed = 0 - (int32_t)below(w, 3) * (int32_t)below(w, 1000000000u);
  if (on(w, SAME)) {
    if (once_in(w, 2)) state = (int32_t)below(w, 3), speed = state == 0 ? 0 : 1 + (int32_t)below(w, 2000);
  } else {
    ++w->heartbeat;
  }
  keep(w, state, speed);
}

static void damage(struct world* w, uint32_t* words) {
  if (on(w, TORN)) {
    const uint32_t at = below(w, IMAGE_WORDS);
    memcpy(words + at, w->kept[1 + below(w, 8)].words + at, (IMAGE_WORDS - at) * 4);
  }
  if (on(w, FLIPPED)) {
    for (uint32_t i = 0; i <= below(w, 8); ++i) words[below(w, IMAGE_WORDS)] ^= 1u << below(w, 32);
  }
  if (on(w, GARBAGE)) {
    for (int i = 0; i < IMAGE_WORDS; ++i) words[i] = below(w, 65536) << 16 | below(w, 65536);
    words[0] = once_in(w, 2) ? POSE_WALL_PLANAR_STOP_IMAGE_BYTES : words[0], words[1] = 4;
  }
}

/* Which image the bus has. */
static const struct image* brought(struct world* w) {
  if (on(w, IN_TURN)) return &w->ring[w->turn++ % w->ring_size];
  if (on(w, ANY_OLD)) return &w->kept[below(w, KEPT)];
  if (on(w, QUEUE)) {
    w->waiting -= 1 + (int64_t)below(w, 3);
    if (w->waiting < 0) w->waiting = 0;
    if (w->waiting >= KEPT) w->waiting = KEPT - 1;
    return &w->kept[w->waiting];
  }
  w->waiting = 0;
  return &w->kept[0];
}

/* What lies at the controller's input in this cycle. */
static void transport(struct world* w) {
  if (on(w, STUCK)) return;
  const struct image* from = brought(w);
  uint32_t words[IMAGE_WORDS];
  memcpy(words, from->words, sizeof words);
  damage(w, words);
  w->whole = 0;
  for (int i = KEPT + RING - 1; i >= 0; --i) {
    const struct image* made = i < KEPT ? &w->kept[i] : &w->ring[i - KEPT];
    if (memcmp(words, made->words, sizeof words) != 0) continue;
    w->whole = 1;
    w->seen = *made;
  }
  for (int i = 0; i < WORDS; ++i) w->bus[i] = i < IMAGE_WORDS ? swapped(words[i], w->order) : below(w, 65536);
}

static void begin_ring(struct world* w) {
  const uint32_t apart = 1 + below(w, KEPT / RING);
  w->ring_size = 2 + (int)below(w, RING - 1);
  w->turn = 0;
  for (int i = 0; i < w->ring_size; ++i) w->ring[i] = w->kept[(uint32_t)(w->ring_size - 1 - i) * apart];
}

static void begin_faults(struct world* w) {
  static const uint32_t longest_ms[FAULTS] = {2000, 30000, 2000, 20000, 1000, 2000,  500,
                                              500,  1000,  200,  200,   200,  20000, 100};
  for (int i = 0; i < FAULTS; ++i) {
    if (on(w, (enum fault)i) || !once_in(w, 2500)) continue;
    /* A delay that was there when the block began cannot be told from none. */
    if (i == QUEUE && (on(w, STUCK) || on(w, IN_TURN) || on(w, ANY_OLD))) continue;
    w->until_ms[i] = w->now_ms + w->cycle_ms + below(w, longest_ms[i]);
    if (i == IN_TURN) begin_ring(w);
    if (i == QUEUE) w->waiting = once_in(w, 2) ? below(w, KEPT) : 0;
  }
  if (!on(w, BLIND)) w->minds = once_in(w, 2);
  if (once_in(w, 20000)) w->order = 1 + (int)below(w, 4);
  /* Started again: by a clock that went on, or one that was set back. */
  if (once_in(w, 10000)) w->heartbeat += below(w, 1000000);
  if (once_in(w, 20000)) w->heartbeat = below(w, 100) - 50;
  if (once_in(w, 5000)) w->until_ms[CONFIRMED] = w->now_ms + 100;
  if (on(w, QUEUE)) w->until_ms[CONFIRMED] = 0;
}

static void world_begin(struct world* w, uint64_t seed, int32_t cycle_ms) {
  memset(w, 0, sizeof *w);
  w->random = seed;
  w->cycle_ms = cycle_ms;
  w->order = 1;
  w->ring_size = 2;
  w->heartbeat = 0xFFFFFF00u;
}

static void world_cycle(struct world* w) {
  w->now_ms += w->cycle_ms;
  begin_faults(w);
  while (w->next_ms + ANSWER_MS <= w->now_ms) {
    w->next_ms += ANSWER_MS;
    answer(w);
  }
  transport(w);
}

#endif

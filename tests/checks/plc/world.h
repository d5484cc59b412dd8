/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* What FB_PoseWall is connected to: seven quantities that move at the fastest rate that was stated, an engine that
 * publishes images of them, and a fieldbus that loses, delays, tears and mixes up. All by one seed. */

#ifndef PLC_WORLD_H
#define PLC_WORLD_H

#include <string.h>

#include "order_of_words.h"
#include "pose_wall.h"

#define CYCLE_MS 10
#define WORDS 62
#define KEPT 8 /* images that may come back */
#define ANGLE_RATE 2865
#define DISTANCE_RATE 200
#define ANGLE_LIMIT 1000
#define DISTANCE_LIMIT 100
#define CONFIG 0xC0FFEEu

/* Faults that go on for a while; each has its own clock. */
enum fault {
  STUCK,      /* the bus shows what it showed */
  IN_TURN,    /* two or three old images in turn */
  SILENCE,    /* no frames; images of pose_wall_age, or none */
  REPEATED,   /* the last frame is published again and again: a new publication, an old sequence */
  SETTINGS,   /* an engine of other settings publishes */
  TORN,       /* half an image */
  FLIPPED,    /* some bits are turned */
  GARBAGE,    /* random words */
  VERSION,    /* an image of version 3 with a sum that fits */
  SLOW,       /* frames are told long after they were taken */
  DOUBTFUL,   /* states and levels of all kinds */
  PARAMETERS, /* limits, times and rates at the ends of their types */
  FAULTS
};

struct image {
  uint32_t words[WORDS]; /* low byte first, as published */
  uint32_t sequence;
  int good;             /* of a known version and the approved settings */
  int64_t published_ms; /* for the first time */
  int32_t value[7], level[7];
  uint32_t state[7];
};

struct world {
  uint64_t random;
  int64_t now_ms, next_ms, until_ms[FAULTS];
  int32_t truth[7], step[7];
  struct image kept[KEPT]; /* [0]: the newest */
  uint32_t sequence, publication, version;
  int64_t measured_ms; /* when the last frame was taken */
  int silent_image, buffers, order;
  uint32_t bus[WORDS]; /* what the controller reads */
  int whole;           /* what lies there is undamaged: */
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

static int32_t rate_of(int q) {
  return q < 3 ? ANGLE_RATE : DISTANCE_RATE;
}
static int32_t limit_of(int q) {
  return q < 3 ? ANGLE_LIMIT : DISTANCE_LIMIT;
}

/* Always at nearly the fastest: what is old is wrong soon. */
static void move(struct world* w) {
  for (int q = 0; q < 7; ++q) {
    if (once_in(w, 300) || w->truth[q] > 50000 || w->truth[q] < -50000) w->step[q] = w->truth[q] > 0 ? -1 : 1;
    w->truth[q] += w->step[q] * (rate_of(q) * CYCLE_MS / 1000);
  }
}

static uint32_t sum_of(const uint32_t* words, uint32_t count, uint32_t polynomial) {
  uint32_t crc = 0xFFFFFFFFu;
  for (uint32_t i = 0; i < count; ++i) {
    if (i == 2) continue;
    crc ^= words[i];
    for (int bit = 0; bit < 32; ++bit) crc = crc >> 1 ^ ((crc & 1u) != 0 ? polynomial : 0u);
  }
  return ~crc;
}

/* What the engine tells of one quantity `age_ms` after it looked. A level that is told holds. */
static void tell(struct world* w, struct image* to, int q, int32_t age_ms) {
  const int32_t level = limit_of(q) / 8 + (int32_t)below(w, (uint32_t)limit_of(q) / 8);
  to->state[q] = POSE_WALL_VALID;
  to->level[q] = level;
  /* Back to when it looked: the truth may have gone either way since, by the rate at most. */
  to->value[q] = w->truth[q] - w->step[q] * (int32_t)((int64_t)rate_of(q) * age_ms / 1000);
  to->value[q] += (int32_t)below(w, (uint32_t)(2 * level + 1)) - level;
  if (!on(w, DOUBTFUL) || !once_in(w, 6)) return;
  if (once_in(w, 2)) {
    to->state[q] = once_in(w, 2) ? POSE_WALL_HELD : POSE_WALL_DEGRADED + below(w, 2);
    to->level[q] = to->state[q] == POSE_WALL_HELD ? limit_of(q) * 3 / 4 : limit_of(q) + 1;
    return;
  }
  to->value[q] = (int32_t)below(w, 2000000000u) - 1000000000;
  switch (below(w, 6)) {
    case 0:
      to->state[q] = POSE_WALL_INVALID;
      break;
    case 1:
      to->state[q] = POSE_WALL_INVALID, to->level[q] = POSE_WALL_IMAGE_NO_BOUND;
      break;
    case 2:
      to->value[q] = POSE_WALL_IMAGE_NO_VALUE;
      break;
    case 3:
      to->level[q] = POSE_WALL_IMAGE_NO_BOUND;
      break;
    case 4:
      to->level[q] = -1 - (int32_t)below(w, 2000000000u);
      break;
    default:
      to->state[q] = 4 + below(w, 4000000000u);
      break;
  }
}

/* Held values with grown levels, sooner or later invalid: what pose_wall_age tells. */
static void tell_silence(struct world* w, struct image* to) {
  const int64_t silent_ms = w->now_ms - w->measured_ms;
  for (int q = 0; q < 7; ++q) {
    if (to->state[q] == POSE_WALL_INVALID || to->state[q] > POSE_WALL_VALID) continue;
    to->state[q] = silent_ms > 400 || once_in(w, 20) ? POSE_WALL_INVALID : POSE_WALL_HELD;
    if (to->level[q] >= 0 && to->level[q] <= limit_of(q)) to->level[q] += (int32_t)(rate_of(q) * 100 / 1000);
  }
}

static void write_image2(const struct world* w, struct image* to, uint32_t latency_ms, uint32_t config) {
  pose_wall_image2 i;
  memset(&i, 0, sizeof i);
  i.struct_size = sizeof i;
  i.version = on(w, VERSION) ? 3 : 2;
  i.sequence = to->sequence;
  i.publication = w->publication;
  i.config_crc32 = config;
  i.latency_ms = latency_ms;
  pose_wall_image2_angle* const angles[] = {&i.roll, &i.pitch, &i.yaw};
  pose_wall_image2_distance* const distances[] = {&i.d_lf, &i.d_lb, &i.d_rf, &i.d_rb};
  for (int q = 0; q < 3; ++q) {
    angles[q]->value_mdeg = to->value[q], angles[q]->protection_mdeg = to->level[q], angles[q]->state = to->state[q];
  }
  for (int q = 0; q < 4; ++q) {
    distances[q]->value_mm = to->value[q + 3], distances[q]->protection_mm = to->level[q + 3];
    distances[q]->state = to->state[q + 3];
  }
  memcpy(to->words, &i, sizeof i);
  to->words[2] = sum_of(to->words, 62, 0x82F63B78u);
}

static void write_image1(const struct world* w, struct image* to, uint32_t config) {
  pose_wall_image i;
  memset(&i, 0, sizeof i);
  i.struct_size = sizeof i;
  i.version = on(w, VERSION) ? 3 : 1;
  i.sequence = to->sequence;
  i.config_crc32 = config;
  pose_wall_image_angle* const angles[] = {&i.roll, &i.pitch, &i.yaw};
  pose_wall_image_distance* const distances[] = {&i.d_lf, &i.d_lb, &i.d_rf, &i.d_rb};
  for (int q = 0; q < 3; ++q) {
    angles[q]->value_mdeg = to->value[q], angles[q]->protection_mdeg = to->level[q], angles[q]->state = to->state[q];
  }
  for (int q = 0; q < 4; ++q) {
    distances[q]->value_mm = to->value[q + 3], distances[q]->protection_mm = to->level[q + 3];
    distances[q]->state = to->state[q + 3];
  }
  memset(to->words, 0x5A, sizeof to->words);
  memcpy(to->words, &i, sizeof i);
  to->words[2] = sum_of(to->words, 60, 0xEDB88320u);
}

static void publish(struct world* w) {
  const int silent = on(w, SILENCE), repeated = on(w, REPEATED);
  if (silent && !w->silent_image) return;
  struct image next = w->kept[0];
  ++w->publication;
  uint32_t latency_ms = w->version == 1 || once_in(w, 2) ? 5 : 0;
  if (silent) {
    tell_silence(w, &next);
  } else if (!repeated) {
    if (on(w, SLOW) && w->version == 2) latency_ms = below(w, 1000);
    next.sequence = ++w->sequence;
    w->measured_ms = w->now_ms;
    for (int q = 0; q < 7; ++q) tell(w, &next, q, (int32_t)latency_ms);
    if (on(w, SETTINGS)) {
      for (int q = 0; q < 7; ++q) next.value[q] = (int32_t)below(w, 1000);
    }
  }
  const uint32_t config = on(w, SETTINGS) ? CONFIG + 1 : CONFIG;
  if (w->version == 2) write_image2(w, &next, latency_ms, config);
  if (w->version == 1) write_image1(w, &next, config);
  next.published_ms = w->measured_ms;
  next.good = config == CONFIG && !on(w, VERSION);
  memmove(&w->kept[1], &w->kept[0], sizeof w->kept[0] * (KEPT - 1));
  w->kept[0] = next;
}

static void damage(struct world* w, uint32_t* words) {
  if (on(w, TORN)) {
    const uint32_t at = below(w, WORDS);
    memcpy(words + at, w->kept[1 + below(w, 3)].words + at, (WORDS - at) * 4);
  }
  if (on(w, FLIPPED)) {
    for (uint32_t i = 0; i <= below(w, 8); ++i) words[below(w, WORDS)] ^= 1u << below(w, 32);
  }
  if (on(w, GARBAGE)) {
    for (int i = 0; i < WORDS; ++i) words[i] = below(w, 65536) << 16 | below(w, 65536);
    words[0] = once_in(w, 2) ? 248 : words[0], words[1] = 2;
  }
}

/* What lies at the controller's input in this cycle. */
static void transport(struct world* w) {
  if (on(w, STUCK)) return;
  const int back = on(w, IN_TURN) ? (int)(w->now_ms / CYCLE_MS % w->buffers) : 0;
  const struct image* from = &w->kept[back];
  uint32_t words[WORDS];
  memcpy(words, from->words, sizeof words);
  damage(w, words);
  w->whole = 0;
  for (int i = KEPT - 1; i >= 0; --i) {
    /* What lies behind an image 1 is not looked at. */
    if (memcmp(words, w->kept[i].words, w->kept[i].words[1] == 1 ? 240 : 248) != 0) continue;
    w->whole = 1;
    w->seen = w->kept[i];
  }
  for (int i = 0; i < WORDS; ++i) w->bus[i] = swapped(words[i], w->order);
}

static void begin_faults(struct world* w) {
  static const uint32_t longest_ms[FAULTS] = {2000, 2000, 2000, 2000, 1000, 100, 100, 100, 500, 2000, 20000, 10000};
  for (int i = 0; i < FAULTS; ++i) {
    if (!on(w, (enum fault)i) && once_in(w, 2500)) w->until_ms[i] = w->now_ms + 10 + below(w, longest_ms[i]);
  }
  if (!on(w, SILENCE)) w->silent_image = once_in(w, 2);
  if (!on(w, IN_TURN)) w->buffers = 2 + (int)below(w, 2);
  if (once_in(w, 20000)) w->order = 1 + (int)below(w, 4);
  if (once_in(w, 20000)) w->version = 1 + below(w, 2);
  if (once_in(w, 20000)) w->sequence = below(w, 4), w->publication = w->sequence;
}

static void world_begin(struct world* w, uint64_t seed) {
  memset(w, 0, sizeof *w);
  w->random = seed;
  w->version = 2;
  w->order = 1;
  for (int q = 0; q < 7; ++q) w->step[q] = 1;
}

static void world_cycle(struct world* w) {
  w->now_ms += CYCLE_MS;
  begin_faults(w);
  move(w);
  if (w->now_ms >= w->next_ms) {
    publish(w);
    w->next_ms = w->now_ms + 90 + below(w, 20);
  }
  transport(w);
}

#endif

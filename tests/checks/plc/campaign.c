/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* FB_PoseWall, translated from its structured text, in a world of random faults. After every cycle an oracle that knows
 * the truth, and shares no line with the block, looks whether a released value is stale, invalid, beyond its limit,
 * torn, or further from the truth than its level says.
 *
 *     campaign CYCLES SEED       ends with status 1 at the first violation */

#include <stdio.h>
#include <stdlib.h>

#include "fb_pose_wall.h" /* by structured_text_c.py */
#include "world.h"

#define DELIVERED 64

/* What the oracle remembers of the images that came whole. */
struct seen {
  int64_t rise_ms, fresh_ms[7], worse_ms[7];
  uint32_t sequence, worse_sequence[7], count;
  struct image delivered[DELIVERED]; /* the last ones */
  int64_t delay_ms[DELIVERED];       /* how long each was under way: nobody tells the controller */
};

struct told {
  uint64_t released, usable, cycles, starts;
  uint64_t digest; /* of all outputs: another compiler's block must give the same */
};

static const ST_PoseWallValue* value_of(const FB_PoseWall* b, int q) {
  const ST_PoseWallValue* const all[] = {&b->stRoll,     &b->stPitch,      &b->stYaw,      &b->stLeftFront,
                                         &b->stLeftBack, &b->stRightFront, &b->stRightBack};
  return all[q];
}

static int32_t limit_given(const FB_PoseWall* b, int q) {
  return q < 3 ? b->diAngleLimit_mdeg : b->diDistanceLimit_mm;
}

static void complain(const struct world* w, int q, const char* what, const ST_PoseWallValue* v) {
  printf("cycle %lld, quantity %d: %s (value %d, level %d, truth %d, sequence %u)\n", (long long)(w->now_ms / CYCLE_MS),
         q, what, v->diValue, v->diLevel, w->truth[q], w->kept[0].sequence);
  exit(1);
}

static int measured(const FB_PoseWall* b, uint32_t state) {
  return state == POSE_WALL_VALID || (b->xTakeDegraded && state == POSE_WALL_DEGRADED);
}

static void remember(const struct world* w, struct seen* s) {
  for (uint32_t i = 0; i < DELIVERED; ++i) {
    const struct image* k = &s->delivered[i];
    if (k->sequence == w->seen.sequence && k->published_ms == w->seen.published_ms) return; /* told again */
  }
  s->delivered[s->count % DELIVERED] = w->seen;
  s->delay_ms[s->count++ % DELIVERED] = w->now_ms - w->seen.published_ms;
}

static void look_at_bus(const struct world* w, const FB_PoseWall* b, struct seen* s) {
  const struct image* i = &w->seen;
  if (!w->whole || !i->good) return;
  remember(w, s);
  if (i->sequence > s->sequence) s->rise_ms = w->now_ms;
  for (int q = 0; q < 7; ++q) {
    const int bears = i->level[q] >= 0 && i->level[q] <= limit_given(b, q) && i->level[q] != POSE_WALL_IMAGE_NO_BOUND &&
                      i->value[q] != POSE_WALL_IMAGE_NO_VALUE && i->state[q] >= 1 && i->state[q] <= 3;
    if (!bears) {
      s->worse_ms[q] = w->now_ms, s->worse_sequence[q] = i->sequence;
    } else if (measured(b, i->state[q]) && i->sequence != s->sequence && i->sequence != s->worse_sequence[q]) {
      s->fresh_ms[q] = w->now_ms;
    }
  }
  s->sequence = i->sequence;
}

struct delay {
  int64_t shortest_ms, longest_ms;
};

/* How long the image was under way that the value is from, as far as the value tells; -1: it came with none. */
static struct delay delay_of(const struct world* w, const struct seen* s, const FB_PoseWall* b, int q, int32_t value) {
  struct delay d = {-1, -1};
  const int64_t used_ms = b->tHold > b->tWatchdog ? b->tHold : b->tWatchdog;
  for (uint32_t i = 0; i < DELIVERED; ++i) {
    const struct image* k = &s->delivered[i];
    if (!k->good || k->value[q] != value || !measured(b, k->state[q])) continue;
    if (w->now_ms - k->published_ms - s->delay_ms[i] > used_ms) continue;
    if (d.shortest_ms < 0 || s->delay_ms[i] < d.shortest_ms) d.shortest_ms = s->delay_ms[i];
    if (s->delay_ms[i] > d.longest_ms) d.longest_ms = s->delay_ms[i];
  }
  return d;
}

static void judge_value(const struct world* w, const FB_PoseWall* b, const struct seen* s, int q) {
  const ST_PoseWallValue* v = value_of(b, q);
  if (!v->xUsable) {
    if (v->diValue != POSE_WALL_IMAGE_NO_VALUE) complain(w, q, "not usable, but a value stands there", v);
    return;
  }
  const struct delay delay = delay_of(w, s, b, q, v->diValue);
  if (delay.shortest_ms < 0) complain(w, q, "torn or stale: no image has brought it of late", v);
  if (delay.shortest_ms >= b->tWatchdog) complain(w, q, "stale: it was long under way", v);
  const int64_t off = (int64_t)v->diValue - w->truth[q];
  const int64_t bound = v->diLevel + rate_of(q) * delay.longest_ms / 1000;
  if (v->diLevel < 0 || v->diLevel > limit_given(b, q)) complain(w, q, "beyond its limit", v);
  if (off > bound || -off > bound) complain(w, q, "further from the truth than its level", v);
  if (w->whole && w->seen.good && v->diLevel < w->seen.level[q]) complain(w, q, "its level was told larger", v);
  if (s->worse_ms[q] >= s->fresh_ms[q]) complain(w, q, "used though invalid", v);
  if (w->now_ms - s->rise_ms >= b->tWatchdog) complain(w, q, "stale: no frame within the watchdog's time", v);
  if (v->xHeld && w->now_ms - s->fresh_ms[q] > b->tHold) complain(w, q, "stale: held too long", v);
}

static void judge(const struct world* w, const FB_PoseWall* b, const struct seen* s, struct told* t) {
  int all = b->dwNeeded != 0 && (b->dwNeeded & ~0x7Fu) == 0;
  for (int q = 0; q < 7; ++q) {
    judge_value(w, b, s, q);
    if ((b->dwNeeded >> q & 1u) != 0 && !value_of(b, q)->xUsable) all = 0;
    const ST_PoseWallValue* v = value_of(b, q);
    const uint32_t outputs[] = {v->xUsable, v->xHeld, (uint32_t)v->diValue, (uint32_t)v->diLevel,
                                (uint32_t)v->diAge_ms};
    for (int i = 0; i < 5; ++i) t->digest = (t->digest ^ outputs[i]) * 0x100000001B3ULL;
    t->usable += v->xUsable;
  }
  if (b->xRelease != all || b->xSafeState == b->xRelease)
    complain(w, 7, "released otherwise than its values are", &b->stYaw);
  t->released += b->xRelease;
  ++t->cycles;
}

static void start(FB_PoseWall* b, T_PoseWallWords* bus) {
  FB_PoseWall_init(b);
  b->adwImage = bus;
  b->dwConfigCrc = CONFIG;
  b->diLatency_ms = 5;
  if (b->xRelease || !b->xSafeState) {
    printf("released before the first call\n");
    exit(1);
  }
}

static int32_t extreme(struct world* w, int32_t usual) {
  const int32_t all[] = {INT32_MIN, -1, 0, 1, usual, usual, INT32_MAX - 1, INT32_MAX};
  return all[below(w, 8)];
}

/* Only such as ask for no less: a rate below the world's would make the oracle's levels too small. */
static void set_parameters(struct world* w, FB_PoseWall* b) {
  static const uint32_t needed[] = {0, 0x7F, 0x04, 0x78, 0xFF, 0x80000000u};
  const int extremes = on(w, PARAMETERS);
  b->tWatchdog = extremes ? extreme(w, 300) : 300;
  b->tHold = extremes ? extreme(w, 500) : 500;
  b->diRises = extremes ? 3 + (int32_t)below(w, 100) : 3;
  b->diAngleLimit_mdeg = extremes ? extreme(w, ANGLE_LIMIT) : ANGLE_LIMIT;
  b->diDistanceLimit_mm = extremes ? extreme(w, DISTANCE_LIMIT) : DISTANCE_LIMIT;
  b->diAngleRate_mdeg_s = extremes && once_in(w, 4) ? extreme(w, ANGLE_RATE) | 4096 : ANGLE_RATE;
  b->diDistanceRate_mm_s = extremes && once_in(w, 4) ? extreme(w, DISTANCE_RATE) | 256 : DISTANCE_RATE;
  b->dwNeeded = extremes ? needed[below(w, 6)] : 0x7F;
  b->xTakeDegraded = 0;
}

int main(int argc, char** argv) {
  static struct world w;
  static FB_PoseWall block;
  static T_PoseWallWords bus;
  struct seen seen = {0};
  struct told told = {0};
  if (argc != 3) return 2;
  const uint64_t cycles = strtoull(argv[1], NULL, 10);
  world_begin(&w, strtoull(argv[2], NULL, 10));
  for (uint64_t i = 0; i < cycles; ++i) {
    world_cycle(&w);
    memcpy(bus.at, w.bus, sizeof w.bus);
    if (i == 0 || once_in(&w, 20000)) start(&block, &bus), ++told.starts;
    if (i % 100 == 0 || !on(&w, PARAMETERS)) set_parameters(&w, &block);
    now_ms = w.now_ms;
    FB_PoseWall_body(&block);
    look_at_bus(&w, &block, &seen);
    judge(&w, &block, &seen, &told);
  }
  printf("%llu cycles, %llu starts: released in %.1f %%, values usable in %.1f %%, outputs %016llX\n",
         (unsigned long long)told.cycles, (unsigned long long)told.starts,
         100.0 * (double)told.released / (double)told.cycles, 100.0 * (double)told.usable / (7.0 * (double)told.cycles),
         (unsigned long long)told.digest);
  /* A block that never releases would pass, too. */
  return told.released * 5 < told.cycles;
}

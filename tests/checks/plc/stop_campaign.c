/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* FB_PoseWallStop, translated from its structured text, in a world of random faults (stop_world.h). After every cycle
 * an oracle that knows when each image was made, and shares no line with the block, looks whether it permits driving by
 * an image that is stale, torn, of other settings, or that permits less. Before that: rings of 2 to 64 old images at
 * the start, after live images and after gaps.
 *
 *     stop_campaign CYCLES SEED CYCLE_MS      ends with status 1 at the first violation */

#include <stdio.h>
#include <stdlib.h>

#include "fb_pose_wall.h" /* by structured_text_c.py */
#include "stop_world.h"

struct told {
  uint64_t permitted, go, cycles, starts;
  uint64_t digest; /* of all outputs: another compiler's block must give the same */
};

/* What the block permitted in the cycle before, and under which heartbeat. */
struct before {
  uint32_t heartbeat;
  int32_t state, speed;
};

static void complain(const struct world* w, const FB_PoseWallStop* b, const char* what) {
  printf("cycle %lld: %s (state %d, %d mm/s, fault %u, heartbeat %u, newest %u, made %lld ms ago)\n",
         (long long)(w->now_ms / w->cycle_ms), what, b->xGo ? 2 : b->xSlow, b->diAllowed_mm_s, b->udiFault,
         w->seen.heartbeat, w->kept[0].heartbeat, (long long)(w->now_ms - w->seen.made_ms));
  exit(1);
}

static int32_t permitted(const FB_PoseWallStop* b) {
  return b->xGo ? 2 : b->xSlow;
}

/* How old the newest answer may be. The quickest one is as old as the time between two answers, and a drift of 1 ms per
 * second is forgiven while a fault goes on, of which the longest takes 20 s. */
static int64_t oldest_ms(const FB_PoseWallStop* b) {
  return (int64_t)b->tWatchdog + ANSWER_MS + 20;
}

static void judge(const struct world* w, const FB_PoseWallStop* b, struct before* last) {
  const int32_t state = permitted(b);
  if (b->xStop + b->xSlow + b->xGo != 1) complain(w, b, "not one of stop, slow and go");
  if ((b->diAllowed_mm_s > 0) != (state > 0)) complain(w, b, "a speed without a permission, or none with it");
  if (state > 0) {
    if (!w->whole) complain(w, b, "torn or damaged");
    if (!w->seen.approved) complain(w, b, "of other settings");
    if (w->seen.state < state || w->seen.state > 2) complain(w, b, "the image permits less");
    if (w->seen.speed < b->diAllowed_mm_s) complain(w, b, "the image permits a lower speed");
    if (w->now_ms - w->seen.made_ms > oldest_ms(b)) complain(w, b, "stale: an old image");
    if (w->now_ms - w->seen.frame_ms > (int64_t)b->tAgeMost + ANSWER_MS + 20) complain(w, b, "stale: an old frame");
    const int is_same = w->seen.heartbeat == last->heartbeat;
    if (is_same && (state > last->state || b->diAllowed_mm_s > last->speed))
      complain(w, b, "better under an old heartbeat");
    if ((int32_t)(w->seen.heartbeat - last->heartbeat) < 0 && last->state > 0) complain(w, b, "a heartbeat that fell");
  }
  if (w->whole) last->heartbeat = w->seen.heartbeat;
  last->state = state, last->speed = b->diAllowed_mm_s;
}

static void note(const FB_PoseWallStop* b, struct told* t) {
  const uint32_t outputs[] = {b->xStop,   b->xSlow, b->xGo, (uint32_t)b->diAllowed_mm_s, (uint32_t)b->diAge_ms,
                              b->udiFault};
  for (int i = 0; i < 6; ++i) t->digest = (t->digest ^ outputs[i]) * 0x100000001B3ULL;
  t->permitted += !b->xStop;
  t->go += b->xGo;
  ++t->cycles;
}

static void start(FB_PoseWallStop* b, T_PoseWallWords* bus) {
  FB_PoseWallStop_init(b);
  b->adwImage = bus;
  b->dwSettingsCrc = SETTINGS;
  if (!b->xStop || b->xSlow || b->xGo || b->diAllowed_mm_s != 0) {
    printf("permits before the first call\n");
    exit(1);
  }
}

static int32_t extreme(struct world* w, int32_t usual) {
  const int32_t all[] = {INT32_MIN, -1, 0, 1, usual, usual, usual, INT32_MAX};
  return all[below(w, 8)];
}

/* Of the rises only more than the rings have images: fewer are the user's own risk. */
static void set_parameters(struct world* w, FB_PoseWallStop* b) {
  const int extremes = on(w, PARAMETERS);
  b->tWatchdog = extremes ? extreme(w, WATCHDOG_MS) : WATCHDOG_MS;
  b->tAgeMost = extremes ? extreme(w, AGE_MS) : AGE_MS;
  b->diStepMost = extremes ? extreme(w, 32) : 32;
  b->diRises = extremes ? RING + (int32_t)below(w, 100) : RING;
  if (b->tWatchdog > WATCHDOG_MS) b->tWatchdog = WATCHDOG_MS + (int32_t)below(w, 60000);
}

/* A ring of so many images, `apart` beats from each other. Before it so many live images were read, and `missed` beats
 * were not. */
static void ring(int size, uint32_t apart, int live, uint32_t missed, int32_t cycle_ms) {
  static FB_PoseWallStop block;
  static T_PoseWallWords bus;
  uint32_t beat = 0xFFFFFFF0u, permits = 0;
  now_ms = 1000;
  start(&block, &bus);
  for (int i = 0; i < live + 4 * RING; ++i) {
    const int in_ring = i - live;
    const uint32_t back = (uint32_t)(size - 1 - in_ring % size) * apart;
    if (i < live) beat += (uint32_t)(cycle_ms / ANSWER_MS);
    if (in_ring == 0) beat += missed, now_ms += (int64_t)missed * ANSWER_MS;
    now_ms += cycle_ms;
    write_words(bus.at, in_ring < 0 ? beat : beat - back, 2, 500, 50, SETTINGS);
    FB_PoseWallStop_body(&block);
    permits = in_ring >= 0 && (block.xGo || block.xSlow) ? permits + 1 : permits;
  }
  /* Where the ring goes on from the live images, its first turn cannot be told from them before the watchdog ends. */
  const uint32_t unseen = live > RING && missed > 0 ? (uint32_t)(WATCHDOG_MS / cycle_ms) + 1 : 0;
  if (permits > unseen) {
    printf("a ring of %d images, %u beats apart, after %d live ones and %u missed beats permits in %u cycles\n", size,
           apart, live, missed, permits);
    exit(1);
  }
}

static void rings(int32_t cycle_ms) {
  static const uint32_t missed[] = {0, 5, 33, 1000, 100000};
  for (int size = 2; size <= RING; ++size) {
    for (uint32_t apart = 1; apart <= 32; apart *= 2) {
      for (uint32_t m = 0; m < 5; ++m) {
        ring(size, apart, 0, missed[m], cycle_ms);
        ring(size, apart, RING + 40, missed[m], cycle_ms);
      }
    }
  }
}

int main(int argc, char** argv) {
  static struct world w;
  static FB_PoseWallStop block;
  static T_PoseWallWords bus;
  struct before last = {0, 0, 0};
  struct told told = {0, 0, 0, 0, 0};
  if (argc != 4) return 2;
  const uint64_t cycles = strtoull(argv[1], NULL, 10);
  const int32_t cycle_ms = atoi(argv[3]);
  rings(cycle_ms);
  world_begin(&w, strtoull(argv[2], NULL, 10), cycle_ms);
  for (uint64_t i = 0; i < cycles; ++i) {
    world_cycle(&w);
    memcpy(bus.at, w.bus, sizeof w.bus);
    if (i == 0 || (once_in(&w, 20000) && !on(&w, QUEUE))) start(&block, &bus), ++told.starts, last.state = 0;
    if (i % 100 == 0 || !on(&w, PARAMETERS)) set_parameters(&w, &block);
    block.xRestart = on(&w, CONFIRMED) != 0;
    now_ms = w.now_ms;
    FB_PoseWallStop_body(&block);
    judge(&w, &block, &last);
    note(&block, &told);
  }
  printf("%llu cycles, %llu starts: permitted in %.1f %%, go in %.1f %%, outputs %016llX\n",
         (unsigned long long)told.cycles, (unsigned long long)told.starts,
         100.0 * (double)told.permitted / (double)told.cycles, 100.0 * (double)told.go / (double)told.cycles,
         (unsigned long long)told.digest);
  /* A block that never permits would pass, too. */
  return told.permitted * 10 < told.cycles;
}

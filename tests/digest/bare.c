/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * The digests on AArch64 without any library: linked with -nostdlib to the archive and allowed.c, so whatever else the
 * engine needed would be missing. Runs on a stack of its own, painted before and looked at after: how deep the engine
 * really went. Only the last step to the outside, two calls of the Linux kernel, is not what a controller would have.
 */

#include "digest.h"

#define STACK_BYTES 65536u
#define STACK_PROMISED 32768u /* of the engine, by pose_wall.h */
#define SELF_TEST_FAILED 3
#define PAINT 0xA5A5A5A5A5A5A5A5u

uint64_t bare_stack[STACK_BYTES / sizeof(uint64_t)] __attribute__((aligned(16)));
void bare_main(void);

__asm__(
    ".global _start\n"
    "_start:\n"
    "  adrp x0, bare_stack\n"
    "  add  x0, x0, :lo12:bare_stack\n"
    "  mov  x1, #65536\n"
    "  add  sp, x0, x1\n"
    "  bl   bare_main\n");

static int64_t kernel(int64_t number, int64_t a, int64_t b, int64_t c) {
  register int64_t x8 __asm__("x8") = number;
  register int64_t x0 __asm__("x0") = a;
  register int64_t x1 __asm__("x1") = b;
  register int64_t x2 __asm__("x2") = c;
  __asm__ volatile("svc 0" : "+r"(x0) : "r"(x8), "r"(x1), "r"(x2) : "memory");
  return x0;
}

static void print(const digest* d) {
  char line[DIGEST_LINE_BYTES];
  const uint32_t length = digest_line(d, &line);
  kernel(64, 1, (int64_t)(uintptr_t)line, length); /* write */
}

static void leave(int status) {
  for (;;) kernel(93, status, 0, 0); /* exit */
}

/* The lower half only: what is above it is in use. */
static void paint_stack(void) {
  for (uint32_t i = 0; i < STACK_PROMISED / sizeof(uint64_t); ++i) bare_stack[i] = PAINT;
}

static int stack_kept(void) {
  for (uint32_t i = 0; i < STACK_PROMISED / sizeof(uint64_t); ++i) {
    if (bare_stack[i] != PAINT) return 0;
  }
  return 1;
}

void bare_main(void) {
  static digest d;
  paint_stack();
  int status = 0;
  for (uint32_t k = 0; k < roadway_count && status == 0; ++k) {
    status = digest_roadway(&d, roadways[k]) == 0 ? 0 : 1;
    if (status == 0) print(&d);
  }
  pose_wall_self_test_report report;
  if (status == 0 && digest_self_test(&report) != POSE_WALL_OK) leave(SELF_TEST_FAILED);
  leave(status != 0 ? 1 : (stack_kept() ? 0 : 2));
}

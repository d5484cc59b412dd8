/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* The engine's clock for Python, in C: a clock in Python would run the interpreter in the middle of a frame, where an
 * interrupt from the keyboard would be lost. */

#include <stdint.h>
#include <time.h>

__attribute__((visibility("default"))) int64_t pose_wall_python_clock_ns(void* user);

int64_t pose_wall_python_clock_ns(void* user) {
  struct timespec now;
  (void)user;
  if (clock_gettime(CLOCK_MONOTONIC, &now) != 0) return 0;
  return (int64_t)now.tv_sec * INT64_C(1000000000) + (int64_t)now.tv_nsec;
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints where members of a struct lie, and whether they fill it. Part of abi_layout.c. */

#ifndef POSE_WALL_ABI_LAYOUT_H
#define POSE_WALL_ABI_LAYOUT_H

#include <stddef.h>
#include <stdio.h>

static size_t filled = 0;

static void member(const char* name, size_t offset, size_t bytes) {
  printf("  %-30s %5u %5u\n", name, (unsigned)offset, (unsigned)bytes);
  filled += bytes;
}

static int struct_end(const char* name, size_t bytes) {
  printf("%s %u\n", name, (unsigned)bytes);
  if (filled != bytes) printf("%s: members fill %u bytes only\n", name, (unsigned)filled);
  const int padded = filled != bytes;
  filled = 0;
  return padded;
}

static int struct_with_pointers_end(const char* name, size_t bytes) {
  return struct_end(name, bytes) && sizeof(void*) == 8;
}

#define MEMBER(type, name) member(#name, offsetof(type, name), sizeof(((type*)0)->name))

#endif /* POSE_WALL_ABI_LAYOUT_H */

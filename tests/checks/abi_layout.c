/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints where every member of the public structs lies, in C99. check_abi.cmake compares it with abi_layout.txt, or
 * with abi_layout_armv7.txt where pointers have 32 bits. A struct whose members do not fill it (implicit padding) ends
 * with status 1. Only a struct with pointers may have gaps, and only where these have 32 bits: nothing ever compares or
 * sums its bytes. abi_layout.py reads structs and members from the headers, so that none can be left out. */

#include <stddef.h>
#include <stdio.h>

#include "pose_wall.h"
#include "pose_wall_box.h"
#include "pose_wall_motion.h"
#include "pose_wall_planar.h"
#include "pose_wall_runtime.h"

static size_t filled = 0;
static int padded = 0;

static void member(const char* name, size_t offset, size_t bytes) {
  printf("  %-30s %5u %5u\n", name, (unsigned)offset, (unsigned)bytes);
  filled += bytes;
}

static void struct_end(const char* name, size_t bytes, int has_pointers) {
  printf("%s %u\n", name, (unsigned)bytes);
  if (filled != bytes) printf("%s: members fill %u bytes only\n", name, (unsigned)filled);
  padded += filled != bytes && !(has_pointers && sizeof(void*) == 4);
  filled = 0;
}

#define MEMBER(type, name) member(#name, offsetof(type, name), sizeof(((type*)0)->name));
#define STRUCT_END(type, has_pointers) struct_end(#type, sizeof(type), has_pointers);

int main(void) {
#include "abi_layout_members.def"
  return padded == 0 ? 0 : 1;
}

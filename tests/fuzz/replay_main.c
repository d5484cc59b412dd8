/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Feeds files, or all files of a folder in the order of their names, to one fuzz target. Then N inputs more, each made
 * of one of these by a few changes: garbage in every build, the same each time, that the target's oracle judges. No
 * fuzzer and no C++ library: any compiler builds it, and MemorySanitizer can judge it. usage: pose_wall_NAME_replay
 * [--changed N] [--keep FILE] FILE_OR_FOLDER...
 * --keep: the input that is being fed is written there first, so that FILE holds the one that crashed. */

#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

#define INPUTS_MAX 4096 /* files that changed inputs are made of */

static struct {
  uint8_t* bytes;
  size_t size;
} held[INPUTS_MAX];
static unsigned long inputs;
static const char* keep;

static int complain(const char* path) {
  perror(path);
  return EXIT_FAILURE;
}

static int write_kept(const uint8_t* bytes, size_t size) {
  FILE* const file = keep != NULL ? fopen(keep, "wb") : NULL;
  if (file == NULL) return keep != NULL ? complain(keep) : EXIT_SUCCESS;
  const int whole = fwrite(bytes, 1, size, file) == size;
  return fclose(file) == 0 && whole ? EXIT_SUCCESS : complain(keep);
}

/* From a block of exactly its size, so that AddressSanitizer sees what is read behind the end. */
static int feed(const char* path, FILE* file, size_t size) {
  uint8_t* const bytes = malloc(size > 0 ? size : 1);
  if (bytes == NULL) return complain(path);
  if (fread(bytes, 1, size, file) != size || inputs == INPUTS_MAX || write_kept(bytes, size) != EXIT_SUCCESS) {
    free(bytes);
    return complain(path);
  }
  /* Said before, so that a crash names its input. */
  printf("%s (%lu bytes)\n", path, (unsigned long)size);
  fflush(stdout);
  LLVMFuzzerTestOneInput(bytes, size);
  held[inputs].bytes = bytes;
  held[inputs++].size = size;
  return EXIT_SUCCESS;
}

static int feed_file(const char* path, size_t size) {
  FILE* const file = fopen(path, "rb");
  if (file == NULL) return complain(path);
  const int status = feed(path, file, size);
  fclose(file);
  return status;
}

static int feed_path(const char* path);

static int feed_folder(const char* path) {
  struct dirent** entries;
  const int count = scandir(path, &entries, NULL, alphasort);
  if (count < 0) return complain(path);
  int status = EXIT_SUCCESS;
  for (int i = 0; i < count; ++i) {
    char inside[4096];
    const int length = snprintf(inside, sizeof inside, "%s/%s", path, entries[i]->d_name);
    if (length < 0 || (size_t)length >= sizeof inside) {
      status = EXIT_FAILURE;
    } else if (entries[i]->d_name[0] != '.' && feed_path(inside) != EXIT_SUCCESS) {
      status = EXIT_FAILURE;
    }
    free(entries[i]);
  }
  free(entries);
  return status;
}

static int feed_path(const char* path) {
  struct stat what;
  if (stat(path, &what) != 0) return complain(path);
  return S_ISDIR(what.st_mode) ? feed_folder(path) : feed_file(path, (size_t)what.st_size);
}

/* splitmix64: the same numbers on every machine. */
static uint64_t chance_state;
static uint64_t chance(void) {
  uint64_t z = (chance_state += 0x9E3779B97F4A7C15U);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}
static size_t below(size_t count) {
  return count > 0 ? (size_t)(chance() % count) : 0;
}

/* A byte, a bit, a run of garbage, or what stands in another input. */
static void change(uint8_t* bytes, size_t size) {
  const size_t at = below(size), most = size - at < 64 ? size - at : 64, run = 1 + below(most), how = below(4);
  if (how == 0) bytes[at] = (uint8_t)chance();
  if (how == 1) bytes[at] = (uint8_t)(bytes[at] ^ 1U << below(8));
  for (size_t i = at; how == 2 && i < at + run; ++i) bytes[i] = (uint8_t)chance();
  if (how == 3) {
    const size_t other = below(inputs), from = below(held[other].size), left = held[other].size - from;
    memcpy(bytes + at, held[other].bytes + from, run < left ? run : left);
  }
}

/* Cut off, as long as it was, or with garbage behind it; then changed in up to eight places. */
static int feed_changed(unsigned long number) {
  const size_t of = below(inputs), size = held[of].size, lengths[] = {size, size, below(size + 1), size + below(256)};
  const size_t length = lengths[below(4)], kept = length < size ? length : size;
  uint8_t* const bytes = malloc(length > 0 ? length : 1);
  if (bytes == NULL) return complain("memory for an input");
  memcpy(bytes, held[of].bytes, kept);
  for (size_t i = kept; i < length; ++i) bytes[i] = (uint8_t)chance();
  for (size_t changes = below(9); changes > 0 && length > 0; --changes) change(bytes, length);
  printf("changed input %lu (%lu bytes)\n", number, (unsigned long)length);
  fflush(stdout);
  const int status = write_kept(bytes, length);
  LLVMFuzzerTestOneInput(bytes, length);
  free(bytes);
  return status;
}

int main(int argc, char** argv) {
  int status = EXIT_SUCCESS, first = 1;
  unsigned long changed = 0;
  for (; first + 1 < argc && strncmp(argv[first], "--", 2) == 0; first += 2) {
    if (strcmp(argv[first], "--changed") == 0) changed = strtoul(argv[first + 1], NULL, 10);
    if (strcmp(argv[first], "--keep") == 0) keep = argv[first + 1];
  }
  for (int i = first; i < argc; ++i) {
    if (feed_path(argv[i]) != EXIT_SUCCESS) status = EXIT_FAILURE;
  }
  for (unsigned long i = 0; i < changed && inputs > 0; ++i) {
    if (feed_changed(i) != EXIT_SUCCESS) status = EXIT_FAILURE;
  }
  printf("%lu inputs, %lu changed ones\n", inputs, changed);
  for (unsigned long i = 0; i < inputs; ++i) free(held[i].bytes);
  return inputs > 0 ? status : EXIT_FAILURE; /* nothing was tried: nothing was shown */
}

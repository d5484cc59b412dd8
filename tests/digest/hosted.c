/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * Prints the digests of all roadways, a line each, or of recorded sequences, or the report of the self test:
 *
 *     pose_wall_digest --self-test                its exit status tells whether it passed
 *     pose_wall_digest [KEY=VALUE... FILE...]     settings of the files behind them; FILE: frame after frame, a uint32
 *                                                 count, then x y z as float32, as pose_wall_to_xyz writes them
 */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "digest.h"

static void print(const digest* d) {
  char line[DIGEST_LINE_BYTES];
  fwrite(line, 1, digest_line(d, &line), stdout);
}

static int refused(const char* name, int32_t status) {
  fprintf(stderr, "%s: the engine refused it with status %d\n", name, (int)status);
  return EXIT_FAILURE;
}

static const char* last_part(const char* path) {
  const char* const slash = strrchr(path, '/');
  return slash != NULL ? slash + 1 : path;
}

#define GIVEN_MAX 16u
static setting given[GIVEN_MAX + 1]; /* the last stays NULL */

/* Cuts "key=value" in two; 0 if it is none, or one too many. */
static int give(char* text) {
  char* const equals = strchr(text, '=');
  uint32_t count = 0;
  while (given[count].key != NULL) ++count;
  if (equals == NULL || count == GIVEN_MAX) return 0;
  *equals = '\0';
  given[count].key = text;
  given[count].value = equals + 1;
  return 1;
}

static float points[ROADWAY_POINTS_MAX * 4][3];

static int frames_of(digest* d, const char* path, FILE* file) {
  int32_t status = digest_open(d, last_part(path), given);
  uint32_t count;
  while (status == 0 && fread(&count, sizeof count, 1, file) == 1) {
    if (count > sizeof points / sizeof points[0] || fread(points, sizeof points[0], count, file) != count) {
      fprintf(stderr, "%s: frame %llu is cut off or too large\n", path, (unsigned long long)d->frames);
      return EXIT_FAILURE;
    }
    status = digest_frame(d, (const float(*)[3])points, count, (int64_t)d->frames * 100000000);
  }
  return status == 0 ? EXIT_SUCCESS : refused(path, status);
}

static int recorded(const char* path) {
  FILE* const file = fopen(path, "rb");
  if (file == NULL) {
    perror(path);
    return EXIT_FAILURE;
  }
  digest d;
  const int status = frames_of(&d, path, file);
  fclose(file);
  if (status == EXIT_SUCCESS) print(&d);
  return status;
}

static int made(const roadway* road) {
  digest d;
  const int32_t status = digest_roadway(&d, road);
  if (status != 0) return refused(road->name, status);
  print(&d);
  return EXIT_SUCCESS;
}

static int self_test(void) {
  pose_wall_self_test_report report;
  const int32_t status = digest_self_test(&report);
  if (status != POSE_WALL_OK && status != POSE_WALL_E_SELF_TEST) return refused("self test", status);
  printf("frames %u\nvalues_wrong %u\nrefused %d\n", (unsigned)report.frames, (unsigned)report.values_wrong,
         (int)report.refused);
  printf("digest_expected %016llx\ndigest_found %016llx\n", (unsigned long long)report.digest_expected,
         (unsigned long long)report.digest_found);
  printf("code_bytes %llu\ncode_crc32 %08x\n", (unsigned long long)report.code_bytes, (unsigned)report.code_crc32);
  return status == POSE_WALL_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(int argc, char** argv) {
  int status = EXIT_SUCCESS;
  if (argc == 2 && strcmp(argv[1], "--self-test") == 0) return self_test();
  for (int i = 1; i < argc && status == EXIT_SUCCESS; ++i) {
    if (!give(argv[i])) status = recorded(argv[i]);
  }
  for (uint32_t k = 0; argc == 1 && k < roadway_count && status == EXIT_SUCCESS; ++k) status = made(roadways[k]);
  return status;
}

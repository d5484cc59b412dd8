/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Feeds files, or all files of a folder in the order of their names, to one fuzz target. No fuzzer and no C++ library:
 * any compiler builds it, and MemorySanitizer can judge it. usage: pose_wall_NAME_replay FILE_OR_FOLDER... */

#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

static unsigned long inputs;

static int complain(const char* path) {
  perror(path);
  return EXIT_FAILURE;
}

/* From a block of exactly its size, so that AddressSanitizer sees what is read behind the end. */
static int feed(const char* path, FILE* file, size_t size) {
  uint8_t* const bytes = malloc(size > 0 ? size : 1);
  if (bytes == NULL) return complain(path);
  const int whole = fread(bytes, 1, size, file) == size;
  if (whole) {
    /* Said before, so that a crash names its input. */
    printf("%s (%lu bytes)\n", path, (unsigned long)size);
    fflush(stdout);
    LLVMFuzzerTestOneInput(bytes, size);
    ++inputs;
  }
  free(bytes);
  return whole ? EXIT_SUCCESS : complain(path);
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

int main(int argc, char** argv) {
  int status = EXIT_SUCCESS;
  for (int i = 1; i < argc; ++i) {
    if (feed_path(argv[i]) != EXIT_SUCCESS) status = EXIT_FAILURE;
  }
  printf("%lu inputs\n", inputs);
  return inputs > 0 ? status : EXIT_FAILURE; /* nothing was tried: nothing was shown */
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/*
 * The whole loop as a controller runs it: frames in, one process image per frame out. C99 and the archive alone.
 *
 *     cc -std=c99 -Iinclude tools/apps/plc/controller.c build/release/libpose_wall.a -lm -o controller
 *     ./controller [-c pose_wall.yaml] [-o images.bin] frame.bin frame.pcd ...
 *
 * Reads KITTI .bin (float32 x y z intensity) and binary .pcd whose x y z are float32. Frames are taken as 0.1 s apart.
 * Prints a line per image: sequence, verdict, then value, protection level and state of each quantity, as
 * `pose_wall run` has them in its CSV ("-" where there is none). A frame that cannot be read gives no image, and the
 * sequence stands still: that is what the controller's watchdog is for.
 */

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pose_wall.h"

#define BLOCK_BYTES (64u * 1024u * 1024u)
#define FILE_BYTES (16u * 1024u * 1024u)
#define PCD_FIELDS 32

static unsigned char memory[BLOCK_BYTES + POSE_WALL_BLOCK_ALIGNMENT];
static unsigned char file_bytes[FILE_BYTES + 1];

static int complain(const char* what, const char* why) {
  fprintf(stderr, "%s: %s\n", what, why);
  return 1;
}

static size_t read_file(const char* path) {
  FILE* file = fopen(path, "rb");
  if (file == NULL) return 0;
  const size_t bytes = fread(file_bytes, 1, FILE_BYTES, file);
  const int whole = !ferror(file) && fgetc(file) == EOF;
  fclose(file);
  file_bytes[bytes] = '\0';
  return whole ? bytes : 0;
}

/* Copies the words behind a PCD key into rows; returns how many there are. */
static int pcd_words(const char* header, const char* key, char rows[PCD_FIELDS][16]) {
  const char* at = strstr(header, key);
  int count = 0;
  if (at == NULL) return 0;
  at += strlen(key);
  while (count < PCD_FIELDS) {
    int length = 0;
    while (*at == ' ') ++at;
    while (length < 15 && isgraph((unsigned char)at[length])) ++length;
    if (length == 0) break;
    memcpy(rows[count], at, (size_t)length);
    rows[count++][length] = '\0';
    at += length;
  }
  return count;
}

/* Where x, y and z lie in a point. Every field counts for the size of a point. */
static int pcd_fields(const char* header, pose_wall_cloud* cloud) {
  char names[PCD_FIELDS][16], sizes[PCD_FIELDS][16], types[PCD_FIELDS][16], counts[PCD_FIELDS][16];
  const int fields = pcd_words(header, "\nFIELDS", names);
  const int counted = pcd_words(header, "\nCOUNT", counts);
  if (pcd_words(header, "\nSIZE", sizes) != fields || pcd_words(header, "\nTYPE", types) != fields) return 0;
  for (int i = 0; i < fields; ++i) {
    const pose_wall_field field = {cloud->point_step, POSE_WALL_FIELD_FLOAT32};
    const int is_float32 = strcmp(sizes[i], "4") == 0 && strcmp(types[i], "F") == 0;
    if (strcmp(names[i], "x") == 0 && is_float32) cloud->x = field;
    if (strcmp(names[i], "y") == 0 && is_float32) cloud->y = field;
    if (strcmp(names[i], "z") == 0 && is_float32) cloud->z = field;
    cloud->point_step += (uint32_t)(atoi(sizes[i]) * (counted == fields ? atoi(counts[i]) : 1));
  }
  return cloud->x.type != POSE_WALL_FIELD_NONE && cloud->y.type != POSE_WALL_FIELD_NONE &&
         cloud->z.type != POSE_WALL_FIELD_NONE;
}

/* Describes the file's own bytes; the engine reads them in place, and checks what is said of them here. */
static int describe_pcd(size_t bytes, pose_wall_cloud* cloud) {
  static const char end_of_header[] = "\nDATA binary\n";
  char count[PCD_FIELDS][16];
  char* data = strstr((char*)file_bytes, end_of_header);
  if (data == NULL) return 0;
  *data = '\0';
  data += strlen(end_of_header);
  pose_wall_cloud_xyz32(cloud, data, 0, 0, 0);
  cloud->x.type = cloud->y.type = cloud->z.type = POSE_WALL_FIELD_NONE;
  if (!pcd_fields((char*)file_bytes, cloud)) return 0;
  if (pcd_words((char*)file_bytes, "\nPOINTS", count) != 1) return 0;
  cloud->width = (uint32_t)strtoul(count[0], NULL, 10);
  cloud->data_bytes = bytes - (size_t)((unsigned char*)data - file_bytes);
  return 1;
}

static int read_frame(const char* path, pose_wall_cloud* cloud) {
  const size_t bytes = read_file(path);
  const size_t length = strlen(path);
  if (bytes == 0 || length < 4) return 0;
  if (strcmp(path + length - 4, ".pcd") == 0) return describe_pcd(bytes, cloud);
  if (strcmp(path + length - 4, ".bin") != 0 || bytes % 16 != 0) return 0;
  return pose_wall_cloud_xyz32(cloud, file_bytes, (uint32_t)(bytes / 16), 16, 0) == POSE_WALL_OK;
}

/* Lines "key: value"; what stands behind # is left out. */
static int read_config(const char* path, pose_wall_config* config) {
  char line[512];
  FILE* file = fopen(path, "r");
  if (file == NULL) return complain(path, "cannot be opened");
  int failed = 0;
  while (fgets(line, sizeof line, file) != NULL) {
    line[strcspn(line, "#\r\n")] = '\0';
    char* value = strchr(line, ':');
    if (value == NULL) continue;
    *value++ = '\0';
    value += strspn(value, " \"'");
    size_t length = strlen(value);
    while (length > 0 && strchr(" \"'", value[length - 1]) != NULL) value[--length] = '\0';
    const int32_t status = pose_wall_config_set(config, line, value);
    if (status != POSE_WALL_OK) failed = complain(line, pose_wall_status_text(status));
  }
  fclose(file);
  return failed;
}

static void print_number(const char* name, double value) {
  printf(" %s=", name);
  if (value - value == 0.0) {
    printf("%.9g", value);
  } else {
    printf("-");
  }
}

static void print_line(const pose_wall_result* result, const pose_wall_image* image) {
  printf("%lu %s", (unsigned long)image->sequence, pose_wall_state_name(image->verdict));
  for (uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value* value = &result->quantity[q];
    print_number(pose_wall_quantity_name(q), value->value);
    print_number("pl", value->protection_level);
    printf(" %s", pose_wall_state_name(value->state));
  }
  printf(" crc=%08lX\n", (unsigned long)image->crc32);
}

static int control(pose_wall_engine* engine, char** paths, int count, FILE* images) {
  int failed = 0;
  for (int i = 0; i < count; ++i) {
    pose_wall_cloud cloud;
    pose_wall_result result;
    pose_wall_image image;
    result.struct_size = sizeof result;
    image.struct_size = sizeof image;
    if (!read_frame(paths[i], &cloud)) {
      failed = complain(paths[i], "is no frame that can be read here");
      continue;
    }
    cloud.stamp_ns = (int64_t)i * 100000000;
    int32_t status = pose_wall_process(engine, &cloud, &result);
    if (status == POSE_WALL_OK) status = pose_wall_image_fill(&result, &image);
    /* What leaves is looked at once more: memory fails, too. */
    if (status == POSE_WALL_OK) status = pose_wall_image_check(&image);
    if (status != POSE_WALL_OK) {
      failed = complain(paths[i], pose_wall_status_text(status));
      continue;
    }
    print_line(&result, &image);
    if (images != NULL && fwrite(&image, sizeof image, 1, images) != 1) return complain("images", "cannot be written");
  }
  return failed;
}

int main(int argc, char** argv) {
  const uintptr_t alignment = POSE_WALL_BLOCK_ALIGNMENT;
  unsigned char* const block = memory + (alignment - (uintptr_t)memory % alignment) % alignment;
  pose_wall_config config;
  pose_wall_engine* engine = NULL;
  FILE* images = NULL;
  int first = 1;
  if (pose_wall_abi_version() != POSE_WALL_ABI_VERSION) return complain("libpose_wall.a", "of another ABI");
  pose_wall_config_init(&config);
  for (; first < argc && argv[first][0] == '-'; first += 2) {
    const char* word = first + 1 < argc ? argv[first + 1] : NULL;
    if (word != NULL && strcmp(argv[first], "-c") == 0) {
      if (read_config(word, &config) != 0) return 2;
    } else if (word != NULL && strcmp(argv[first], "-o") == 0) {
      images = fopen(word, "wb");
      if (images == NULL) return complain(word, "cannot be written");
    } else {
      return complain(argv[first], "is no option, or lacks its file"), 2;
    }
  }
  if (first >= argc) return complain("usage", "controller [-c pose_wall.yaml] [-o images.bin] FRAME..."), 2;
  const int32_t status = pose_wall_open(&config, block, BLOCK_BYTES, &engine);
  if (status != POSE_WALL_OK) return complain("pose_wall_open", pose_wall_status_text(status)), 2;
  int failed = control(engine, argv + first, argc - first, images);
  if (images != NULL && fclose(images) != 0) failed = complain("images", "cannot be written");
  return failed;
}

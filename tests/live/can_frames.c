/* SPDX-License-Identifier: BSD-3-Clause
 * Copyright (c) 2026 the pose_wall authors
 *
 * Process images in, frames of CAN out, for can_peer.py. Of each line "image2 HEX", "motion_image HEX" or
 * "stop_image HEX", the bytes of an image, it prints one line: the frames of 11 bits, then those of J1939, each as
 * "ID#DATA" in hex. An image that is refused gives an empty line. Of "command HEX", the words counter, speed and turn,
 * it prints the frame of a command under the identifiers of the DBC files. */

#include <stdio.h>
#include <string.h>

#include "can_images.h"

enum { kMost = POSE_WALL_CAN_NUMBERS, kBytesMost = 1024 };

static void print_frames(const pose_wall_can_frame* frames, uint32_t count) {
  uint32_t i;
  int byte;
  for (i = 0; i < count; ++i) {
    printf(frames[i].is_long ? "%08X#" : "%03X#", (unsigned)frames[i].id);
    for (byte = 0; byte < 8; ++byte) printf("%02X", frames[i].data[byte]);
    printf(" ");
  }
}

static void print_image(const char* kind, const unsigned char* bytes) {
  const pose_wall_can_bus buses[] = {{0, POSE_WALL_CAN_FIRST_ID, 0},
                                     {1, POSE_WALL_CAN_FIRST_PGN, POSE_WALL_CAN_ADDRESS}};
  pose_wall_can_frame frames[kMost];
  pose_wall_image2 image;
  pose_wall_motion_image motion;
  pose_wall_planar_stop_image stop;
  int k;
  memcpy(&image, bytes, sizeof(image));
  memcpy(&motion, bytes, sizeof(motion));
  memcpy(&stop, bytes, sizeof(stop));
  for (k = 0; k < 2; ++k) {
    uint32_t count = 0;
    if (strcmp(kind, "image2") == 0) count = pose_wall_can_of_image2(&image, &buses[k], frames);
    if (strcmp(kind, "motion_image") == 0) count = pose_wall_can_of_motion_image(&motion, &buses[k], frames);
    if (strcmp(kind, "stop_image") == 0) count = pose_wall_can_of_stop_image(&stop, &buses[k], frames);
    print_frames(frames, count);
  }
  printf("\n");
}

static void print_command(const unsigned char* bytes) {
  pose_wall_can_frame frames[2] = {{0x687, 0, {0}}, {0x0CFF07FE, 1, {0}}};
  pose_wall_can_command command;
  int k;
  memcpy(&command, bytes, sizeof(command));
  for (k = 0; k < 2; ++k) {
    if (pose_wall_can_write_command(&command, frames[k].data)) print_frames(&frames[k], 1);
  }
  printf("\n");
}

int main(void) {
  char kind[32], hex[2 * kBytesMost + 1];
  while (scanf("%31s %2048s", kind, hex) == 2) {
    unsigned char bytes[kBytesMost] = {0};
    size_t i;
    for (i = 0; hex[2 * i] != '\0' && i < kBytesMost; ++i) {
      unsigned value = 0;
      if (sscanf(hex + 2 * i, "%2x", &value) != 1) return 1;
      bytes[i] = (unsigned char)value;
    }
    if (strcmp(kind, "command") == 0) {
      print_command(bytes);
    } else {
      print_image(kind, bytes);
    }
  }
  return 0;
}

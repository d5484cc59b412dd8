/* SPDX-License-Identifier: BSD-3-Clause
 * Copyright (c) 2026 the pose_wall authors
 *
 * Written by tools/apps/plc/generate.py from can.def.
 *
 * Frames of each process image. Each function checks the image's CRC first: a damaged image gives no frame. Returns how
 * many frames it wrote, or 0: a NULL, an image of another version or with a wrong CRC, a bus without room. */
#ifndef POSE_WALL_CAN_IMAGES_H
#define POSE_WALL_CAN_IMAGES_H

#include "can_frames.h"
#include "pose_wall.h"
#include "pose_wall_motion.h"
#include "pose_wall_planar_stop.h"

#ifdef __cplusplus
extern "C" {
#endif

#define POSE_WALL_CAN_STOP_IMAGE_FRAMES 3
uint32_t pose_wall_can_of_stop_image(const pose_wall_planar_stop_image* image, const pose_wall_can_bus* bus,
                                     pose_wall_can_frame frames[POSE_WALL_CAN_STOP_IMAGE_FRAMES]);

#define POSE_WALL_CAN_IMAGE2_FRAMES 17
uint32_t pose_wall_can_of_image2(const pose_wall_image2* image, const pose_wall_can_bus* bus,
                                 pose_wall_can_frame frames[POSE_WALL_CAN_IMAGE2_FRAMES]);

#define POSE_WALL_CAN_MOTION_IMAGE_FRAMES 13
uint32_t pose_wall_can_of_motion_image(const pose_wall_motion_image* image, const pose_wall_can_bus* bus,
                                       pose_wall_can_frame frames[POSE_WALL_CAN_MOTION_IMAGE_FRAMES]);

#ifdef __cplusplus
}
#endif

#endif

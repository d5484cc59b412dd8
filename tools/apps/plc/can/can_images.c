/* SPDX-License-Identifier: BSD-3-Clause
 * Copyright (c) 2026 the pose_wall authors
 *
 * Written by tools/apps/plc/generate.py from can.def. */

#include "can_images.h"

/* clang-format off */
static const pose_wall_can_signal stop_image_signals[] = {
    {0, 1, 8, POSE_WALL_CAN_BITS, 16, 2}, /* Stop: state */
    {0, 1, 9, POSE_WALL_CAN_SIGNED, 18, 20}, /* Stop: allowed_speed_mm_s */
    {0, 1, 11, POSE_WALL_CAN_LIMIT, 38, 16}, /* Stop: age_ms */
    {1, 3, 10, POSE_WALL_CAN_BITS, 16, 32}, /* StopReasons: reasons */
    {1, 3, 12, POSE_WALL_CAN_BITS, 48, 16}, /* StopReasons: answered_ms */
    {2, 6, 4, POSE_WALL_CAN_BITS, 16, 32}, /* StopSettings: settings_crc32 */
};
/* clang-format on */

uint32_t pose_wall_can_of_stop_image(const pose_wall_planar_stop_image* image, const pose_wall_can_bus* bus,
                                     pose_wall_can_frame frames[POSE_WALL_CAN_STOP_IMAGE_FRAMES]) {
  const uint32_t count = sizeof(stop_image_signals) / sizeof(stop_image_signals[0]);
  if (!image || !bus || !frames || !pose_wall_can_bus_is_sound(bus)) return 0;
  if (pose_wall_planar_stop_image_check(image) != POSE_WALL_OK) return 0;
  return pose_wall_can_pack(image, 3, stop_image_signals, count, bus, frames);
}

/* clang-format off */
static const pose_wall_can_signal image2_signals[] = {
    {8, 3, 3, POSE_WALL_CAN_BITS, 16, 16}, /* Status: sequence */
    {8, 3, 15, POSE_WALL_CAN_BITS, 32, 7}, /* Status: valid */
    {8, 3, 14, POSE_WALL_CAN_BITS, 39, 2}, /* Status: verdict */
    {8, 3, 13, POSE_WALL_CAN_BITS, 41, 2}, /* Status: told_by */
    {8, 3, 11, POSE_WALL_CAN_LIMIT, 43, 8}, /* Status: thinning */
    {8, 3, 9, POSE_WALL_CAN_BITS, 51, 8}, /* Status: source_id */
    {9, 6, 16, POSE_WALL_CAN_BITS, 16, 32}, /* Reasons: frame_reasons */
    {9, 6, 10, POSE_WALL_CAN_LIMIT, 48, 16}, /* Reasons: latency_ms */
    {10, 6, 5, POSE_WALL_CAN_BITS, 16, 32}, /* Config: config_crc32 */
    {10, 6, 12, POSE_WALL_CAN_LIMIT, 48, 8}, /* Config: held_thinning */
    {16, 3, 17, POSE_WALL_CAN_SIGNED, 16, 20}, /* Roll: roll.value_mdeg */
    {16, 3, 18, POSE_WALL_CAN_LEVEL, 36, 16}, /* Roll: roll.protection_mdeg */
    {16, 3, 20, POSE_WALL_CAN_BITS, 52, 2}, /* Roll: roll.state */
    {16, 3, 22, POSE_WALL_CAN_BITS, 54, 3}, /* Roll: roll.cause */
    {16, 3, 23, POSE_WALL_CAN_BITS, 57, 3}, /* Roll: roll.positive_means */
    {17, 6, 21, POSE_WALL_CAN_BITS, 16, 32}, /* RollWhy: roll.reasons */
    {17, 6, 19, POSE_WALL_CAN_LIMIT, 48, 16}, /* RollWhy: roll.age_ms */
    {18, 3, 24, POSE_WALL_CAN_SIGNED, 16, 20}, /* Pitch: pitch.value_mdeg */
    {18, 3, 25, POSE_WALL_CAN_LEVEL, 36, 16}, /* Pitch: pitch.protection_mdeg */
    {18, 3, 27, POSE_WALL_CAN_BITS, 52, 2}, /* Pitch: pitch.state */
    {18, 3, 29, POSE_WALL_CAN_BITS, 54, 3}, /* Pitch: pitch.cause */
    {18, 3, 30, POSE_WALL_CAN_BITS, 57, 3}, /* Pitch: pitch.positive_means */
    {19, 6, 28, POSE_WALL_CAN_BITS, 16, 32}, /* PitchWhy: pitch.reasons */
    {19, 6, 26, POSE_WALL_CAN_LIMIT, 48, 16}, /* PitchWhy: pitch.age_ms */
    {20, 3, 31, POSE_WALL_CAN_SIGNED, 16, 20}, /* Yaw: yaw.value_mdeg */
    {20, 3, 32, POSE_WALL_CAN_LEVEL, 36, 16}, /* Yaw: yaw.protection_mdeg */
    {20, 3, 34, POSE_WALL_CAN_BITS, 52, 2}, /* Yaw: yaw.state */
    {20, 3, 36, POSE_WALL_CAN_BITS, 54, 3}, /* Yaw: yaw.cause */
    {20, 3, 37, POSE_WALL_CAN_BITS, 57, 3}, /* Yaw: yaw.positive_means */
    {21, 6, 35, POSE_WALL_CAN_BITS, 16, 32}, /* YawWhy: yaw.reasons */
    {21, 6, 33, POSE_WALL_CAN_LIMIT, 48, 16}, /* YawWhy: yaw.age_ms */
    {22, 3, 38, POSE_WALL_CAN_SIGNED, 16, 20}, /* LeftFront: d_lf.value_mm */
    {22, 3, 39, POSE_WALL_CAN_LEVEL, 36, 16}, /* LeftFront: d_lf.protection_mm */
    {22, 3, 41, POSE_WALL_CAN_BITS, 52, 2}, /* LeftFront: d_lf.state */
    {22, 3, 43, POSE_WALL_CAN_BITS, 54, 3}, /* LeftFront: d_lf.cause */
    {23, 6, 42, POSE_WALL_CAN_BITS, 16, 32}, /* LeftFrontWhy: d_lf.reasons */
    {23, 6, 40, POSE_WALL_CAN_LIMIT, 48, 16}, /* LeftFrontWhy: d_lf.age_ms */
    {24, 3, 44, POSE_WALL_CAN_SIGNED, 16, 20}, /* LeftBack: d_lb.value_mm */
    {24, 3, 45, POSE_WALL_CAN_LEVEL, 36, 16}, /* LeftBack: d_lb.protection_mm */
    {24, 3, 47, POSE_WALL_CAN_BITS, 52, 2}, /* LeftBack: d_lb.state */
    {24, 3, 49, POSE_WALL_CAN_BITS, 54, 3}, /* LeftBack: d_lb.cause */
    {25, 6, 48, POSE_WALL_CAN_BITS, 16, 32}, /* LeftBackWhy: d_lb.reasons */
    {25, 6, 46, POSE_WALL_CAN_LIMIT, 48, 16}, /* LeftBackWhy: d_lb.age_ms */
    {26, 3, 50, POSE_WALL_CAN_SIGNED, 16, 20}, /* RightFront: d_rf.value_mm */
    {26, 3, 51, POSE_WALL_CAN_LEVEL, 36, 16}, /* RightFront: d_rf.protection_mm */
    {26, 3, 53, POSE_WALL_CAN_BITS, 52, 2}, /* RightFront: d_rf.state */
    {26, 3, 55, POSE_WALL_CAN_BITS, 54, 3}, /* RightFront: d_rf.cause */
    {27, 6, 54, POSE_WALL_CAN_BITS, 16, 32}, /* RightFrontWhy: d_rf.reasons */
    {27, 6, 52, POSE_WALL_CAN_LIMIT, 48, 16}, /* RightFrontWhy: d_rf.age_ms */
    {28, 3, 56, POSE_WALL_CAN_SIGNED, 16, 20}, /* RightBack: d_rb.value_mm */
    {28, 3, 57, POSE_WALL_CAN_LEVEL, 36, 16}, /* RightBack: d_rb.protection_mm */
    {28, 3, 59, POSE_WALL_CAN_BITS, 52, 2}, /* RightBack: d_rb.state */
    {28, 3, 61, POSE_WALL_CAN_BITS, 54, 3}, /* RightBack: d_rb.cause */
    {29, 6, 60, POSE_WALL_CAN_BITS, 16, 32}, /* RightBackWhy: d_rb.reasons */
    {29, 6, 58, POSE_WALL_CAN_LIMIT, 48, 16}, /* RightBackWhy: d_rb.age_ms */
};
/* clang-format on */

uint32_t pose_wall_can_of_image2(const pose_wall_image2* image, const pose_wall_can_bus* bus,
                                 pose_wall_can_frame frames[POSE_WALL_CAN_IMAGE2_FRAMES]) {
  const uint32_t count = sizeof(image2_signals) / sizeof(image2_signals[0]);
  if (!image || !bus || !frames || !pose_wall_can_bus_is_sound(bus)) return 0;
  if (pose_wall_image2_check(image) != POSE_WALL_OK) return 0;
  return pose_wall_can_pack(image, 4, image2_signals, count, bus, frames);
}

/* clang-format off */
static const pose_wall_can_signal motion_image_signals[] = {
    {32, 3, 3, POSE_WALL_CAN_BITS, 16, 16}, /* MotionStatus: sequence */
    {32, 3, 13, POSE_WALL_CAN_BITS, 32, 2}, /* MotionStatus: told_by */
    {32, 3, 14, POSE_WALL_CAN_BITS, 34, 2}, /* MotionStatus: along_state */
    {32, 3, 12, POSE_WALL_CAN_LIMIT, 36, 8}, /* MotionStatus: thinning */
    {32, 3, 10, POSE_WALL_CAN_BITS, 44, 8}, /* MotionStatus: source_id */
    {33, 6, 15, POSE_WALL_CAN_BITS, 16, 32}, /* MotionReasons: reasons */
    {33, 6, 11, POSE_WALL_CAN_LIMIT, 48, 16}, /* MotionReasons: latency_ms */
    {34, 6, 5, POSE_WALL_CAN_BITS, 16, 32}, /* MotionRun: run */
    {35, 6, 6, POSE_WALL_CAN_BITS, 16, 32}, /* MotionConfig: config_crc32 */
    {36, 3, 16, POSE_WALL_CAN_SIGNED, 16, 32}, /* Travel: travel_mm */
    {36, 3, 17, POSE_WALL_CAN_LEVEL, 48, 16}, /* Travel: travel_protection_mm */
    {37, 6, 18, POSE_WALL_CAN_SIGNED, 16, 32}, /* PlaceX: x_mm */
    {37, 6, 22, POSE_WALL_CAN_LEVEL, 48, 16}, /* PlaceX: up_protection_mm */
    {38, 6, 19, POSE_WALL_CAN_SIGNED, 16, 32}, /* PlaceY: y_mm */
    {38, 6, 21, POSE_WALL_CAN_LEVEL, 48, 16}, /* PlaceY: across_protection_mm */
    {39, 6, 20, POSE_WALL_CAN_SIGNED, 16, 32}, /* PlaceZ: z_mm */
    {40, 6, 23, POSE_WALL_CAN_SIGNED, 16, 20}, /* TurnedRoll: roll_mdeg */
    {40, 6, 26, POSE_WALL_CAN_LEVEL, 36, 16}, /* TurnedRoll: roll_protection_mdeg */
    {41, 6, 24, POSE_WALL_CAN_SIGNED, 16, 20}, /* TurnedPitch: pitch_mdeg */
    {41, 6, 27, POSE_WALL_CAN_LEVEL, 36, 16}, /* TurnedPitch: pitch_protection_mdeg */
    {42, 6, 25, POSE_WALL_CAN_SIGNED, 16, 20}, /* TurnedYaw: yaw_mdeg */
    {42, 6, 28, POSE_WALL_CAN_LEVEL, 36, 16}, /* TurnedYaw: yaw_protection_mdeg */
    {43, 3, 29, POSE_WALL_CAN_SIGNED, 16, 24}, /* Speed: speed_mm_s */
    {43, 3, 30, POSE_WALL_CAN_LEVEL, 40, 16}, /* Speed: speed_protection_mm_s */
    {44, 3, 31, POSE_WALL_CAN_SIGNED, 16, 24}, /* TurnRate: turn_mdeg_s */
    {44, 3, 32, POSE_WALL_CAN_LEVEL, 40, 16}, /* TurnRate: turn_protection_mdeg_s */
};
/* clang-format on */

uint32_t pose_wall_can_of_motion_image(const pose_wall_motion_image* image, const pose_wall_can_bus* bus,
                                       pose_wall_can_frame frames[POSE_WALL_CAN_MOTION_IMAGE_FRAMES]) {
  const uint32_t count = sizeof(motion_image_signals) / sizeof(motion_image_signals[0]);
  if (!image || !bus || !frames || !pose_wall_can_bus_is_sound(bus)) return 0;
  if (pose_wall_motion_image_check(image) != POSE_WALL_OK) return 0;
  return pose_wall_can_pack(image, 4, motion_image_signals, count, bus, frames);
}

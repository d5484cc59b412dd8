// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the numbers of every public enum and constant are those that programs were built against. Where the members
// of structs lie is pinned by tests/checks/abi_layout.txt. A change here breaks users: raise POSE_WALL_ABI_VERSION.

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "pose_wall.h"
#include "pose_wall_motion.h"
#include "pose_wall_planar_stop.h"

namespace {

TEST(AbiNumbers, Versions) {
  EXPECT_EQ(POSE_WALL_ABI_VERSION, 2);
  EXPECT_EQ(pose_wall_abi_version(), static_cast<std::uint32_t>(POSE_WALL_ABI_VERSION));
  EXPECT_EQ(std::to_string(POSE_WALL_VERSION_MAJOR) + "." + std::to_string(POSE_WALL_VERSION_MINOR) + "." +
                std::to_string(POSE_WALL_VERSION_PATCH),
            pose_wall_version());
}

TEST(AbiNumbers, Status) {
  EXPECT_EQ(POSE_WALL_OK, 0);
  EXPECT_EQ(POSE_WALL_E_NULL, -1);
  EXPECT_EQ(POSE_WALL_E_STRUCT_SIZE, -2);
  EXPECT_EQ(POSE_WALL_E_BLOCK_SMALL, -3);
  EXPECT_EQ(POSE_WALL_E_BLOCK_ALIGN, -4);
  EXPECT_EQ(POSE_WALL_E_ENGINE, -5);
  EXPECT_EQ(POSE_WALL_E_INDEX, -6);
  EXPECT_EQ(POSE_WALL_E_BUFFER_SMALL, -7);
  EXPECT_EQ(POSE_WALL_E_MEMENTO, -8);
  EXPECT_EQ(POSE_WALL_E_BUSY, -9);
  EXPECT_EQ(POSE_WALL_E_ABI, -10);
  EXPECT_EQ(POSE_WALL_E_STRUCT_NEWER, -11);
  EXPECT_EQ(POSE_WALL_E_INPUT, -12);
  EXPECT_EQ(POSE_WALL_E_KEY_UNKNOWN, -20);
  EXPECT_EQ(POSE_WALL_E_VALUE_TYPE, -21);
  EXPECT_EQ(POSE_WALL_E_VALUE_RANGE, -22);
  EXPECT_EQ(POSE_WALL_E_CONFIG_RULE, -23);
  EXPECT_EQ(POSE_WALL_E_TEXT_LONG, -24);
  EXPECT_EQ(POSE_WALL_E_CLOUD_FIELD, -40);
  EXPECT_EQ(POSE_WALL_E_CLOUD_STEP, -41);
  EXPECT_EQ(POSE_WALL_E_CLOUD_SIZE, -42);
  EXPECT_EQ(POSE_WALL_E_IMAGE_VERSION, -60);
  EXPECT_EQ(POSE_WALL_E_IMAGE_CRC, -61);
  EXPECT_EQ(POSE_WALL_E_RESULT, -62);
  EXPECT_EQ(POSE_WALL_E_SELF_TEST, -80);
}

TEST(AbiNumbers, KindsAndOrders) {
  EXPECT_EQ(POSE_WALL_KEY_NUMBER, 1);
  EXPECT_EQ(POSE_WALL_KEY_INTEGER, 2);
  EXPECT_EQ(POSE_WALL_KEY_CHOICE, 3);
  EXPECT_EQ(POSE_WALL_KEY_TEXT, 4);
  EXPECT_EQ(POSE_WALL_KEY_BOX, 5);
  const int fields[] = {POSE_WALL_FIELD_NONE,   POSE_WALL_FIELD_INT8,    POSE_WALL_FIELD_UINT8,
                        POSE_WALL_FIELD_INT16,  POSE_WALL_FIELD_UINT16,  POSE_WALL_FIELD_INT32,
                        POSE_WALL_FIELD_UINT32, POSE_WALL_FIELD_FLOAT32, POSE_WALL_FIELD_FLOAT64};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(fields[i], i) << "numbers of sensor_msgs/PointField";
  const int quantities[] = {POSE_WALL_ROLL, POSE_WALL_PITCH, POSE_WALL_YAW,  POSE_WALL_D_LF,
                            POSE_WALL_D_LB, POSE_WALL_D_RF,  POSE_WALL_D_RB, POSE_WALL_QUANTITIES};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(quantities[i], i);
  const int states[] = {POSE_WALL_INVALID, POSE_WALL_HELD, POSE_WALL_DEGRADED, POSE_WALL_VALID};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(states[i], i);
  const int stages[] = {POSE_WALL_STAGE_VOXEL, POSE_WALL_STAGE_OUTLIERS, POSE_WALL_STAGE_FLOOR, POSE_WALL_STAGE_BAND,
                        POSE_WALL_STAGE_WALLS, POSE_WALL_STAGE_OUTPUT,   POSE_WALL_STAGES};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(stages[i], i);
  const int parts[] = {
      POSE_WALL_PART_RANDOM,        POSE_WALL_PART_RANGE_BIAS, POSE_WALL_PART_BEND, POSE_WALL_PART_RIVAL,
      POSE_WALL_PART_EXTRAPOLATION, POSE_WALL_PART_LAG,        POSE_WALL_PART_AGE,  POSE_WALL_PARTS};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(parts[i], i);
  const int senses[] = {POSE_WALL_SENSE_UNKNOWN,   POSE_WALL_SENSE_RIGHT_DOWN, POSE_WALL_SENSE_LEFT_DOWN,
                        POSE_WALL_SENSE_NOSE_DOWN, POSE_WALL_SENSE_NOSE_UP,    POSE_WALL_SENSE_TURNED_RIGHT};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(senses[i], i);
  EXPECT_EQ(POSE_WALL_INPUT_STANDING, 1);
  EXPECT_EQ(POSE_WALL_INPUT_SPEED, 2);
  EXPECT_EQ(POSE_WALL_INPUT_TURN_RATE, 4);
  EXPECT_EQ(POSE_WALL_MOMENT_BOOT, 1);
  EXPECT_EQ(POSE_WALL_MOMENT_WALL, 2);
  EXPECT_EQ(POSE_WALL_MOMENT_SAME_CLOCK, 4);
  const int labels[] = {POSE_WALL_LABEL_OTHER, POSE_WALL_LABEL_FLOOR, POSE_WALL_LABEL_LEFT, POSE_WALL_LABEL_RIGHT};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(labels[i], i);
}

TEST(AbiNumbers, Reasons) {
  const int reasons[] = {POSE_WALL_R_NO_POINTS,
                         POSE_WALL_R_LEAF_GROWN,
                         POSE_WALL_R_STAMP_STILL,
                         POSE_WALL_R_STAMP_BACK,
                         POSE_WALL_R_STAMP_LEAP,
                         POSE_WALL_R_FROZEN,
                         POSE_WALL_R_FLOOR_NOT_FOUND,
                         POSE_WALL_R_FLOOR_FEW_INLIERS,
                         POSE_WALL_R_FLOOR_THIN,
                         POSE_WALL_R_FLOOR_AMBIGUOUS,
                         POSE_WALL_R_WALL_NOT_FOUND,
                         POSE_WALL_R_WALL_FEW_INLIERS,
                         POSE_WALL_R_WALL_SHORT,
                         POSE_WALL_R_WALL_LEANS,
                         POSE_WALL_R_WALL_SEEN_THROUGH,
                         POSE_WALL_R_WALL_AMBIGUOUS,
                         POSE_WALL_R_WALLS_NOT_PARALLEL,
                         POSE_WALL_R_YAW_OUT_OF_RANGE,
                         POSE_WALL_R_CROSS_ROAD,
                         POSE_WALL_R_CURVED,
                         POSE_WALL_R_EXTRAPOLATED,
                         POSE_WALL_R_LEVEL_MISSING,
                         POSE_WALL_R_ALERT_LIMIT,
                         POSE_WALL_R_INNOVATION,
                         POSE_WALL_R_RATE_LIMITED,
                         POSE_WALL_R_HOLD_EXPIRED,
                         POSE_WALL_R_WALL_TOO_NEAR,
                         POSE_WALL_R_NEVER_MEASURED,
                         POSE_WALL_R_NO_FRAME,
                         POSE_WALL_R_WORK_LIMIT,
                         POSE_WALL_R_PRIOR};
  ASSERT_LE(sizeof reasons / sizeof reasons[0], static_cast<std::size_t>(POSE_WALL_REASON_COUNT));
  for (std::size_t bit = 0; bit < sizeof reasons / sizeof reasons[0]; ++bit) EXPECT_EQ(reasons[bit], 1 << bit);
}

TEST(AbiNumbers, Constants) {
  EXPECT_EQ(POSE_WALL_BLOCK_ALIGNMENT, 64);
  EXPECT_EQ(POSE_WALL_TEXT_MAX, 64);
  EXPECT_EQ(POSE_WALL_CONFIG_NUMBERS, 160);
  EXPECT_EQ(POSE_WALL_CONFIG_TEXTS, 3);
  EXPECT_EQ(POSE_WALL_IMAGE_VERSION, 1);
  EXPECT_EQ(POSE_WALL_IMAGE_BYTES, 240);
  EXPECT_EQ(POSE_WALL_IMAGE2_VERSION, 2);
  EXPECT_EQ(POSE_WALL_MOTION_IMAGE_VERSION, 3) << "one number each: a controller tells them by it";
  EXPECT_EQ(POSE_WALL_PLANAR_STOP_IMAGE_VERSION, 4);
  EXPECT_EQ(POSE_WALL_IMAGE_NO_VALUE, -2147483647 - 1);
  EXPECT_EQ(POSE_WALL_IMAGE_NO_BOUND, 2147483647);
}

}  // namespace

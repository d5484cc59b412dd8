/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Half tangents: 0.0437 is 5 degrees, 0.00873 is 1 degree. */

#include "roadway.h"

#include <stddef.h>

static const setting kDefaults[] = {{NULL, NULL}};

static const setting kSparse[] = {{"outlier_radius", "0.40"},        {"outlier_min_neighbors", "2"},
                                  {"ground_inlier_min", "150"},      {"wall_inlier_min", "250"},
                                  {"ground_roi_radius_max", "15.0"}, {NULL, NULL}};

static const roadway rough_vlp16 = {
    .name = "rough_vlp16",
    .scanner = {16, 1800, {-0.1317, 0.1317}},
    .half_width_m = 2.6,
    .height_m = 3.4,
    .face_x_m = 25.0,
    .rough_m = 0.06,
    .noise_m = 0.012,
    .sensor_y_m = 0.3,
    .sensor_z_m = 1.4,
    .roll_t = 0.0087,
    .pitch_t = -0.0131,
    .yaw_t = 0.035,
    .step_m = 0.02,
    .frames = 3,
    .settings = kSparse,
};

static const roadway flat_os1_64 = {
    .name = "flat_os1_64",
    .scanner = {64, 1024, {-0.1989, 0.1989}},
    .half_width_m = 3.0,
    .height_m = 3.8,
    .face_x_m = 40.0,
    .noise_m = 0.01,
    .sensor_y_m = -0.4,
    .sensor_z_m = 1.8,
    .pitch_t = 0.0175,
    .yaw_t = -0.061,
    .step_m = 0.05,
    .frames = 3,
    .settings = kDefaults,
};

static const roadway steel_sets_os1_64 = {
    .name = "steel_sets_os1_64",
    .scanner = {64, 1024, {-0.1989, 0.1989}},
    .half_width_m = 2.7,
    .height_m = 3.5,
    .face_x_m = 18.0,
    .rough_m = 0.04,
    .steel_m = 0.14,
    .noise_m = 0.012,
    .door_x = {4.0, 6.0},
    .sensor_y_m = 0.1,
    .sensor_z_m = 1.7,
    .roll_t = -0.02,
    .yaw_t = 0.02,
    .step_m = 0.1,
    .frames = 3,
    .settings = kDefaults,
};

static const setting kMounted[] = {
    {"extrinsic_yaw", "0.2"}, {"extrinsic_x", "0.75"}, {"extrinsic_z", "0.4"}, {NULL, NULL}};

static const roadway things_os0_128 = {
    .name = "things_os0_128",
    .scanner = {128, 1024, {-0.4142, 0.4142}},
    .half_width_m = 3.2,
    .height_m = 4.0,
    .face_x_m = 15.0,
    .rough_m = 0.03,
    .noise_m = 0.015,
    .sensor_z_m = 2.0,
    .roll_t = 0.01,
    .yaw_t = -0.02,
    .mount_yaw_t = 0.10033467208545055, /* 0.2 rad */
    .frames = 2,
    .box_count = 9,
    .boxes = {{{-8.0, 12.0}, {2.6, 2.9}, {0.3, 0.5}}, /* pipes */
              {{-8.0, 12.0}, {2.6, 2.9}, {0.8, 1.0}},
              {{-8.0, 12.0}, {2.6, 2.9}, {1.3, 1.5}},
              {{-10.0, 12.0}, {-2.9, -2.1}, {0.0, 1.1}}, /* conveyor */
              {{1.0, 1.2}, {-1.9, -1.7}, {0.0, 4.0}},    /* props */
              {{2.2, 2.4}, {-1.9, -1.7}, {0.0, 4.0}},
              {{3.4, 3.6}, {-1.9, -1.7}, {0.0, 4.0}},
              {{-9.0, -6.0}, {0.8, 2.3}, {0.0, 1.9}}, /* vehicle */
              {{6.0, 8.0}, {-1.0, 1.0}, {0.0, 0.8}}}, /* heap */
    .settings = kMounted,
};

static const setting kBackwardsByChance[] = {{"forward_axis", "-X"},         {"outlier_radius", "0.40"},
                                             {"outlier_min_neighbors", "2"}, {"ground_inlier_min", "150"},
                                             {"wall_inlier_min", "250"},     {NULL, NULL}};
static const roadway backwards_by_chance = {
    .name = "backwards_by_chance",
    .scanner = {0, 20000, {-0.2, 0.4}},
    .half_width_m = 2.4,
    .height_m = 3.0,
    .face_x_m = 30.0,
    .rough_m = 0.05,
    .noise_m = 0.02,
    .sensor_y_m = -0.2,
    .sensor_z_m = 1.1,
    .pitch_t = 0.0087,
    .yaw_t = 0.026,
    .step_m = 0.02,
    .frames = 3,
    .settings = kBackwardsByChance,
};

static const setting kFewVoxelsOs0128[] = {{"points_max", "16000"}, {"temporal_smoothing_tau", "0"}, {NULL, NULL}};
static const roadway few_voxels_os0_128 = {
    .name = "few_voxels_os0_128", /* the leaf grows */
    .scanner = {128, 1024, {-0.4142, 0.4142}},
    .half_width_m = 3.5,
    .height_m = 4.0,
    .face_x_m = 30.0,
    .rough_m = 0.05,
    .noise_m = 0.02,
    .sensor_y_m = 1.0,
    .sensor_z_m = 2.2,
    .roll_t = 0.03,
    .frames = 2,
    .settings = kFewVoxelsOs0128,
};

static const roadway faults_vlp16 = {
    .name = "faults_vlp16",
    .scanner = {16, 1800, {-0.1317, 0.1317}},
    .half_width_m = 2.5,
    .height_m = 3.2,
    .face_x_m = 20.0,
    .rough_m = 0.03,
    .noise_m = 0.012,
    .sensor_z_m = 1.5,
    .yaw_t = -0.03,
    .frames = 12,
    .faulty = 1,
    .settings = kSparse,
};

const roadway* const roadways[] = {&rough_vlp16,         &flat_os1_64,        &steel_sets_os1_64, &things_os0_128,
                                   &backwards_by_chance, &few_voxels_os0_128, &faults_vlp16};

const uint32_t roadway_count = sizeof roadways / sizeof roadways[0];

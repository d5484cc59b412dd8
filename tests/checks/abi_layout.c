/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* Prints where every member of the public structs lies, in C99. check_abi.cmake compares it with abi_layout.txt, or
 * with abi_layout_armv7.txt where pointers have 32 bits. A struct whose members do not fill it (implicit padding) ends
 * with status 1. Only a struct with pointers may have gaps, and only where these have 32 bits: nothing ever compares or
 * sums its bytes. */

#include "abi_layout.h"
#include "pose_wall.h"
#include "pose_wall_box.h"
#include "pose_wall_motion.h"
#include "pose_wall_planar_stop.h"
#include "pose_wall_runtime.h"

int planar_layout(void); /* abi_layout_planar.c */

static int config_layout(void) {
  MEMBER(pose_wall_config, struct_size);
  MEMBER(pose_wall_config, layout);
  MEMBER(pose_wall_config, number);
  MEMBER(pose_wall_config, text);
  return struct_end("pose_wall_config", sizeof(pose_wall_config));
}

static int cloud_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_odometry, run);
  MEMBER(pose_wall_odometry, position_m);
  MEMBER(pose_wall_odometry, quaternion);
  MEMBER(pose_wall_odometry, along);
  MEMBER(pose_wall_odometry, across);
  MEMBER(pose_wall_odometry, level);
  MEMBER(pose_wall_odometry, drift_variance);
  MEMBER(pose_wall_odometry, drift);
  MEMBER(pose_wall_odometry, velocity_m_s);
  MEMBER(pose_wall_odometry, turn_rate_rad_s);
  MEMBER(pose_wall_odometry, rate_level);
  padded += struct_end("pose_wall_odometry", sizeof(pose_wall_odometry));
  MEMBER(pose_wall_field, offset);
  MEMBER(pose_wall_field, type);
  padded += struct_end("pose_wall_field", sizeof(pose_wall_field));
  MEMBER(pose_wall_cloud, struct_size);
  MEMBER(pose_wall_cloud, big_endian);
  MEMBER(pose_wall_cloud, data);
  MEMBER(pose_wall_cloud, data_bytes);
  MEMBER(pose_wall_cloud, width);
  MEMBER(pose_wall_cloud, height);
  MEMBER(pose_wall_cloud, point_step);
  MEMBER(pose_wall_cloud, row_step);
  MEMBER(pose_wall_cloud, stamp_ns);
  MEMBER(pose_wall_cloud, x);
  MEMBER(pose_wall_cloud, y);
  MEMBER(pose_wall_cloud, z);
  MEMBER(pose_wall_cloud, intensity);
  MEMBER(pose_wall_cloud, time);
  MEMBER(pose_wall_cloud, inputs);
  MEMBER(pose_wall_cloud, ring);
  padded += struct_with_pointers_end("pose_wall_cloud", sizeof(pose_wall_cloud));
  MEMBER(pose_wall_inputs, struct_size);
  MEMBER(pose_wall_inputs, given);
  MEMBER(pose_wall_inputs, speed_m_s);
  MEMBER(pose_wall_inputs, speed_sigma_m_s);
  MEMBER(pose_wall_inputs, turn_rate_rad_s);
  MEMBER(pose_wall_inputs, turn_rate_sigma_rad_s);
  MEMBER(pose_wall_inputs, body_box);
  MEMBER(pose_wall_inputs, odometry);
  return padded + struct_end("pose_wall_inputs", sizeof(pose_wall_inputs));
}

static int value_layout(void) {
  MEMBER(pose_wall_value, value);
  MEMBER(pose_wall_value, raw);
  MEMBER(pose_wall_value, sigma);
  MEMBER(pose_wall_value, protection_level);
  MEMBER(pose_wall_value, raw_protection_level);
  MEMBER(pose_wall_value, confidence);
  MEMBER(pose_wall_value, age_s);
  MEMBER(pose_wall_value, part);
  MEMBER(pose_wall_value, state);
  MEMBER(pose_wall_value, reasons);
  MEMBER(pose_wall_value, raw_state);
  MEMBER(pose_wall_value, cause);
  MEMBER(pose_wall_value, reserved);
  return struct_end("pose_wall_value", sizeof(pose_wall_value));
}

static int plane_layout(void) {
  MEMBER(pose_wall_plane, normal);
  MEMBER(pose_wall_plane, d_m);
  MEMBER(pose_wall_plane, rms_m);
  MEMBER(pose_wall_plane, lean_rad);
  MEMBER(pose_wall_plane, extent_min_m);
  MEMBER(pose_wall_plane, extent_max_m);
  MEMBER(pose_wall_plane, area_m2);
  MEMBER(pose_wall_plane, found);
  MEMBER(pose_wall_plane, inliers);
  MEMBER(pose_wall_plane, iterations);
  MEMBER(pose_wall_plane, reasons);
  return struct_end("pose_wall_plane", sizeof(pose_wall_plane));
}

static int result_layout(void) {
  MEMBER(pose_wall_result, struct_size);
  MEMBER(pose_wall_result, frame_reasons);
  MEMBER(pose_wall_result, mark);
  MEMBER(pose_wall_result, config_crc32);
  MEMBER(pose_wall_result, source_id);
  MEMBER(pose_wall_result, positive_means);
  MEMBER(pose_wall_result, publication);
  MEMBER(pose_wall_result, work);
  MEMBER(pose_wall_result, stamp_ns);
  MEMBER(pose_wall_result, frame_index);
  MEMBER(pose_wall_result, confidence);
  MEMBER(pose_wall_result, quantity);
  MEMBER(pose_wall_result, floor);
  MEMBER(pose_wall_result, left);
  MEMBER(pose_wall_result, right);
  MEMBER(pose_wall_result, R_level_base);
  MEMBER(pose_wall_result, left_right_yaw_difference_rad);
  MEMBER(pose_wall_result, voxel_leaf_m);
  MEMBER(pose_wall_result, stage_ns);
  MEMBER(pose_wall_result, points_in);
  MEMBER(pose_wall_result, dropped_not_finite);
  MEMBER(pose_wall_result, dropped_zero);
  MEMBER(pose_wall_result, dropped_near);
  MEMBER(pose_wall_result, dropped_far);
  MEMBER(pose_wall_result, dropped_body);
  MEMBER(pose_wall_result, voxels);
  MEMBER(pose_wall_result, outliers);
  MEMBER(pose_wall_result, open_points);
  MEMBER(pose_wall_result, wall_points);
  return struct_end("pose_wall_result", sizeof(pose_wall_result));
}

static int pointers_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_key_info, name);
  MEMBER(pose_wall_key_info, unit);
  MEMBER(pose_wall_key_info, choices);
  MEMBER(pose_wall_key_info, default_text);
  MEMBER(pose_wall_key_info, group);
  MEMBER(pose_wall_key_info, help);
  MEMBER(pose_wall_key_info, minimum);
  MEMBER(pose_wall_key_info, maximum);
  MEMBER(pose_wall_key_info, type);
  MEMBER(pose_wall_key_info, reserved);
  padded += struct_end("pose_wall_key_info", sizeof(pose_wall_key_info));
  MEMBER(pose_wall_rule_fault, key);
  MEMBER(pose_wall_rule_fault, other_key);
  MEMBER(pose_wall_rule_fault, rule);
  padded += struct_end("pose_wall_rule_fault", sizeof(pose_wall_rule_fault));
  MEMBER(pose_wall_points, x_base_m);
  MEMBER(pose_wall_points, y_base_m);
  MEMBER(pose_wall_points, z_base_m);
  MEMBER(pose_wall_points, label);
  MEMBER(pose_wall_points, count);
  MEMBER(pose_wall_points, reserved);
  padded += struct_end("pose_wall_points", sizeof(pose_wall_points));
  MEMBER(pose_wall_moment, struct_size);
  MEMBER(pose_wall_moment, known);
  MEMBER(pose_wall_moment, boot_id);
  MEMBER(pose_wall_moment, wall_ns);
  MEMBER(pose_wall_moment, stamp_ns);
  return padded + struct_end("pose_wall_moment", sizeof(pose_wall_moment));
}

static int image_layout(void) {
  int padded = 0;
#include "image_members.def"
  MEMBER(pose_wall_image_source, struct_size);
  MEMBER(pose_wall_image_source, cause);
  MEMBER(pose_wall_image_source, thinning);
  MEMBER(pose_wall_image_source, held_thinning);
  MEMBER(pose_wall_image_source, publication);
  MEMBER(pose_wall_image_source, latency_ns);
  return padded + struct_end("pose_wall_image_source", sizeof(pose_wall_image_source));
}

static int publication_layout(void) {
  MEMBER(pose_wall_publication, struct_size);
  MEMBER(pose_wall_publication, cause);
  MEMBER(pose_wall_publication, thinning);
  MEMBER(pose_wall_publication, held_thinning);
  MEMBER(pose_wall_publication, index);
  MEMBER(pose_wall_publication, frame);
  MEMBER(pose_wall_publication, received_ns);
  MEMBER(pose_wall_publication, published_ns);
  MEMBER(pose_wall_publication, age_ns);
  MEMBER(pose_wall_publication, activity_since_ns);
  MEMBER(pose_wall_publication, activity);
  MEMBER(pose_wall_publication, reserved);
  MEMBER(pose_wall_publication, result);
  MEMBER(pose_wall_publication, has_motion);
  MEMBER(pose_wall_publication, motion_status);
  MEMBER(pose_wall_publication, motion);
  return struct_end("pose_wall_publication", sizeof(pose_wall_publication));
}

static int runtime_options_layout(void) {
  MEMBER(pose_wall_runtime_options, struct_size);
  MEMBER(pose_wall_runtime_options, queue_frames);
  MEMBER(pose_wall_runtime_options, cloud_points_max);
  MEMBER(pose_wall_runtime_options, point_bytes_max);
  MEMBER(pose_wall_runtime_options, thinning_max);
  MEMBER(pose_wall_runtime_options, box_clouds);
  MEMBER(pose_wall_runtime_options, box_backlog);
  MEMBER(pose_wall_runtime_options, worker_priority);
  MEMBER(pose_wall_runtime_options, worker_cpu);
  MEMBER(pose_wall_runtime_options, lock_memory);
  MEMBER(pose_wall_runtime_options, required);
  MEMBER(pose_wall_runtime_options, reserved);
  MEMBER(pose_wall_runtime_options, frame_period_max_ns);
  MEMBER(pose_wall_runtime_options, watchdog_ns);
  MEMBER(pose_wall_runtime_options, watchdog_every_ns);
  MEMBER(pose_wall_runtime_options, clock);
  MEMBER(pose_wall_runtime_options, clock_user);
  MEMBER(pose_wall_runtime_options, callback);
  MEMBER(pose_wall_runtime_options, callback_user);
  MEMBER(pose_wall_runtime_options, sink);
  MEMBER(pose_wall_runtime_options, sink_user);
  MEMBER(pose_wall_runtime_options, box_bytes);
  MEMBER(pose_wall_runtime_options, reserved_2);
  MEMBER(pose_wall_runtime_options, motion);
  MEMBER(pose_wall_runtime_options, motion_settings);
  return struct_end("pose_wall_runtime_options", sizeof(pose_wall_runtime_options));
}

static int runtime_times_layout(void) {
  MEMBER(pose_wall_runtime_times, count);
  MEMBER(pose_wall_runtime_times, p50_ns);
  MEMBER(pose_wall_runtime_times, p99_ns);
  MEMBER(pose_wall_runtime_times, p999_ns);
  MEMBER(pose_wall_runtime_times, worst_ns);
  return struct_end("pose_wall_runtime_times", sizeof(pose_wall_runtime_times));
}

static int runtime_statistics_layout(void) {
  MEMBER(pose_wall_runtime_statistics, struct_size);
  MEMBER(pose_wall_runtime_statistics, state);
  MEMBER(pose_wall_runtime_statistics, pushed);
  MEMBER(pose_wall_runtime_statistics, processed);
  MEMBER(pose_wall_runtime_statistics, dropped);
  MEMBER(pose_wall_runtime_statistics, filling);
  MEMBER(pose_wall_runtime_statistics, waiting);
  MEMBER(pose_wall_runtime_statistics, in_work);
  MEMBER(pose_wall_runtime_statistics, waiting_worst);
  MEMBER(pose_wall_runtime_statistics, published);
  MEMBER(pose_wall_runtime_statistics, silences);
  MEMBER(pose_wall_runtime_statistics, thinned);
  MEMBER(pose_wall_runtime_statistics, thinning);
  MEMBER(pose_wall_runtime_statistics, thinning_worst);
  MEMBER(pose_wall_runtime_statistics, activity);
  MEMBER(pose_wall_runtime_statistics, reserved);
  MEMBER(pose_wall_runtime_statistics, activity_since_ns);
  MEMBER(pose_wall_runtime_statistics, newest_age_ns);
  MEMBER(pose_wall_runtime_statistics, box_written);
  MEMBER(pose_wall_runtime_statistics, box_lost);
  MEMBER(pose_wall_runtime_statistics, box_failed);
  MEMBER(pose_wall_runtime_statistics, box_bytes_written);
  MEMBER(pose_wall_runtime_statistics, priority_error);
  MEMBER(pose_wall_runtime_statistics, affinity_error);
  MEMBER(pose_wall_runtime_statistics, lock_error);
  MEMBER(pose_wall_runtime_statistics, thread_error);
  MEMBER(pose_wall_runtime_statistics, push);
  MEMBER(pose_wall_runtime_statistics, wait);
  MEMBER(pose_wall_runtime_statistics, work);
  MEMBER(pose_wall_runtime_statistics, latency);
  MEMBER(pose_wall_runtime_statistics, callback);
  MEMBER(pose_wall_runtime_statistics, sink);
  MEMBER(pose_wall_runtime_statistics, stage);
  MEMBER(pose_wall_runtime_statistics, motion_refused);
  MEMBER(pose_wall_runtime_statistics, motion);
  return struct_end("pose_wall_runtime_statistics", sizeof(pose_wall_runtime_statistics));
}

static int box_info_layout(void) {
  MEMBER(pose_wall_box_info, config);
  MEMBER(pose_wall_box_info, version);
  MEMBER(pose_wall_box_info, box_bytes);
  return struct_end("pose_wall_box_info", sizeof(pose_wall_box_info));
}

static int box_record_layout(void) {
  MEMBER(pose_wall_box_record, offset);
  MEMBER(pose_wall_box_record, sequence);
  MEMBER(pose_wall_box_record, received_ns);
  MEMBER(pose_wall_box_record, stamp_ns);
  MEMBER(pose_wall_box_record, digest);
  MEMBER(pose_wall_box_record, passed_over);
  MEMBER(pose_wall_box_record, memento);
  MEMBER(pose_wall_box_record, result);
  MEMBER(pose_wall_box_record, points);
  MEMBER(pose_wall_box_record, inputs);
  MEMBER(pose_wall_box_record, motion);
  MEMBER(pose_wall_box_record, x);
  MEMBER(pose_wall_box_record, y);
  MEMBER(pose_wall_box_record, z);
  MEMBER(pose_wall_box_record, intensity);
  MEMBER(pose_wall_box_record, time);
  MEMBER(pose_wall_box_record, ring);
  MEMBER(pose_wall_box_record, kind);
  MEMBER(pose_wall_box_record, damaged);
  MEMBER(pose_wall_box_record, thinning);
  MEMBER(pose_wall_box_record, point_count);
  MEMBER(pose_wall_box_record, point_bytes);
  MEMBER(pose_wall_box_record, big_endian);
  MEMBER(pose_wall_box_record, left_out_not_finite);
  MEMBER(pose_wall_box_record, left_out_zero);
  return struct_with_pointers_end("pose_wall_box_record", sizeof(pose_wall_box_record));
}

static int self_test_layout(void) {
  MEMBER(pose_wall_self_test_report, struct_size);
  MEMBER(pose_wall_self_test_report, frames);
  MEMBER(pose_wall_self_test_report, digest_expected);
  MEMBER(pose_wall_self_test_report, digest_found);
  MEMBER(pose_wall_self_test_report, code_bytes);
  MEMBER(pose_wall_self_test_report, code_crc32);
  MEMBER(pose_wall_self_test_report, values_wrong);
  MEMBER(pose_wall_self_test_report, refused);
  MEMBER(pose_wall_self_test_report, reserved);
  return struct_end("pose_wall_self_test_report", sizeof(pose_wall_self_test_report));
}

static int motion_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_motion_settings, struct_size);
  MEMBER(pose_wall_motion_settings, reserved);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_motion_settings, name);
#include "pose_wall_motion_settings.def"
  padded += struct_end("pose_wall_motion_settings", sizeof(pose_wall_motion_settings));
  MEMBER(pose_wall_motion_fault, member);
  MEMBER(pose_wall_motion_fault, rule);
  padded += struct_with_pointers_end("pose_wall_motion_fault", sizeof(pose_wall_motion_fault));
  MEMBER(pose_wall_motion_result, struct_size);
  MEMBER(pose_wall_motion_result, along_state);
  MEMBER(pose_wall_motion_result, reasons);
  MEMBER(pose_wall_motion_result, mark);
  MEMBER(pose_wall_motion_result, stamp_ns);
  MEMBER(pose_wall_motion_result, frame_index);
  MEMBER(pose_wall_motion_result, position_m);
  MEMBER(pose_wall_motion_result, quaternion);
  MEMBER(pose_wall_motion_result, sigma);
  MEMBER(pose_wall_motion_result, protection_level);
  MEMBER(pose_wall_motion_result, road_axis);
  MEMBER(pose_wall_motion_result, along_m);
  MEMBER(pose_wall_motion_result, step_m);
  MEMBER(pose_wall_motion_result, step_rad);
  MEMBER(pose_wall_motion_result, step_s);
  MEMBER(pose_wall_motion_result, step_sigma);
  MEMBER(pose_wall_motion_result, step_protection_level);
  MEMBER(pose_wall_motion_result, contrast);
  MEMBER(pose_wall_motion_result, patches);
  MEMBER(pose_wall_motion_result, halves_m);
  MEMBER(pose_wall_motion_result, second_m);
  MEMBER(pose_wall_motion_result, second_gain);
  MEMBER(pose_wall_motion_result, points_in);
  MEMBER(pose_wall_motion_result, points_used);
  MEMBER(pose_wall_motion_result, ground_points);
  MEMBER(pose_wall_motion_result, clusters);
  MEMBER(pose_wall_motion_result, edge_points);
  MEMBER(pose_wall_motion_result, plane_points);
  MEMBER(pose_wall_motion_result, matched);
  MEMBER(pose_wall_motion_result, tiles);
  MEMBER(pose_wall_motion_result, keyframes);
  MEMBER(pose_wall_motion_result, wide_start);
  MEMBER(pose_wall_motion_result, run);
  MEMBER(pose_wall_motion_result, config_crc32);
  MEMBER(pose_wall_motion_result, source_id);
  padded += struct_end("pose_wall_motion_result", sizeof(pose_wall_motion_result));
  MEMBER(pose_wall_motion_functions, struct_size);
  MEMBER(pose_wall_motion_functions, abi_version);
  MEMBER(pose_wall_motion_functions, settings_check);
  MEMBER(pose_wall_motion_functions, memory_needed);
  MEMBER(pose_wall_motion_functions, open);
  MEMBER(pose_wall_motion_functions, reset);
  MEMBER(pose_wall_motion_functions, process);
  MEMBER(pose_wall_motion_functions, give);
  MEMBER(pose_wall_motion_functions, blank);
  MEMBER(pose_wall_motion_functions, image_fill);
  return padded + struct_end("pose_wall_motion_functions", sizeof(pose_wall_motion_functions));
}

int main(void) {
  int padded = config_layout() + cloud_layout() + value_layout() + plane_layout() + result_layout();
  padded += pointers_layout() + image_layout();
  padded += publication_layout() + runtime_options_layout() + runtime_times_layout() + runtime_statistics_layout() +
            box_info_layout() + box_record_layout() + self_test_layout() + motion_layout() + planar_layout();
  return padded == 0 ? 0 : 1;
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright (c) 2026 the pose_wall authors */

/* The structs of the planar library; see abi_layout.c. */

#include "abi_layout.h"
#include "pose_wall_planar.h"

int planar_layout(void);

static int planar_types_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_pose, x_m);
  MEMBER(pose_wall_planar_pose, y_m);
  MEMBER(pose_wall_planar_pose, yaw_rad);
  padded += struct_end("pose_wall_planar_pose", sizeof(pose_wall_planar_pose));
  MEMBER(pose_wall_planar_fault, member);
  MEMBER(pose_wall_planar_fault, rule);
  padded += struct_with_pointers_end("pose_wall_planar_fault", sizeof(pose_wall_planar_fault));
  MEMBER(pose_wall_planar_scan, struct_size);
  MEMBER(pose_wall_planar_scan, beams);
  MEMBER(pose_wall_planar_scan, stamp_ns);
  MEMBER(pose_wall_planar_scan, sensor);
  MEMBER(pose_wall_planar_scan, angle_min_rad);
  MEMBER(pose_wall_planar_scan, angle_step_rad);
  MEMBER(pose_wall_planar_scan, range_min_m);
  MEMBER(pose_wall_planar_scan, range_max_m);
  MEMBER(pose_wall_planar_scan, sigma_m);
  MEMBER(pose_wall_planar_scan, range_m);
  MEMBER(pose_wall_planar_scan, free_m);
  padded += struct_with_pointers_end("pose_wall_planar_scan", sizeof(pose_wall_planar_scan));
  return padded;
}

static int planar_grid_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_grid, struct_size);
  MEMBER(pose_wall_planar_grid, width);
  MEMBER(pose_wall_planar_grid, height);
  MEMBER(pose_wall_planar_grid, reserved);
  MEMBER(pose_wall_planar_grid, resolution_m);
  MEMBER(pose_wall_planar_grid, origin_x_m);
  MEMBER(pose_wall_planar_grid, origin_y_m);
  MEMBER(pose_wall_planar_grid, cells);
  padded += struct_with_pointers_end("pose_wall_planar_grid", sizeof(pose_wall_planar_grid));
  return padded;
}

static int planar_scan_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_floor, struct_size);
  MEMBER(pose_wall_planar_floor, measured);
  MEMBER(pose_wall_planar_floor, normal);
  MEMBER(pose_wall_planar_floor, height_m);
  MEMBER(pose_wall_planar_floor, tilt_sigma_rad);
  MEMBER(pose_wall_planar_floor, tilt_level_rad);
  MEMBER(pose_wall_planar_floor, reach_m);
  padded += struct_end("pose_wall_planar_floor", sizeof(pose_wall_planar_floor));
  MEMBER(pose_wall_planar_scanner_settings, struct_size);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_planar_scanner_settings, name);
#include "pose_wall_planar_scanner_settings.def"
  padded += struct_end("pose_wall_planar_scanner_settings", sizeof(pose_wall_planar_scanner_settings));
  MEMBER(pose_wall_planar_scan_view, struct_size);
  MEMBER(pose_wall_planar_scan_view, floor_state);
  MEMBER(pose_wall_planar_scan_view, floor_age_s);
  MEMBER(pose_wall_planar_scan_view, sensor_height_m);
  MEMBER(pose_wall_planar_scan_view, min_height_m);
  MEMBER(pose_wall_planar_scan_view, max_height_m);
  MEMBER(pose_wall_planar_scan_view, low_reach_m);
  MEMBER(pose_wall_planar_scan_view, free_m);
  MEMBER(pose_wall_planar_scan_view, bias_m);
  MEMBER(pose_wall_planar_scan_view, sigma_m);
  MEMBER(pose_wall_planar_scan_view, low_m);
  MEMBER(pose_wall_planar_scan_view, overhead_m);
  MEMBER(pose_wall_planar_scan_view, alone_m);
  MEMBER(pose_wall_planar_scan_view, behind_m);
  MEMBER(pose_wall_planar_scan_view, clear_from_m);
  MEMBER(pose_wall_planar_scan_view, clear_m);
  MEMBER(pose_wall_planar_scan_view, returns);
  MEMBER(pose_wall_planar_scan_view, points_in);
  MEMBER(pose_wall_planar_scan_view, dropped);
  MEMBER(pose_wall_planar_scan_view, of_body);
  MEMBER(pose_wall_planar_scan_view, of_floor);
  MEMBER(pose_wall_planar_scan_view, of_low);
  MEMBER(pose_wall_planar_scan_view, of_band);
  MEMBER(pose_wall_planar_scan_view, of_overhead);
  MEMBER(pose_wall_planar_scan_view, of_roof);
  MEMBER(pose_wall_planar_scan_view, out_of_scan);
  MEMBER(pose_wall_planar_scan_view, uncounted);
  padded += struct_with_pointers_end("pose_wall_planar_scan_view", sizeof(pose_wall_planar_scan_view));
  MEMBER(pose_wall_planar_laserscan, angle_min);
  MEMBER(pose_wall_planar_laserscan, angle_max);
  MEMBER(pose_wall_planar_laserscan, angle_increment);
  MEMBER(pose_wall_planar_laserscan, time_increment);
  MEMBER(pose_wall_planar_laserscan, scan_time);
  MEMBER(pose_wall_planar_laserscan, range_min);
  MEMBER(pose_wall_planar_laserscan, range_max);
  MEMBER(pose_wall_planar_laserscan, count);
  MEMBER(pose_wall_planar_laserscan, ranges);
  padded += struct_with_pointers_end("pose_wall_planar_laserscan", sizeof(pose_wall_planar_laserscan));
  return padded;
}

static int planar_match_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_match_input, struct_size);
  MEMBER(pose_wall_planar_match_input, has_prior);
  MEMBER(pose_wall_planar_match_input, guess);
  MEMBER(pose_wall_planar_match_input, reach_m);
  MEMBER(pose_wall_planar_match_input, reach_rad);
  MEMBER(pose_wall_planar_match_input, covariance);
  padded += struct_end("pose_wall_planar_match_input", sizeof(pose_wall_planar_match_input));
  MEMBER(pose_wall_planar_match_result, struct_size);
  MEMBER(pose_wall_planar_match_result, state);
  MEMBER(pose_wall_planar_match_result, pose);
  MEMBER(pose_wall_planar_match_result, covariance);
  MEMBER(pose_wall_planar_match_result, explained);
  MEMBER(pose_wall_planar_match_result, misfit_m);
  MEMBER(pose_wall_planar_match_result, slide_m);
  MEMBER(pose_wall_planar_match_result, slide_rad);
  MEMBER(pose_wall_planar_match_result, score);
  MEMBER(pose_wall_planar_match_result, second_score);
  MEMBER(pose_wall_planar_match_result, second);
  MEMBER(pose_wall_planar_match_result, is_whole);
  MEMBER(pose_wall_planar_match_result, points);
  padded += struct_end("pose_wall_planar_match_result", sizeof(pose_wall_planar_match_result));
  return padded;
}

static int planar_slam_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_slam_settings, struct_size);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_planar_slam_settings, name);
#include "pose_wall_planar_slam_settings.def"
  padded += struct_end("pose_wall_planar_slam_settings", sizeof(pose_wall_planar_slam_settings));
  MEMBER(pose_wall_planar_slam_result, struct_size);
  MEMBER(pose_wall_planar_slam_result, state);
  MEMBER(pose_wall_planar_slam_result, stamp_ns);
  MEMBER(pose_wall_planar_slam_result, pose);
  MEMBER(pose_wall_planar_slam_result, in_keyframe);
  MEMBER(pose_wall_planar_slam_result, keyframe);
  MEMBER(pose_wall_planar_slam_result, is_keyframe);
  MEMBER(pose_wall_planar_slam_result, explained);
  MEMBER(pose_wall_planar_slam_result, misfit_m);
  MEMBER(pose_wall_planar_slam_result, closures);
  MEMBER(pose_wall_planar_slam_result, taken_back);
  MEMBER(pose_wall_planar_slam_result, keyframes);
  MEMBER(pose_wall_planar_slam_result, is_full);
  MEMBER(pose_wall_planar_slam_result, solution);
  MEMBER(pose_wall_planar_slam_result, is_settled);
  padded += struct_end("pose_wall_planar_slam_result", sizeof(pose_wall_planar_slam_result));
  MEMBER(pose_wall_planar_keyframe, struct_size);
  MEMBER(pose_wall_planar_keyframe, points);
  MEMBER(pose_wall_planar_keyframe, stamp_ns);
  MEMBER(pose_wall_planar_keyframe, pose);
  MEMBER(pose_wall_planar_keyframe, travel_m);
  padded += struct_end("pose_wall_planar_keyframe", sizeof(pose_wall_planar_keyframe));
  MEMBER(pose_wall_planar_edge, struct_size);
  MEMBER(pose_wall_planar_edge, from);
  MEMBER(pose_wall_planar_edge, to);
  MEMBER(pose_wall_planar_edge, is_closure);
  MEMBER(pose_wall_planar_edge, step);
  MEMBER(pose_wall_planar_edge, information);
  padded += struct_end("pose_wall_planar_edge", sizeof(pose_wall_planar_edge));
  return padded;
}

static int planar_map_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_map_settings, struct_size);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_planar_map_settings, name);
#include "pose_wall_planar_map_settings.def"
  padded += struct_end("pose_wall_planar_map_settings", sizeof(pose_wall_planar_map_settings));
  MEMBER(pose_wall_planar_tile, struct_size);
  MEMBER(pose_wall_planar_tile, crc32);
  MEMBER(pose_wall_planar_tile, column);
  MEMBER(pose_wall_planar_tile, row);
  MEMBER(pose_wall_planar_tile, cell_m);
  MEMBER(pose_wall_planar_tile, stamp_ns);
  MEMBER(pose_wall_planar_tile, scans);
  MEMBER(pose_wall_planar_tile, cells);
  padded += struct_end("pose_wall_planar_tile", sizeof(pose_wall_planar_tile));
  MEMBER(pose_wall_planar_map_report, struct_size);
  MEMBER(pose_wall_planar_map_report, tiles);
  MEMBER(pose_wall_planar_map_report, tiles_new);
  MEMBER(pose_wall_planar_map_report, tiles_saved);
  MEMBER(pose_wall_planar_map_report, saves_refused);
  MEMBER(pose_wall_planar_map_report, beams_not_stored);
  MEMBER(pose_wall_planar_map_report, things_new);
  MEMBER(pose_wall_planar_map_report, things_gone);
  MEMBER(pose_wall_planar_map_report, tiles_stale);
  MEMBER(pose_wall_planar_map_report, reserved);
  padded += struct_end("pose_wall_planar_map_report", sizeof(pose_wall_planar_map_report));
  MEMBER(pose_wall_planar_cell, struct_size);
  MEMBER(pose_wall_planar_cell, state);
  MEMBER(pose_wall_planar_cell, probability);
  MEMBER(pose_wall_planar_cell, distance_m);
  padded += struct_end("pose_wall_planar_cell", sizeof(pose_wall_planar_cell));
  MEMBER(pose_wall_planar_ray, struct_size);
  MEMBER(pose_wall_planar_ray, end);
  MEMBER(pose_wall_planar_ray, range_m);
  padded += struct_end("pose_wall_planar_ray", sizeof(pose_wall_planar_ray));
  MEMBER(pose_wall_planar_box, struct_size);
  MEMBER(pose_wall_planar_box, tiles);
  MEMBER(pose_wall_planar_box, tiles_stale);
  MEMBER(pose_wall_planar_box, reserved);
  MEMBER(pose_wall_planar_box, cells_seen);
  MEMBER(pose_wall_planar_box, things);
  MEMBER(pose_wall_planar_box, x_min_m);
  MEMBER(pose_wall_planar_box, y_min_m);
  MEMBER(pose_wall_planar_box, x_max_m);
  MEMBER(pose_wall_planar_box, y_max_m);
  padded += struct_end("pose_wall_planar_box", sizeof(pose_wall_planar_box));
  return padded;
}

static int planar_localise_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_localise_settings, struct_size);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_planar_localise_settings, name);
#include "pose_wall_planar_localise_settings.def"
  padded += struct_end("pose_wall_planar_localise_settings", sizeof(pose_wall_planar_localise_settings));
  MEMBER(pose_wall_planar_localise_result, struct_size);
  MEMBER(pose_wall_planar_localise_result, state);
  MEMBER(pose_wall_planar_localise_result, reason);
  MEMBER(pose_wall_planar_localise_result, reserved);
  MEMBER(pose_wall_planar_localise_result, stamp_ns);
  MEMBER(pose_wall_planar_localise_result, pose);
  MEMBER(pose_wall_planar_localise_result, covariance);
  MEMBER(pose_wall_planar_localise_result, fits);
  MEMBER(pose_wall_planar_localise_result, explained);
  MEMBER(pose_wall_planar_localise_result, misfit_m);
  MEMBER(pose_wall_planar_localise_result, slide_m);
  MEMBER(pose_wall_planar_localise_result, rival);
  MEMBER(pose_wall_planar_localise_result, progress);
  MEMBER(pose_wall_planar_localise_result, candidates);
  MEMBER(pose_wall_planar_localise_result, candidates_all);
  MEMBER(pose_wall_planar_localise_result, searches);
  MEMBER(pose_wall_planar_localise_result, lost);
  padded += struct_end("pose_wall_planar_localise_result", sizeof(pose_wall_planar_localise_result));
  MEMBER(pose_wall_planar_candidate, struct_size);
  MEMBER(pose_wall_planar_candidate, reserved);
  MEMBER(pose_wall_planar_candidate, pose);
  MEMBER(pose_wall_planar_candidate, weight);
  MEMBER(pose_wall_planar_candidate, worse_by);
  MEMBER(pose_wall_planar_candidate, fits);
  MEMBER(pose_wall_planar_candidate, spread_m);
  padded += struct_end("pose_wall_planar_candidate", sizeof(pose_wall_planar_candidate));
  return padded;
}

static int planar_plan_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_plan_settings, struct_size);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_planar_plan_settings, name);
#include "pose_wall_planar_plan_settings.def"
  padded += struct_end("pose_wall_planar_plan_settings", sizeof(pose_wall_planar_plan_settings));
  MEMBER(pose_wall_planar_path_pose, pose);
  MEMBER(pose_wall_planar_path_pose, curvature_1_m);
  MEMBER(pose_wall_planar_path_pose, along_m);
  MEMBER(pose_wall_planar_path_pose, drive);
  MEMBER(pose_wall_planar_path_pose, flags);
  padded += struct_end("pose_wall_planar_path_pose", sizeof(pose_wall_planar_path_pose));
  MEMBER(pose_wall_planar_plan_result, struct_size);
  MEMBER(pose_wall_planar_plan_result, outcome);
  MEMBER(pose_wall_planar_plan_result, poses);
  MEMBER(pose_wall_planar_plan_result, cusps);
  MEMBER(pose_wall_planar_plan_result, spot_turns);
  MEMBER(pose_wall_planar_plan_result, expansions);
  MEMBER(pose_wall_planar_plan_result, places);
  MEMBER(pose_wall_planar_plan_result, searches);
  MEMBER(pose_wall_planar_plan_result, length_m);
  MEMBER(pose_wall_planar_plan_result, turning_rad);
  MEMBER(pose_wall_planar_plan_result, cost_m);
  MEMBER(pose_wall_planar_plan_result, search_cost_m);
  MEMBER(pose_wall_planar_plan_result, bound);
  MEMBER(pose_wall_planar_plan_result, place);
  MEMBER(pose_wall_planar_plan_result, width_m);
  padded += struct_end("pose_wall_planar_plan_result", sizeof(pose_wall_planar_plan_result));
  return padded;
}

static int planar_track_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_track_settings, struct_size);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_planar_track_settings, name);
#include "pose_wall_planar_track_settings.def"
  padded += struct_end("pose_wall_planar_track_settings", sizeof(pose_wall_planar_track_settings));
  MEMBER(pose_wall_planar_track_input, struct_size);
  MEMBER(pose_wall_planar_track_input, has_pose);
  MEMBER(pose_wall_planar_track_input, now_ns);
  MEMBER(pose_wall_planar_track_input, pose_ns);
  MEMBER(pose_wall_planar_track_input, pose);
  MEMBER(pose_wall_planar_track_input, pose_level_m);
  MEMBER(pose_wall_planar_track_input, speed_m_s);
  padded += struct_end("pose_wall_planar_track_input", sizeof(pose_wall_planar_track_input));
  MEMBER(pose_wall_planar_track_command, struct_size);
  MEMBER(pose_wall_planar_track_command, state);
  MEMBER(pose_wall_planar_track_command, slowed_by);
  MEMBER(pose_wall_planar_track_command, pose_index);
  MEMBER(pose_wall_planar_track_command, speed_m_s);
  MEMBER(pose_wall_planar_track_command, turn_rad_s);
  MEMBER(pose_wall_planar_track_command, left_m_s);
  MEMBER(pose_wall_planar_track_command, right_m_s);
  MEMBER(pose_wall_planar_track_command, cross_error_m);
  MEMBER(pose_wall_planar_track_command, heading_error_rad);
  MEMBER(pose_wall_planar_track_command, along_m);
  MEMBER(pose_wall_planar_track_command, remaining_m);
  MEMBER(pose_wall_planar_track_command, slip);
  MEMBER(pose_wall_planar_track_command, drift_1_m);
  padded += struct_end("pose_wall_planar_track_command", sizeof(pose_wall_planar_track_command));
  return padded;
}

static int planar_stop_layout(void) {
  int padded = 0;
  MEMBER(pose_wall_planar_stop_settings, struct_size);
  MEMBER(pose_wall_planar_stop_settings, corners);
  MEMBER(pose_wall_planar_stop_settings, corner_m);
#define POSE_WALL_SETTING(type, name, ...) MEMBER(pose_wall_planar_stop_settings, name);
#include "pose_wall_planar_stop_settings.def"
  padded += struct_end("pose_wall_planar_stop_settings", sizeof(pose_wall_planar_stop_settings));
  MEMBER(pose_wall_planar_stop_motion, struct_size);
  MEMBER(pose_wall_planar_stop_motion, given);
  MEMBER(pose_wall_planar_stop_motion, speed_m_s);
  MEMBER(pose_wall_planar_stop_motion, turn_rad_s);
  MEMBER(pose_wall_planar_stop_motion, command_speed_m_s);
  MEMBER(pose_wall_planar_stop_motion, command_turn_rad_s);
  padded += struct_end("pose_wall_planar_stop_motion", sizeof(pose_wall_planar_stop_motion));
  MEMBER(pose_wall_planar_stop_result, struct_size);
  MEMBER(pose_wall_planar_stop_result, state);
  MEMBER(pose_wall_planar_stop_result, reasons);
  MEMBER(pose_wall_planar_stop_result, heartbeat);
  MEMBER(pose_wall_planar_stop_result, stamp_ns);
  MEMBER(pose_wall_planar_stop_result, now_ns);
  MEMBER(pose_wall_planar_stop_result, frames);
  MEMBER(pose_wall_planar_stop_result, allowed_speed_m_s);
  MEMBER(pose_wall_planar_stop_result, allowed_turn_rad_s);
  MEMBER(pose_wall_planar_stop_result, rim_speed_m_s);
  MEMBER(pose_wall_planar_stop_result, stop_speed_m_s);
  MEMBER(pose_wall_planar_stop_result, time_to_contact_s);
  MEMBER(pose_wall_planar_stop_result, nearest_m);
  MEMBER(pose_wall_planar_stop_result, nearest_distance_m);
  MEMBER(pose_wall_planar_stop_result, nearest_size_m);
  MEMBER(pose_wall_planar_stop_result, nearest_age_s);
  MEMBER(pose_wall_planar_stop_result, nearest_height);
  MEMBER(pose_wall_planar_stop_result, points_in);
  MEMBER(pose_wall_planar_stop_result, points_used);
  MEMBER(pose_wall_planar_stop_result, thing_cells);
  MEMBER(pose_wall_planar_stop_result, blind_cells);
  MEMBER(pose_wall_planar_stop_result, doubtful_cells);
  MEMBER(pose_wall_planar_stop_result, floor_height_m);
  MEMBER(pose_wall_planar_stop_result, floor_slope);
  MEMBER(pose_wall_planar_stop_result, settings_crc32);
  MEMBER(pose_wall_planar_stop_result, mark);
  padded += struct_end("pose_wall_planar_stop_result", sizeof(pose_wall_planar_stop_result));
  return padded;
}

int planar_layout(void) {
  return planar_types_layout() + planar_grid_layout() + planar_scan_layout() + planar_match_layout() +
         planar_slam_layout() + planar_map_layout() + planar_localise_layout() + planar_plan_layout() +
         planar_track_layout() + planar_stop_layout();
}

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Everything a simulated run is made of, as plain numbers. The defaults are a clean rectangular road, 5 m wide and
// 3.5 m high, the machine in its middle. Each number has a key of the same name in parameters.cpp, which also knows
// its range and help text. Numbers that choose between words (sides, axes) hold the word's index.
//
// road frame: x along the road, y to its left, z up in the section across it; origin on the centre line, at the
// height of the floor, where the machine starts.
#pragma once

#include <string>

#include "io/beams/beam_table.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools::sim {

// Words "none|left|right|both"; the two lowest bits are the sides.
enum SideChoice { kSideNone = 0, kSideLeft = 1, kSideRight = 2, kSideBoth = 3 };

struct Road {
  double width_m = 5.0;
  double height_m = 3.5;
  double lean_left_deg = 0.0;  // + leans away at the top
  double lean_right_deg = 0.0;
  double arch_springing_m = 0.0;  // 0: flat roof; else an elliptic arch from here to height_m
  double bow_m = 0.0;             // the walls' middle stands back against their edges: a horseshoe
  double slope_deg = 0.0;         // seen only in what stands upright by gravity: faces, props, people
  double cross_fall_deg = 0.0;    // + floor rises to the left; the walls keep upright
  double curve_radius_m = 0.0;    // 0: straight; + bends left
  double splay_left_deg = 0.0;    // + the road widens ahead
  double splay_right_deg = 0.0;
  double walls = kSideBoth;
  double roof = 1.0;
  double face_distance_m = 0.0;  // 0: no heading face
  double face_oblique_deg = 0.0;
  double face_extra_width_m = 0.0;  // the last face_niche_m before the face are wider by this on each side
  double face_niche_m = 2.0;
  double rear_distance_m = 0.0;  // 0: open behind
  double ramp_deg = 0.0;         // + floor and roof rise from ramp_at_m on, over ramp_length_m
  double ramp_at_m = 3.0;
  double ramp_length_m = 10.0;
};

struct Rock {
  double rock = 0.0;         // RockKind of rock_scales.hpp: relief of several lengths, as measured
  double rock_scale = 1.0;   // times that
  double roughness_m = 0.0;  // standard deviation of walls, roof and face
  double roughness_length_m = 0.5;
  double wave_m = 0.0;  // amplitude of shotcrete waves
  double wave_length_m = 1.5;
  double steel_pitch_m = 0.0;  // 0: no steel sets
  double steel_depth_m = 0.12;
  double steel_width_m = 0.12;
  double rock_repeats = 1.0;  // 0: no stretch of rough rock comes again within kilometres
  double texture = 0.0;       // standard deviation of how much light comes back, relative
  double texture_length_m = 0.4;
};

struct Floor {
  double floor_roughness_m = 0.0;
  double floor_roughness_length_m = 0.3;
  double hump_m = 0.0;  // standard deviation of long, smooth unevenness
  double hump_length_m = 3.0;
  double rut_depth_m = 0.0;
  double rut_gauge_m = 1.0;
  double rut_width_m = 0.4;
  double camber_m = 0.0;  // the middle of the floor against its sides; the mean stays
  double bench_side = kSideNone;
  double bench_width_m = 0.8;
  double bench_height_m = 0.4;
  double muck_side = kSideNone;
  double muck_height_m = 0.8;
  double muck_width_m = 1.2;
  double muck_roughness_m = 0.05;
  double floor_return = 1.0;  // share of beams on the dry floor that come back
  double puddle_coverage = 0.0;
  double puddle_size_m = 1.5;
  double puddle_return = 0.0;  // share of beams on water that come back from its surface
  double puddle_ghost = 0.0;   // share that come back by way of the mirror, as points below the floor
};

struct Openings {
  double crosscut_side = kSideNone;
  double crosscut_at_m = 0.0;
  double crosscut_width_m = 4.0;
  double crosscut_depth_m = 15.0;
  double crosscut_height_m = 3.5;
  double crosscut_oblique_deg = 0.0;  // 0: square to the road; + it leads ahead
  double niche_side = kSideNone;
  double niche_pitch_m = 12.0;
  double niche_width_m = 1.5;
  double niche_depth_m = 0.8;
  double niche_height_m = 2.2;
  double widening_side = kSideNone;
  double widening_at_m = 2.0;
  double widening_m = 0.5;
  double narrow_side = kSideNone;
  double narrow_at_m = 2.0;
  double narrow_length_m = 2.0;
  double narrow_depth_m = 0.4;
};

struct Objects {
  double pipe_side = kSideNone;
  double pipe_count = 2.0;
  double pipe_height_m = 1.2;
  double pipe_spacing_m = 0.35;
  double pipe_radius_m = 0.10;
  double pipe_standoff_m = 0.25;  // axis to wall
  double prop_side = kSideNone;
  double prop_pitch_m = 1.0;
  double prop_radius_m = 0.09;
  double prop_standoff_m = 0.5;
  double conveyor_side = kSideNone;
  double conveyor_standoff_m = 0.3;
  double conveyor_width_m = 1.0;
  double conveyor_bottom_m = 0.3;
  double conveyor_top_m = 1.1;
  double vehicle_side = kSideNone;
  double vehicle_at_m = 1.0;
  double vehicle_standoff_m = 0.3;
  double vehicle_length_m = 4.0;
  double vehicle_width_m = 1.4;
  double vehicle_height_m = 1.7;
  double vehicle_speed_mps = 0.0;  // + ahead; straight on, whatever the road does
  double people_side = kSideNone;
  double people_count = 3.0;
  double people_from_m = -4.0;
  double people_to_m = 4.0;
  double people_standoff_m = 0.6;
  double people_speed_mps = 0.0;  // + ahead; straight on, whatever the road does
  double curtain_side = kSideNone;
  double curtain_distance_m = 0.5;  // from the centre line
  double curtain_from_m = -2.0;
  double curtain_to_m = 2.0;
  double curtain_height_m = 2.5;
  double clutter_count = 0.0;  // boulders 6 to 25 m around the start
};

struct Machine {
  double forward_axis = 0.0;     // "+X|-X|+Y|-Y"
  double base_height_m = 1.4;    // base origin above the floor
  double lateral_m = 0.0;        // + left of the centre line
  double near_side = 0.0;        // "none|left|right": place the machine by near_distance_m instead of lateral_m
  double near_distance_m = 0.5;  // from this side's mean wall at the floor
  double turned_left_deg = 0.0;  // reported yaw is minus this
  double roll_deg = 0.0;         // as reported: about base X and Y, whatever forward_axis is
  double pitch_deg = 0.0;
  double speed_mps = 0.0;
  double speed_change_at_s = 0.0;  // 0: never
  double speed_after_mps = 0.0;    // from speed_change_at_s on
  double drive_in_m = 0.0;         // driven before the scene begins, along the road to where it starts
  double drive_in_mps = 0.8;       // judgement, 2026-11-27: a slow walk, 8 cm a frame at 10 Hz
  double drift_mps = 0.0;
  double turn_rate_dps = 0.0;
  double sway_roll_deg = 0.0;
  double sway_pitch_deg = 0.0;
  double sway_period_s = 4.0;
  double turn_step_deg = 0.0;
  double turn_step_at_s = 1.0;
  double s_front_m = 2.0;
  double s_back_m = -2.0;
  double body = 0.0;
  double body_length_m = 4.5;
  double body_width_m = 1.2;
  double body_top_m = -0.6;  // above the base origin
  double boom = 0.0;
  double boom_length_m = 3.0;
  double boom_radius_m = 0.2;
  double boom_elevation_deg = 5.0;
  double boom_sweep_deg = 0.0;
  double boom_period_s = 8.0;
};

// lidar -> base as the engine is told it; the errors are what it is not told.
struct Mount {
  double mount_x_m = 0.0;
  double mount_y_m = 0.0;
  double mount_z_m = 0.0;
  double mount_roll_deg = 0.0;
  double mount_pitch_deg = 0.0;
  double mount_yaw_deg = 0.0;
  double mount_error_x_m = 0.0;
  double mount_error_y_m = 0.0;
  double mount_error_z_m = 0.0;
  double mount_error_roll_deg = 0.0;
  double mount_error_pitch_deg = 0.0;
  double mount_error_yaw_deg = 0.0;
};

struct Sensor {
  std::string name = "os1-64";
  // Of a real sensor: where its lasers point. None: even steps between the elevations.
  const BeamTable* beams = nullptr;
  double rings = 64.0;  // 0: non-repetitive pattern
  double columns = 1024.0;
  double pattern_points = 0.0;  // beams per frame of a non-repetitive pattern
  double elevation_min_deg = -22.5;
  double elevation_max_deg = 22.5;
  double range_noise_m = 0.012;
  double range_bias_m = 0.0;
  double range_quantum_m = 0.0;
  double range_floor_m = 0.1;  // the sensor itself sees nothing nearer
  double range_ceiling_m = 90.0;
  double divergence_deg = 0.0;     // 0: no mixing of ranges at edges
  double dual_returns = 0.0;       // edges give two points instead of a mixed one, and dust keeps what is behind
  double grazing_limit_deg = 1.0;  // flatter hits give no return
  double noise_incidence_m = 0.0;  // flat hits smear the pulse: more noise, by the tangent of the incidence
  double noise_dark_most = 1.0;    // noise grows with the root of the light that is missing, this often at most
  double window_from_deg = 0.0;    // it measures only between these of its own azimuths, + left; from == to: all around
  double window_to_deg = 0.0;
  double unit_scale = 1.0;    // 1000: a driver that delivers millimetres
  double floor_from_m = 1.5;  // the floor's region of the truth, and of the engine's config: where it begins ...
  double floor_to_m = 3.5;    // ... and ends
};

struct Faults {
  double dropout = 0.0;
  double dust = 0.0;  // share of beams that end in dust
  double dust_range_m = 1.5;
  double dust_rise_s = 0.0;  // 0: dust from the start; else it grows evenly from none over this time
  double drops = 0.0;
  double drops_range_m = 0.6;
  double wet_side = kSideNone;
  double wet_dropout = 0.9;
  double blocked_from_deg = 0.0;  // azimuth from the forward axis, + left; from == to: none
  double blocked_to_deg = 0.0;
  double blocked_2_from_deg = 0.0;
  double blocked_2_to_deg = 0.0;
  double shimmer_from_deg = 0.0;
  double shimmer_to_deg = 0.0;
  double shimmer_factor = 5.0;
  double lost_side = kSideNone;  // this side's wall gives no return in the interval
  double lost_from_s = 1.0;
  double lost_to_s = 2.0;
};

struct Sequence {
  double rate_hz = 10.0;
  double scan_s = 0.0;  // the beams of a frame fire evenly over this time, from its stamp on; 0: at one instant
  double stamp_jitter_s = 0.0;
  double stamp_jump_s = 0.0;
  double stamp_jump_at_s = 1.0;
  double stamp_still_from_s = 0.0;  // from == to: never
  double stamp_still_to_s = 0.0;
  double freeze_from_s = 0.0;  // the sensor repeats its cloud while stamps go on
  double freeze_to_s = 0.0;
  double partial_from_s = 0.0;
  double partial_to_s = 0.0;
  double partial_share = 0.5;    // share of the beams of a partial frame
  double duplicate_every = 0.0;  // this many frames come, the last of them once more, and so on; 0: never
  double drop_every = 0.0;       // this many frames come, then drop_length are missing, and so on; 0: never
  double drop_length = 1.0;
};

struct Setup {
  Road road;
  Rock rock;
  Floor floor;
  Openings openings;
  Objects objects;
  Machine machine;
  Mount mount;
  Sensor sensor;
  Faults faults;
  Sequence sequence;
};

// Inside a GoogleTest case the name Setup means a private member of its fixture.
using SceneSetup = Setup;

inline bool has_side(double choice, int side_sign) {
  return (static_cast<int>(choice) & (side_sign > 0 ? kSideLeft : kSideRight)) != 0;
}

}  // namespace pose_wall::tools::sim

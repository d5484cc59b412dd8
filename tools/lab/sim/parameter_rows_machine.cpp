// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/parameter_rows.hpp"

#define MACHINE(...) POSE_WALL_SIM_NUMBER(machine, Machine, __VA_ARGS__)
#define MOUNT(...) POSE_WALL_SIM_NUMBER(mount, Mount, __VA_ARGS__)

namespace pose_wall::tools::sim {
namespace {

const std::vector<Parameter> kMachineRows = {
    POSE_WALL_SIM_WORDS(machine, Machine, forward_axis, "+X|-X|+Y|-Y", 3.0, "the machine's forward axis in base"),
    MACHINE(base_height_m, "m", 0.05, 20.0, "base origin above the floor"),
    MACHINE(lateral_m, "m", -500.0, 500.0, "+ left of the centre line"),
    POSE_WALL_SIM_WORDS(machine, Machine, near_side, "none|left|right", 2.0,
                        "place the machine by near_distance_m instead of lateral_m"),
    MACHINE(near_distance_m, "m", 0.05, 500.0, "from this side's mean wall at the floor"),
    MACHINE(turned_left_deg, "deg", -180.0, 180.0, "reported yaw is minus this"),
    MACHINE(roll_deg, "deg", -60.0, 60.0, "as reported: about base X, whatever forward_axis is"),
    MACHINE(pitch_deg, "deg", -60.0, 60.0, "as reported: about base Y, whatever forward_axis is"),
    MACHINE(speed_mps, "m/s", -10.0, 10.0, "along the road"),
    MACHINE(speed_change_at_s, "s", 0.0, 1e5, "from here on it drives at speed_after_mps; 0: never"),
    MACHINE(speed_after_mps, "m/s", -10.0, 10.0, "see speed_change_at_s"),
    MACHINE(drive_in_m, "m", 0.0, 1000.0,
            "driven along the road to the scene's start, before the scene begins; 0: nothing"),
    MACHINE(drive_in_mps, "m/s", 0.01, 10.0, "speed while it drives in"),
    MACHINE(drift_mps, "m/s", -5.0, 5.0, "to the left"),
    MACHINE(turn_rate_dps, "deg/s", -90.0, 90.0, "to the left"),
    MACHINE(sway_roll_deg, "deg", 0.0, 30.0, "amplitude added to roll_deg"),
    MACHINE(sway_pitch_deg, "deg", 0.0, 30.0, "amplitude added to pitch_deg"),
    MACHINE(sway_period_s, "s", 0.1, 1000.0, "of both"),
    MACHINE(turn_step_deg, "deg", -90.0, 90.0, "a sudden turn to the left"),
    MACHINE(turn_step_at_s, "s", 0.0, 1e5, "when it comes"),
    MACHINE(s_front_m, "m", -50.0, 50.0, "front sampling point on the forward axis"),
    MACHINE(s_back_m, "m", -50.0, 50.0, "back sampling point on the forward axis"),
    POSE_WALL_SIM_WORDS(machine, Machine, body, kSwitchWords, 1.0, "the machine's body stands in view"),
    MACHINE(body_length_m, "m", 0.1, 20.0, "along the forward axis"),
    MACHINE(body_width_m, "m", 0.1, 10.0, "across"),
    MACHINE(body_top_m, "m", -5.0, 5.0, "above the base origin"),
    POSE_WALL_SIM_WORDS(machine, Machine, boom, kSwitchWords, 1.0, "the boom stands in view"),
    MACHINE(boom_length_m, "m", 0.1, 20.0, "from its pivot on the body's front"),
    MACHINE(boom_radius_m, "m", 0.02, 2.0, "half its thickness"),
    MACHINE(boom_elevation_deg, "deg", -60.0, 60.0, "+ up"),
    MACHINE(boom_sweep_deg, "deg", 0.0, 90.0, "amplitude of its swing to both sides"),
    MACHINE(boom_period_s, "s", 0.1, 1000.0, "of the swing"),

    MOUNT(mount_x_m, "m", -20.0, 20.0, "sensor in base"),
    MOUNT(mount_y_m, "m", -20.0, 20.0, "sensor in base"),
    MOUNT(mount_z_m, "m", -20.0, 20.0, "sensor in base"),
    MOUNT(mount_roll_deg, "deg", -180.0, 180.0, "base = Rz(yaw) Ry(pitch) Rx(roll) lidar; 180: upside down"),
    MOUNT(mount_pitch_deg, "deg", -180.0, 180.0, "see mount_roll_deg"),
    MOUNT(mount_yaw_deg, "deg", -180.0, 180.0, "see mount_roll_deg"),
    MOUNT(mount_error_x_m, "m", -5.0, 5.0, "the sensor's true place minus the one in pose_wall.yaml"),
    MOUNT(mount_error_y_m, "m", -5.0, 5.0, "see mount_error_x_m"),
    MOUNT(mount_error_z_m, "m", -5.0, 5.0, "see mount_error_x_m"),
    MOUNT(mount_error_roll_deg, "deg", -180.0, 180.0, "the same for its turn"),
    MOUNT(mount_error_pitch_deg, "deg", -180.0, 180.0, "see mount_error_roll_deg"),
    MOUNT(mount_error_yaw_deg, "deg", -180.0, 180.0, "see mount_error_roll_deg"),
};

}  // namespace

std::vector<Parameter> machine_parameters() {
  return kMachineRows;
}

}  // namespace pose_wall::tools::sim

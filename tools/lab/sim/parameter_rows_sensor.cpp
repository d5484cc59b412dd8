// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/parameter_rows.hpp"

#define SENSOR(...) POSE_WALL_SIM_NUMBER(sensor, Sensor, __VA_ARGS__)
#define FAULT(...) POSE_WALL_SIM_NUMBER(faults, Faults, __VA_ARGS__)
#define SEQUENCE(...) POSE_WALL_SIM_NUMBER(sequence, Sequence, __VA_ARGS__)

namespace pose_wall::tools::sim {
namespace {

const std::vector<Parameter> kSensorRows = {
    SENSOR(rings, "1", 0.0, 512.0, "of a rotating sensor; 0: non-repetitive pattern"),
    SENSOR(columns, "1", 0.0, 8192.0, "of a rotating sensor"),
    SENSOR(pattern_points, "1", 0.0, 1e6, "beams per frame of a non-repetitive pattern"),
    SENSOR(elevation_min_deg, "deg", -90.0, 90.0, "lowest beam"),
    SENSOR(elevation_max_deg, "deg", -90.0, 90.0, "highest beam"),
    SENSOR(range_noise_m, "m", 0.0, 1.0, "standard deviation of a range"),
    SENSOR(range_bias_m, "m", -1.0, 1.0, "added to every range"),
    SENSOR(range_quantum_m, "m", 0.0, 1.0, "ranges come in steps of this; 0: no steps"),
    SENSOR(range_floor_m, "m", 0.0, 10.0, "the sensor sees nothing nearer"),
    SENSOR(range_ceiling_m, "m", 1.0, 1000.0, "the sensor sees nothing farther"),
    SENSOR(divergence_deg, "deg", 0.0, 5.0, "width of a beam: at edges ranges mix; 0: no mixing"),
    POSE_WALL_SIM_WORDS(sensor, Sensor, dual_returns, kSwitchWords, 1.0,
                        "edges give two points instead of a mixed one, dust gives its own and the one behind"),
    SENSOR(grazing_limit_deg, "deg", 0.0, 45.0, "flatter hits give no return"),
    SENSOR(noise_incidence_m, "m", 0.0, 0.5, "more noise on flat hits: times the tangent of the incidence, up to 5"),
    SENSOR(noise_dark_most, "1", 1.0, 10.0,
           "noise grows with the root of the light that is missing, this often at most"),
    SENSOR(window_from_deg, "deg", -360.0, 360.0, "it measures only from this of its own azimuths (+ left) ..."),
    SENSOR(window_to_deg, "deg", -360.0, 360.0, "... counter-clockwise to this one; equal: all around"),
    SENSOR(unit_scale, "1", 0.001, 1000.0, "1000: a driver that delivers millimetres"),
    SENSOR(floor_from_m, "m", 0.0, 15.0, "the floor's region begins so far ahead and behind, for truth and engine"),
    SENSOR(floor_to_m, "m", 1.0, 20.0, "the floor's region ends here"),

    FAULT(dropout, "1", 0.0, 1.0, "share of returns that are lost"),
    FAULT(dust, "1", 0.0, 1.0, "share of beams that end in dust"),
    FAULT(dust_range_m, "m", 0.05, 50.0, "mean of the exponentially distributed ranges"),
    FAULT(dust_rise_s, "s", 0.0, 1e5, "dust grows evenly from none over this time; 0: there from the start"),
    FAULT(drops, "1", 0.0, 1.0, "share of beams that end in water drops"),
    FAULT(drops_range_m, "m", 0.05, 50.0, "mean of the exponentially distributed ranges"),
    POSE_WALL_SIM_WORDS(faults, Faults, wet_side, kSideWords, 3.0, "dark, wet wall"),
    FAULT(wet_dropout, "1", 0.0, 1.0, "share of its returns that are lost"),
    FAULT(blocked_from_deg, "deg", -360.0, 360.0, "mud on the window: from this azimuth (0 forward, + left) ..."),
    FAULT(blocked_to_deg, "deg", -360.0, 360.0, "... counter-clockwise to this one; equal: none"),
    FAULT(blocked_2_from_deg, "deg", -360.0, 360.0, "a second sector"),
    FAULT(blocked_2_to_deg, "deg", -360.0, 360.0, "see blocked_2_from_deg"),
    FAULT(shimmer_from_deg, "deg", -360.0, 360.0, "hot exhaust: sector of larger noise"),
    FAULT(shimmer_to_deg, "deg", -360.0, 360.0, "see shimmer_from_deg"),
    FAULT(shimmer_factor, "1", 1.0, 100.0, "times range_noise_m"),
    POSE_WALL_SIM_WORDS(faults, Faults, lost_side, kSideWords, 3.0, "wall without any return for a while"),
    FAULT(lost_from_s, "s", 0.0, 1e5, "from this time"),
    FAULT(lost_to_s, "s", 0.0, 1e5, "to this time"),

    SEQUENCE(rate_hz, "Hz", 0.1, 1000.0, "frames per second"),
    SEQUENCE(scan_s, "s", 0.0, 1.0,
             "the beams of a frame fire over this time, from its stamp on, while the machine moves; 0: at one instant"),
    SEQUENCE(stamp_jitter_s, "s", 0.0, 1.0, "standard deviation of the stamps"),
    SEQUENCE(stamp_jump_s, "s", -1e5, 1e5, "added to the stamps from stamp_jump_at_s on"),
    SEQUENCE(stamp_jump_at_s, "s", 0.0, 1e5, "see stamp_jump_s"),
    SEQUENCE(stamp_still_from_s, "s", 0.0, 1e5, "the stamp stands still from here ..."),
    SEQUENCE(stamp_still_to_s, "s", 0.0, 1e5, "... to here; equal: never"),
    SEQUENCE(freeze_from_s, "s", 0.0, 1e5, "the sensor repeats its cloud from here ..."),
    SEQUENCE(freeze_to_s, "s", 0.0, 1e5, "... to here; equal: never"),
    SEQUENCE(partial_from_s, "s", 0.0, 1e5, "frames are cut off from here ..."),
    SEQUENCE(partial_to_s, "s", 0.0, 1e5, "... to here; equal: never"),
    SEQUENCE(partial_share, "1", 0.0, 1.0,
             "share of the circle, from behind counter-clockwise, that a cut frame holds"),
    SEQUENCE(duplicate_every, "1", 0.0, 1e6, "after so many frames the last one is repeated with its stamp; 0: never"),
    SEQUENCE(drop_every, "1", 0.0, 1e6, "so many frames come, then drop_length are missing; 0: never"),
    SEQUENCE(drop_length, "1", 1.0, 1000.0, "see drop_every"),
};

}  // namespace

std::vector<Parameter> sensor_parameters() {
  return kSensorRows;
}

}  // namespace pose_wall::tools::sim

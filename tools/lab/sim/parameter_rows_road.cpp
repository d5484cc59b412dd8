// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/parameter_rows.hpp"
#include "lab/sim/rock_scales.hpp"

#define ROAD(...) POSE_WALL_SIM_NUMBER(road, Road, __VA_ARGS__)
#define ROCK(...) POSE_WALL_SIM_NUMBER(rock, Rock, __VA_ARGS__)
#define FLOOR(...) POSE_WALL_SIM_NUMBER(floor, Floor, __VA_ARGS__)
#define OPENING(...) POSE_WALL_SIM_NUMBER(openings, Openings, __VA_ARGS__)
#define OBJECT(...) POSE_WALL_SIM_NUMBER(objects, Objects, __VA_ARGS__)
#define SIDE(group, type, member, help) POSE_WALL_SIM_WORDS(group, type, member, kSideWords, 3.0, help)

namespace pose_wall::tools::sim {
namespace {

const std::vector<Parameter> kRoadRows = {
    ROAD(width_m, "m", 0.5, 1000.0, "between the mean walls, at the floor of the centre line"),
    ROAD(height_m, "m", 1.0, 50.0, "floor to roof, or to the crown of an arch"),
    ROAD(lean_left_deg, "deg", -30.0, 30.0, "+ leans away from the road at the top"),
    ROAD(lean_right_deg, "deg", -30.0, 30.0, "see lean_left_deg"),
    ROAD(arch_springing_m, "m", 0.0, 20.0, "0: flat roof; else an elliptic arch from this height to height_m"),
    ROAD(bow_m, "m", -0.5, 0.5,
         "+ the walls' middle stands back by this against their edges: a horseshoe; their mean stays"),
    ROAD(slope_deg, "deg", -30.0, 30.0,
         "along the road; visible only in things that stand upright by gravity: face, props, people"),
    ROAD(cross_fall_deg, "deg", -20.0, 20.0, "+ the floor rises to the left; walls keep upright"),
    ROAD(curve_radius_m, "m", -10000.0, 10000.0, "0: straight; + bends left"),
    ROAD(splay_left_deg, "deg", -30.0, 30.0, "+ this wall runs away from the centre line ahead"),
    ROAD(splay_right_deg, "deg", -30.0, 30.0, "see splay_left_deg"),
    SIDE(road, Road, walls, "which walls there are"),
    POSE_WALL_SIM_WORDS(road, Road, roof, kSwitchWords, 1.0, "whether there is a roof"),
    ROAD(face_distance_m, "m", 0.0, 1000.0, "heading face ahead of the start; 0: none"),
    ROAD(face_oblique_deg, "deg", -60.0, 60.0, "+ turns the face counter-clockwise"),
    ROAD(face_extra_width_m, "m", 0.0, 20.0, "the road is wider by this on each side over the last face_niche_m"),
    ROAD(face_niche_m, "m", 0.1, 50.0, "see face_extra_width_m"),
    ROAD(rear_distance_m, "m", 0.0, 1000.0, "the road's end behind the start; 0: open"),

    ROAD(ramp_deg, "deg", -6.0, 6.0, "+ floor and roof rise ahead from ramp_at_m on; the machine stays on its level"),
    ROAD(ramp_at_m, "m", 1.0, 100.0, "ahead of the start; the machine is to stay before it"),
    ROAD(ramp_length_m, "m", 0.5, 20.0, "level again behind it"),

    POSE_WALL_SIM_WORDS(rock, Rock, rock, kRockWords, 4.0,
                        "relief of several lengths as measured; plain: none but that of the keys below"),
    ROCK(rock_scale, "1", 0.0, 2.0, "times that relief"),
    ROCK(roughness_m, "m", 0.0, 0.5, "standard deviation of walls, roof and face"),
    ROCK(roughness_length_m, "m", 0.05, 10.0, "where their correlation has fallen to 1/e"),
    ROCK(wave_m, "m", 0.0, 0.5, "amplitude of shotcrete waves"),
    ROCK(wave_length_m, "m", 0.2, 20.0, "length of shotcrete waves"),
    ROCK(steel_pitch_m, "m", 0.0, 5.0, "steel sets one behind the other; 0: none"),
    ROCK(steel_depth_m, "m", 0.01, 0.5, "how far they stand out of the mean wall"),
    ROCK(steel_width_m, "m", 0.02, 1.0, "their width along the road"),
    POSE_WALL_SIM_WORDS(rock, Rock, rock_repeats, kSwitchWords, 1.0,
                        "yes: rough rock repeats after 205 correlation lengths; no: not within kilometres"),
    ROCK(texture, "1", 0.0, 0.5, "standard deviation of how much light the rock gives back"),
    ROCK(texture_length_m, "m", 0.05, 10.0, "where its correlation has fallen to 1/e"),

    FLOOR(floor_roughness_m, "m", 0.0, 0.5, "standard deviation of the floor"),
    FLOOR(floor_roughness_length_m, "m", 0.05, 10.0, "where its correlation has fallen to 1/e"),
    FLOOR(hump_m, "m", 0.0, 1.0, "standard deviation of long, smooth unevenness"),
    FLOOR(hump_length_m, "m", 0.5, 50.0, "where its correlation has fallen to 1/e"),
    FLOOR(rut_depth_m, "m", 0.0, 1.0, "two ruts along the road"),
    FLOOR(rut_gauge_m, "m", 0.2, 5.0, "between the ruts' middles"),
    FLOOR(rut_width_m, "m", 0.1, 2.0, "of each rut"),
    FLOOR(camber_m, "m", -0.3, 0.3, "+ the middle of the floor is higher by this than its sides; the mean stays"),
    SIDE(floor, Floor, bench_side, "a bench or kerb along the wall"),
    FLOOR(bench_width_m, "m", 0.05, 10.0, "out of the wall"),
    FLOOR(bench_height_m, "m", 0.02, 3.0, "above the floor"),
    SIDE(floor, Floor, muck_side, "heaps of muck along the wall"),
    FLOOR(muck_height_m, "m", 0.05, 3.0, "at the wall"),
    FLOOR(muck_width_m, "m", 0.1, 10.0, "out of the wall"),
    FLOOR(muck_roughness_m, "m", 0.0, 0.3, "standard deviation of the rubble"),
    FLOOR(floor_return, "1", 0.0, 1.0, "share of beams on the dry floor that come back"),
    FLOOR(puddle_coverage, "1", 0.0, 1.0, "share of the floor under water"),
    FLOOR(puddle_size_m, "m", 0.2, 20.0, "of a puddle, about"),
    FLOOR(puddle_return, "1", 0.0, 1.0, "share of beams on water that come back from its surface"),
    FLOOR(puddle_ghost, "1", 0.0, 1.0, "share of them that come back by way of the mirror: points below the floor"),

    SIDE(openings, Openings, crosscut_side, "a road that branches off"),
    OPENING(crosscut_at_m, "m", -100.0, 100.0, "its middle, ahead of the start"),
    OPENING(crosscut_width_m, "m", 0.2, 50.0, "along the road"),
    OPENING(crosscut_depth_m, "m", 0.1, 200.0, "from the wall to its end"),
    OPENING(crosscut_height_m, "m", 0.5, 50.0, "of its roof"),
    OPENING(crosscut_oblique_deg, "deg", -65.0, 65.0, "0: square to the road; + it leads ahead"),
    SIDE(openings, Openings, niche_side, "recesses of a man's height, one after the other, within 60 m of the start"),
    OPENING(niche_pitch_m, "m", 2.0, 100.0, "from one to the next, give or take a quarter"),
    OPENING(niche_width_m, "m", 0.3, 5.0, "along the road"),
    OPENING(niche_depth_m, "m", 0.1, 5.0, "from the wall to its end"),
    OPENING(niche_height_m, "m", 0.5, 5.0, "of its roof"),
    SIDE(openings, Openings, widening_side, "the wall steps back"),
    OPENING(widening_at_m, "m", -100.0, 100.0, "from here on"),
    OPENING(widening_m, "m", 0.01, 20.0, "by this much"),
    SIDE(openings, Openings, narrow_side, "the wall stands out for a while"),
    OPENING(narrow_at_m, "m", -100.0, 100.0, "from here on"),
    OPENING(narrow_length_m, "m", 0.1, 100.0, "for this length"),
    OPENING(narrow_depth_m, "m", 0.01, 10.0, "by this much"),

    SIDE(objects, Objects, pipe_side, "pipes or cables along the wall"),
    OBJECT(pipe_count, "1", 1.0, 10.0, "one above the other"),
    OBJECT(pipe_height_m, "m", 0.0, 10.0, "of the lowest"),
    OBJECT(pipe_spacing_m, "m", 0.02, 2.0, "between their axes"),
    OBJECT(pipe_radius_m, "m", 0.01, 1.0, "of each"),
    OBJECT(pipe_standoff_m, "m", 0.0, 5.0, "axis to mean wall"),
    SIDE(objects, Objects, prop_side, "a row of props along the wall"),
    OBJECT(prop_pitch_m, "m", 0.2, 10.0, "from prop to prop"),
    OBJECT(prop_radius_m, "m", 0.02, 0.5, "of each"),
    OBJECT(prop_standoff_m, "m", 0.0, 5.0, "axis to mean wall"),
    SIDE(objects, Objects, conveyor_side, "a conveyor along the wall"),
    OBJECT(conveyor_standoff_m, "m", 0.0, 10.0, "gap to the wall"),
    OBJECT(conveyor_width_m, "m", 0.1, 5.0, "across"),
    OBJECT(conveyor_bottom_m, "m", 0.0, 3.0, "above the floor"),
    OBJECT(conveyor_top_m, "m", 0.1, 5.0, "above the floor"),
    SIDE(objects, Objects, vehicle_side, "a parked vehicle beside the wall"),
    OBJECT(vehicle_at_m, "m", -100.0, 100.0, "its middle, ahead of the start"),
    OBJECT(vehicle_standoff_m, "m", 0.0, 10.0, "gap to the wall"),
    OBJECT(vehicle_length_m, "m", 0.2, 30.0, "along the road"),
    OBJECT(vehicle_width_m, "m", 0.1, 5.0, "across"),
    OBJECT(vehicle_height_m, "m", 0.3, 5.0, "its top"),
    OBJECT(vehicle_speed_mps, "m/s", -10.0, 10.0, "+ ahead; straight on, whatever the road does"),
    SIDE(objects, Objects, people_side, "people beside the wall"),
    OBJECT(people_count, "1", 1.0, 50.0, "at random places"),
    OBJECT(people_from_m, "m", -100.0, 100.0, "between here"),
    OBJECT(people_to_m, "m", -100.0, 100.0, "and here"),
    OBJECT(people_standoff_m, "m", 0.2, 10.0, "to the wall, give or take 0.2 m"),
    OBJECT(people_speed_mps, "m/s", -10.0, 10.0, "see vehicle_speed_mps"),
    SIDE(objects, Objects, curtain_side, "a thin curtain along the road"),
    OBJECT(curtain_distance_m, "m", 0.05, 20.0, "from the centre line"),
    OBJECT(curtain_from_m, "m", -100.0, 100.0, "from here"),
    OBJECT(curtain_to_m, "m", -100.0, 100.0, "to here"),
    OBJECT(curtain_height_m, "m", 0.1, 20.0, "its top"),
    OBJECT(clutter_count, "1", 0.0, 200.0, "boulders 6 to 25 m around the start"),
};

}  // namespace

std::vector<Parameter> road_parameters() {
  return kRoadRows;
}

}  // namespace pose_wall::tools::sim

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Roads as mines have them: rock of several lengths as it was measured (rock_scales.hpp), walls that bow, arches,
// floors with camber, ruts and ramps, niches and crosscuts.

#include "lab/sim/scene_rows.hpp"

namespace pose_wall::tools::sim {
namespace {

// What a mine would call an ordinary day. Where the scene is not drawn it is like the gallery that was measured.
const std::vector<SceneValue> kOrdinary = {
    {"width_m", "4.9", 4.2, 6.0},      {"height_m", "4.7", 3.8, 5.0},      {"arch_springing_m", "2.5", 2.0, 2.8},
    {"camber_m", "-0.07", -0.1, 0.06}, {"cross_fall_deg", "0", -1.5, 1.5}, {"ramp_deg", "0", -3.0, 3.0},
    {"ramp_at_m", "6", 4.0, 12.0},     {"rut_depth_m", "0", 0.0, 0.08},    {"rut_gauge_m", "1.8", 1.4, 2.0},
    {"rock_repeats", "no", 0.0, 0.0},
};

std::vector<SceneValue> ordinary(std::vector<SceneValue> own) {
  own.insert(own.begin(), kOrdinary.begin(), kOrdinary.end());
  return own;
}

}  // namespace

std::vector<SceneChoice> mines_scenes() {  // NOLINT(readability-function-size): a table
  return {
      {"mine_blasted", SceneKind::kMine, "drilled and blasted, with niches and crosscuts",
       "valid where floor and walls are planes; levels as wide as the rock makes them",
       ordinary({{"rock", "blasted", 3.0, 3.0},
                 {"rock_scale", "1", 0.7, 1.1},
                 {"bow_m", "0.16", 0.05, 0.2},
                 {"niche_side", "left", 0.0, 3.0},
                 {"niche_pitch_m", "25", 8.0, 30.0},
                 {"crosscut_side", "none", 0.0, 3.0},
                 {"crosscut_at_m", "10", 6.0, 20.0},
                 {"pipe_side", "left", 0.0, 2.0}})},
      {"mine_shotcrete", SceneKind::kMine, "shotcrete on blasted rock, with pipes",
       "valid where floor and walls are planes; levels as wide as the rock makes them",
       ordinary({{"rock", "shotcrete", 2.0, 2.0},
                 {"rock_scale", "1", 0.7, 1.1},
                 {"bow_m", "0.1", 0.0, 0.15},
                 {"niche_side", "right", 0.0, 3.0},
                 {"niche_pitch_m", "15", 10.0, 30.0},
                 {"pipe_side", "left", 0.0, 3.0}})},
      {"mine_cut", SceneKind::kMine, "cut by a roadheader, before its face, with a conveyor", "mostly valid",
       ordinary({{"rock", "cut", 4.0, 4.0},
                 {"rock_scale", "1", 0.7, 1.1},
                 {"bow_m", "0.05", 0.0, 0.1},
                 {"face_distance_m", "8", 5.0, 12.0},
                 {"conveyor_side", "none", 0.0, 2.0},
                 {"conveyor_width_m", "0.8", 0.7, 0.9},
                 {"lateral_m", "0", -0.2, 0.2},
                 {"ramp_deg", "0", 0.0, 0.0}})},  // a conveyor is one straight box
      {"mine_lined", SceneKind::kMine, "lined with concrete, with pipes", "mostly valid",
       ordinary({{"rock", "smooth", 1.0, 1.0},
                 {"rock_scale", "1", 0.7, 1.1},
                 {"bow_m", "0", 0.0, 0.15},
                 {"pipe_side", "both", 0.0, 3.0}})},
  };
}

}  // namespace pose_wall::tools::sim

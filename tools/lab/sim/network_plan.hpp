// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a network of roads is drawn from. Plain numbers; 0 where a range is given: the seed draws it.
#pragma once

namespace pose_wall::tools::sim {

// How a wall looks from close by.
enum class Lining { kRock, kSmooth };

struct NetworkPlan {
  double length_m = 500.0;  // of all centre lines together, 60 to 20000; within 15 percent where the roads find room
  // Parallel roads with cross roads between them. One road: a single corridor.
  int roads = 0;            // 1 to 6; 0: 2 to 4
  double spacing_m = 0.0;   // between the middles of parallel roads, 16 to 60; 0: 20 to 36
  double crosscut_m = 0.0;  // between cross roads, at least 16; 0: 28 to 60. Two roads, 0.45 of length_m: one long loop
  double crosscuts = 0.75;  // share of the possible cross roads that are there
  double staggered = 0.5;   // share of them that miss the one opposite: two junctions of 3 instead of one of 4
  double oblique = 0.3;     // share of them that are not square to the road
  double dead_ends_m = 60.0;  // road between two blind drifts; 0: none
  double width_min_m = 4.0;
  double width_max_m = 6.0;
  double bend_m = 4.0;    // the roads swing to both sides by about this
  double turn_rad = 0.0;  // and turn by this angle from the first to the last cross road
  // Parallel roads of one width, with props and niches at the same places. Their rock still differs.
  bool alike = false;
  // As if cast in one mould: also the relief of their walls is the same.
  bool twin_rock = false;

  Lining lining = Lining::kRock;
  double roughness_m = 0.06;        // standard deviation of the rock's relief
  double roughness_length_m = 0.6;  // from bump to hollow
  double wave_m = 0.12;             // and of its slow waves
  double wave_length_m = 4.0;
  double width_wave_m = 0.15;  // the width itself changes along the road by about this
  double steel_pitch_m = 0.0;  // between steel sets; 0: none
  double steel_depth_m = 0.14;
  double prop_pitch_m = 0.0;    // between props along a wall; 0: none
  double niche_pitch_m = 45.0;  // between niches along a wall; 0: none

  double height_m = 3.4;  // of the roof above the floor
  double floor_roughness_m = 0.02;
  double hump_m = 0.03;  // standard deviation of the floor's long unevenness
  double hump_length_m = 3.0;
};

}  // namespace pose_wall::tools::sim

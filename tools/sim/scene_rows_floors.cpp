// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "sim/scene_rows.hpp"

namespace pose_wall::tools::sim {

std::vector<SceneChoice> floors_scenes() {  // NOLINT(readability-function-size): a table
  return {
      // floors
      {"cross_fall",
       "slope and cross-fall",
       "valid",
       {{"cross_fall_deg", "8", 2.0, 8.0, true},
        {"slope_deg", "10", 0.0, 15.0, true},
        {"face_distance_m", "8", 5.0, 10.0}}},
      {"humps",
       "uneven floor with ruts",
       "the floor",
       {{"hump_m", "0.05", 0.02, 0.08},
        {"hump_length_m", "2.5", 1.5, 4.0},
        {"rut_depth_m", "0.12", 0.05, 0.2},
        {"floor_roughness_m", "0.02", 0.0, 0.04}}},
      {"bench",
       "a bench along a wall",
       "the floor, not the bench",
       {{"bench_side", "left", 1.0, 3.0}, {"bench_width_m", "1.0", 0.3, 1.4}, {"bench_height_m", "0.4", 0.15, 0.8}}},
      {"muck",
       "muck piles at both walls",
       "the floor or held; never the piles",
       {{"muck_side", "both", 1.0, 3.0},
        {"muck_height_m", "0.9", 0.4, 1.2},
        {"muck_width_m", "1.1", 0.6, 1.4},
        {"roughness_m", "0.04", 0.0, 0.06}}},
      {"puddles",
       "water without return",
       "the floor",
       {{"puddle_coverage", "0.5", 0.2, 0.8}, {"puddle_size_m", "1.5", 0.5, 4.0}, {"puddle_return", "0.05", 0.0, 0.1}}},
      {"ghosts",
       "wet floor that mirrors the road",
       "the floor or held; never the ghosts",
       {{"puddle_coverage", "0.5", 0.3, 0.9},
        {"puddle_size_m", "2", 0.5, 5.0},
        {"puddle_return", "0.2", 0.0, 0.4},
        {"puddle_ghost", "0.6", 0.3, 0.6}}},
      {"no_floor",
       "no return from the floor",
       "floor held or invalid; never the roof",
       {{"floor_return", "0", 0.0, 0.0}}},
      // air and water
      {"dust",
       "dust, drops, dropouts",
       "degraded, then held as it thickens",
       {{"dust", "0.25", 0.05, 0.5},
        {"dust_range_m", "1.5", 0.5, 4.0},
        {"drops", "0.02", 0.0, 0.05},
        {"dropout", "0.2", 0.0, 0.4},
        {"roughness_m", "0.03", 0.0, 0.06}}},
      {"dropout", "many returns lost", "valid or degraded", {{"dropout", "0.5", 0.2, 0.6}}},
      {"wet_wall",
       "one wall too dark to be seen",
       "that side degraded or held",
       {{"wet_side", "left", 1.0, 2.0}, {"wet_dropout", "0.95", 0.7, 1.0}}},
      {"shimmer",
       "hot exhaust in view",
       "inside the protection level",
       {{"shimmer_from_deg", "60", 30.0, 90.0},
        {"shimmer_to_deg", "150", 110.0, 180.0},
        {"shimmer_factor", "5", 3.0, 6.0}}},
  };
}

}  // namespace pose_wall::tools::sim

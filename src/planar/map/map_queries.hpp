// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What a map is asked: cells, rays, its extent, and grids.

#pragma once

#include <cstdint>

#include "planar/map/grid_map.hpp"

namespace pose_wall::planar {

std::uint32_t state_of(const CellModel& model, std::uint8_t value);

// struct_size stays as it is; all else is written.
void ask_cell(const GridMap& map, const MapPlace& place, pose_wall_planar_cell* cell);
void ask_ray(const GridMap& map, const BeamLine& line, double range_max_m, bool through_unknown,
             pose_wall_planar_ray* ray);
void ask_box(const GridMap& map, pose_wall_planar_box* box);

// width x height cells from this one on.
void fill_grid(const GridMap& map, std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height,
               std::int8_t* cells);

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The only extern "C" file of the map: checks arguments, translates, calls.

#include "part/shell.hpp"
#include "planar/map/grid_map.hpp"
#include "planar/map/map_queries.hpp"
#include "planar/map/tile_record.hpp"

namespace pose_wall::planar {
namespace {

using Map = Held<GridMap, 0x70616D6C616E616CULL>;

bool is_on_map(double x_m, double y_m) {
  constexpr double kReach_m = POSE_WALL_PLANAR_MAP_REACH_M;  // as the header says
  return is_within(x_m, -kReach_m, kReach_m) && is_within(y_m, -kReach_m, kReach_m);
}

bool is_angle(double angle_rad) {
  constexpr double kMost_rad = POSE_WALL_PLANAR_TURNED_MOST_RAD;  // by the interface
  return is_within(angle_rad, -kMost_rad, kMost_rad);
}

constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_map_settings, __VA_ARGS__)
#include "pose_wall_planar_map_settings.def"
};

struct MapTable : SettingsTable<pose_wall_planar_map_settings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows() { return rows_of(kRows); }
  SettingFault broken_rule() const;
};

SettingFault MapTable::broken_rule() const {
  const double cap_cells = distance_cap_m / cell_m;
  if (distance_cap_m != 0.0 && !is_within(cap_cells, 1.0 - 1e-9, 120.0 + 1e-9)) {
    return {"distance_cap_m", "distance_cap_m must be 0 or from 1 to 120 cells"};
  }
  if (occupied_probability > most_probability) {
    return {"occupied_probability", "occupied_probability must be at most most_probability"};
  }
  if (free_probability < least_probability) {
    return {"free_probability", "free_probability must be at least least_probability"};
  }
  return {};
}

}  // namespace

extern "C" {

POSE_WALL_SETTINGS_CALLS(pose_wall_planar_map, MapTable, pose_wall_planar_fault)
POSE_WALL_BLOCK_CALLS(pose_wall_planar_map, Map, MapTable, pose_wall_planar_map)

POSE_WALL_EXPORT int32_t pose_wall_planar_map_clear(pose_wall_planar_map* map) {
  return with_part<Map>(map, [](GridMap& own) { own.clear(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_on_save(pose_wall_planar_map* map, pose_wall_planar_save save,
                                                      void* context) {
  return with_part<Map>(map, [&](GridMap& own) {
    own.save = save;
    own.save_context = context;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_insert(pose_wall_planar_map* map, const pose_wall_planar_scan* scan,
                                                     const pose_wall_planar_pose* base,
                                                     pose_wall_planar_map_report* report) {
  if (scan == nullptr || base == nullptr || report == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](GridMap& own) -> std::int32_t {
    if (const std::int32_t size = check_struct(*report); size != POSE_WALL_OK) return size;
    if (const std::int32_t status = check_scan(scan); status != POSE_WALL_OK) return status;
    if (!is_on_map(base->x_m, base->y_m) || !is_angle(base->yaw_rad)) return POSE_WALL_PLANAR_E_POSE;
    const MapWork work = own.insert(*scan, pose_of(*base));
    *report = {sizeof(*report),
               own.tiles().count(),
               work.tiles_new,
               work.tiles_saved,
               work.refused ? 1U : 0U,
               work.beams_not_stored,
               work.things_new,
               work.things_gone,
               own.distances().stale_tiles(),
               0};
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_renew(pose_wall_planar_map* map, uint32_t most, uint32_t* stale) {
  return with_part<Map>(map, [&](GridMap& own) {
    const std::uint32_t waiting = own.renew(most);
    if (stale != nullptr) *stale = waiting;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_cell(const pose_wall_planar_map* map, double x_m, double y_m,
                                                   pose_wall_planar_cell* cell) {
  if (cell == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](const GridMap& own) -> std::int32_t {
    if (const std::int32_t size = check_struct(*cell); size != POSE_WALL_OK) return size;
    if (!is_on_map(x_m, y_m)) return POSE_WALL_PLANAR_E_POSE;
    ask_cell(own, own.place_of(x_m, y_m), cell);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_ray(const pose_wall_planar_map* map, const pose_wall_planar_pose* from,
                                                  double angle_rad, double range_max_m, uint32_t through_unknown,
                                                  pose_wall_planar_ray* ray) {
  if (from == nullptr || ray == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](const GridMap& own) -> std::int32_t {
    if (const std::int32_t size = check_struct(*ray); size != POSE_WALL_OK) return size;
    const bool is_from = is_on_map(from->x_m, from->y_m) && is_angle(from->yaw_rad);
    if (!is_from || !is_angle(angle_rad)) return POSE_WALL_PLANAR_E_POSE;
    if (!is_within(range_max_m, 0.0, 1000.0) || through_unknown > 1) return POSE_WALL_E_VALUE_RANGE;
    const MapPlace place = own.place_of(from->x_m, from->y_m);
    const Turn2 turn(wrapped(from->yaw_rad + angle_rad));
    ask_ray(own, BeamLine{place.x, place.y, turn.c, turn.s}, range_max_m, through_unknown != 0, ray);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_box(const pose_wall_planar_map* map, pose_wall_planar_box* box) {
  if (box == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](const GridMap& own) {
    const std::int32_t size = check_struct(*box);
    if (size == POSE_WALL_OK) ask_box(own, box);
    return size;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_grid(const pose_wall_planar_map* map, double x_m, double y_m,
                                                   uint32_t width, uint32_t height, int8_t* cells, uint64_t capacity,
                                                   pose_wall_planar_grid* grid) {
  if (cells == nullptr || grid == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](const GridMap& own) -> std::int32_t {
    if (const std::int32_t size = check_struct(*grid); size != POSE_WALL_OK) return size;
    if (!is_on_map(x_m, y_m)) return POSE_WALL_PLANAR_E_POSE;
    constexpr std::uint32_t kMost = POSE_WALL_PLANAR_GRID_SIDE_MAX;  // as the header says
    if (width < 1 || width > kMost || height < 1 || height > kMost) return POSE_WALL_PLANAR_E_GRID;
    if (capacity < static_cast<std::uint64_t>(width) * height) return POSE_WALL_E_BUFFER_SMALL;
    const MapPlace place = own.place_of(x_m, y_m);
    const double cell_m = own.settings().cell_m;
    fill_grid(own, place.cell_x(), place.cell_y(), width, height, cells);
    *grid = {sizeof(*grid), width, height, 0, cell_m, place.cell_x() * cell_m, place.cell_y() * cell_m, cells};
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_put_tile(pose_wall_planar_map* map, const pose_wall_planar_tile* tile) {
  if (tile == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](GridMap& own) {
    const std::int32_t status = check_tile(*tile, own.settings().cell_m);
    return status == POSE_WALL_OK ? ok_if(own.put(*tile), POSE_WALL_E_BUFFER_SMALL) : status;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_get_tile(pose_wall_planar_map* map, uint32_t index,
                                                       pose_wall_planar_tile* tile) {
  if (tile == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](GridMap& own) -> std::int32_t {
    if (const std::int32_t size = check_struct(*tile); size != POSE_WALL_OK) return size;
    if (index >= own.tiles().count()) return POSE_WALL_E_INDEX;
    own.copy_out(own.in_order()[index], tile);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_save_bytes(const pose_wall_planar_map* map, uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](const GridMap& own) { *bytes = map_bytes(own.tiles().count()); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_save_all(pose_wall_planar_map* map, void* bytes, uint64_t capacity,
                                                       uint64_t* written) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map, [&](GridMap& own) -> std::int32_t {
    const std::uint64_t needed = map_bytes(own.tiles().count());
    if (capacity < needed) return POSE_WALL_E_BUFFER_SMALL;
    write_map(&own, static_cast<unsigned char*>(bytes));
    if (written != nullptr) *written = needed;
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_load_all(pose_wall_planar_map* map, const void* bytes, uint64_t size) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  return with_part<Map>(map,
                        [&](GridMap& own) { return read_map(&own, static_cast<const unsigned char*>(bytes), size); });
}

}  // extern "C"

}  // namespace pose_wall::planar

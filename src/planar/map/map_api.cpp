// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The only extern "C" file of the map: checks arguments, translates, calls.

#include "part/export.hpp"
#include "part/shell.hpp"
#include "part/struct_sizes.hpp"
#include "planar/map/grid_map.hpp"
#include "planar/map/map_queries.hpp"
#include "planar/map/tile_record.hpp"

namespace {

using pose_wall::planar::BeamLine;
using pose_wall::planar::GridMap;
using pose_wall::planar::is_within;
using pose_wall::planar::MapPlace;
using pose_wall::planar::MapWork;
using pose_wall::planar::Turn2;

using Map = pose_wall::Held<GridMap, 0x70616D6C616E616CULL>;

Map* map_of(pose_wall_planar_map* map) {
  return reinterpret_cast<Map*>(map);
}
const Map* map_of(const pose_wall_planar_map* map) {
  return reinterpret_cast<const Map*>(map);
}

bool is_place(double x_m, double y_m) {
  constexpr double kReach_m = POSE_WALL_PLANAR_MAP_REACH_M;  // as the header says
  return is_within(x_m, -kReach_m, kReach_m) && is_within(y_m, -kReach_m, kReach_m);
}

bool is_angle(double angle_rad) {
  constexpr double kMost_rad = POSE_WALL_PLANAR_TURNED_MOST_RAD;  // by the interface
  return is_within(angle_rad, -kMost_rad, kMost_rad);
}

constexpr pose_wall::SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_map_settings, __VA_ARGS__)
#include "pose_wall_planar_map_settings.def"
};

struct MapTable : pose_wall::SettingsTable<pose_wall_planar_map_settings> {
  using SettingsTable::SettingsTable;
  static pose_wall::SettingRows rows() { return pose_wall::rows_of(kRows); }
  pose_wall::SettingFault broken_rule() const;
};

pose_wall::SettingFault MapTable::broken_rule() const {
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

POSE_WALL_EXPORT int32_t pose_wall_planar_map_settings_init(pose_wall_planar_map_settings* settings) {
  return pose_wall::init_settings<MapTable>(settings);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_settings_check(const pose_wall_planar_map_settings* settings,
                                                             pose_wall_planar_fault* fault) {
  return pose_wall::check_settings<MapTable>(settings, fault);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_memory_needed(const pose_wall_planar_map_settings* settings,
                                                            uint64_t* bytes) {
  return pose_wall::part_memory_needed<Map, MapTable>(settings, bytes);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_open(const pose_wall_planar_map_settings* settings, void* block,
                                                   uint64_t block_bytes, pose_wall_planar_map** map) {
  return pose_wall::open_part<Map, MapTable>(settings, block, block_bytes, map,
                                             [](auto& body, const auto& chosen) { body.open(chosen); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_clear(pose_wall_planar_map* map) {
  if (map == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() == POSE_WALL_OK) inside->body().clear();
  return inside.status();
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_on_save(pose_wall_planar_map* map, pose_wall_planar_save save,
                                                      void* context) {
  if (map == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  inside->body().save = save;
  inside->body().save_context = context;
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_insert(pose_wall_planar_map* map, const pose_wall_planar_scan* scan,
                                                     const pose_wall_planar_pose* base,
                                                     pose_wall_planar_map_report* report) {
  if (map == nullptr || scan == nullptr || base == nullptr || report == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  if (const std::int32_t size = pose_wall::check_struct(*report); size != POSE_WALL_OK) return size;
  const std::int32_t status = pose_wall::planar::check_scan(scan);
  if (status != POSE_WALL_OK) return status;
  if (!is_place(base->x_m, base->y_m) || !is_angle(base->yaw_rad)) return POSE_WALL_PLANAR_E_POSE;
  GridMap& body = inside->body();
  const MapWork work = body.insert(*scan, pose_wall::planar::pose_of(*base));
  *report = {sizeof(*report),
             body.tiles().count(),
             work.tiles_new,
             work.tiles_saved,
             work.refused ? 1U : 0U,
             work.beams_not_stored,
             work.things_new,
             work.things_gone,
             body.distances().stale_tiles(),
             0};
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_renew(pose_wall_planar_map* map, uint32_t most, uint32_t* stale) {
  if (map == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  const std::uint32_t waiting = inside->body().renew(most);
  if (stale != nullptr) *stale = waiting;
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_cell(const pose_wall_planar_map* map, double x_m, double y_m,
                                                   pose_wall_planar_cell* cell) {
  if (map == nullptr || cell == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  if (const std::int32_t size = pose_wall::check_struct(*cell); size != POSE_WALL_OK) return size;
  if (!is_place(x_m, y_m)) return POSE_WALL_PLANAR_E_POSE;
  pose_wall::planar::ask_cell(inside->body(), inside->body().place_of(x_m, y_m), cell);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_ray(const pose_wall_planar_map* map, const pose_wall_planar_pose* from,
                                                  double angle_rad, double range_max_m, uint32_t through_unknown,
                                                  pose_wall_planar_ray* ray) {
  if (map == nullptr || from == nullptr || ray == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  if (const std::int32_t size = pose_wall::check_struct(*ray); size != POSE_WALL_OK) return size;
  if (!is_place(from->x_m, from->y_m) || !is_angle(from->yaw_rad) || !is_angle(angle_rad))
    return POSE_WALL_PLANAR_E_POSE;
  if (!is_within(range_max_m, 0.0, 1000.0) || through_unknown > 1) return POSE_WALL_E_VALUE_RANGE;
  const MapPlace place = inside->body().place_of(from->x_m, from->y_m);
  const Turn2 turn(pose_wall::planar::wrapped(from->yaw_rad + angle_rad));
  pose_wall::planar::ask_ray(inside->body(), BeamLine{place.x, place.y, turn.c, turn.s}, range_max_m,
                             through_unknown != 0, ray);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_box(const pose_wall_planar_map* map, pose_wall_planar_box* box) {
  if (map == nullptr || box == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  if (const std::int32_t size = pose_wall::check_struct(*box); size != POSE_WALL_OK) return size;
  pose_wall::planar::ask_box(inside->body(), box);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_grid(const pose_wall_planar_map* map, double x_m, double y_m,
                                                   uint32_t width, uint32_t height, int8_t* cells, uint64_t capacity,
                                                   pose_wall_planar_grid* grid) {
  if (map == nullptr || cells == nullptr || grid == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  if (const std::int32_t size = pose_wall::check_struct(*grid); size != POSE_WALL_OK) return size;
  if (!is_place(x_m, y_m)) return POSE_WALL_PLANAR_E_POSE;
  constexpr std::uint32_t kMost = POSE_WALL_PLANAR_GRID_SIDE_MAX;  // as the header says
  if (width < 1 || width > kMost || height < 1 || height > kMost) return POSE_WALL_PLANAR_E_GRID;
  if (capacity < static_cast<std::uint64_t>(width) * height) return POSE_WALL_E_BUFFER_SMALL;
  const MapPlace place = inside->body().place_of(x_m, y_m);
  const double cell_m = inside->body().settings().cell_m;
  pose_wall::planar::fill_grid(inside->body(), place.cell_x(), place.cell_y(), width, height, cells);
  *grid = {sizeof(*grid), width, height, 0, cell_m, place.cell_x() * cell_m, place.cell_y() * cell_m, cells};
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_put_tile(pose_wall_planar_map* map, const pose_wall_planar_tile* tile) {
  if (map == nullptr || tile == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  const std::int32_t status = pose_wall::planar::check_tile(*tile, inside->body().settings().cell_m);
  if (status != POSE_WALL_OK) return status;
  return inside->body().put(*tile) ? POSE_WALL_OK : POSE_WALL_E_BUFFER_SMALL;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_get_tile(pose_wall_planar_map* map, uint32_t index,
                                                       pose_wall_planar_tile* tile) {
  if (map == nullptr || tile == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  if (const std::int32_t size = pose_wall::check_struct(*tile); size != POSE_WALL_OK) return size;
  if (index >= inside->body().tiles().count()) return POSE_WALL_E_INDEX;
  inside->body().copy_out(inside->body().in_order()[index], tile);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_save_bytes(const pose_wall_planar_map* map, uint64_t* bytes) {
  if (map == nullptr || bytes == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() == POSE_WALL_OK) *bytes = pose_wall::planar::map_bytes(inside->body().tiles().count());
  return inside.status();
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_save_all(pose_wall_planar_map* map, void* bytes, uint64_t capacity,
                                                       uint64_t* written) {
  if (map == nullptr || bytes == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  const std::uint64_t needed = pose_wall::planar::map_bytes(inside->body().tiles().count());
  if (capacity < needed) return POSE_WALL_E_BUFFER_SMALL;
  pose_wall::planar::write_map(&inside->body(), static_cast<unsigned char*>(bytes));
  if (written != nullptr) *written = needed;
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_load_all(pose_wall_planar_map* map, const void* bytes, uint64_t size) {
  if (map == nullptr || bytes == nullptr) return POSE_WALL_E_NULL;
  const pose_wall::Inside<Map> inside(map_of(map));
  if (inside.status() != POSE_WALL_OK) return inside.status();
  return pose_wall::planar::read_map(&inside->body(), static_cast<const unsigned char*>(bytes), size);
}

}  // extern "C"

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The only extern "C" file of the map: checks arguments, translates, calls.

#include "part/export.hpp"
#include "part/held.hpp"
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

std::int32_t refused(pose_wall_planar_fault* fault, const char* member, const char* rule) {
  if (fault != nullptr) {
    fault->member = member;
    fault->rule = rule;
  }
  return POSE_WALL_E_VALUE_RANGE;
}

// Of what stands by itself.
std::int32_t check_numbers(const pose_wall_planar_map_settings& s, pose_wall_planar_fault* fault) {
  const struct {
    double value, least, most;
    const char *member, *rule;
  } rows[] = {
      {static_cast<double>(s.tiles), 1, 65536, "tiles", "tiles must be from 1 to 65536"},
      {static_cast<double>(s.eviction), 0, 1, "eviction", "eviction must be 0 (oldest) or 1 (farthest)"},
      {static_cast<double>(s.renewals), 0, 65536, "renewals", "renewals must be from 0 to 65536"},
      {s.cell_m, 0.02, 0.5, "cell_m", "cell_m must be from 0.02 to 0.5"},
      {s.distance_cap_m, 0, 60, "distance_cap_m", "distance_cap_m must be 0 or from 1 to 120 cells"},
      {s.beam_max_m, 1, 200, "beam_max_m", "beam_max_m must be from 1 to 200"},
      {s.hit_probability, 0.55, 0.95, "hit_probability", "hit_probability must be from 0.55 to 0.95"},
      {s.miss_probability, 0.05, 0.48, "miss_probability", "miss_probability must be from 0.05 to 0.48"},
      {s.least_probability, 0.03, 0.3, "least_probability", "least_probability must be from 0.03 to 0.3"},
      {s.most_probability, 0.7, 0.98, "most_probability", "most_probability must be from 0.7 to 0.98"},
      {s.occupied_probability, 0.55, 0.95, "occupied_probability", "occupied_probability must be from 0.55 to 0.95"},
      {s.free_probability, 0.05, 0.48, "free_probability", "free_probability must be from 0.05 to 0.48"}};
  for (const auto& row : rows) {
    if (!is_within(row.value, row.least, row.most)) return refused(fault, row.member, row.rule);
  }
  return POSE_WALL_OK;
}

pose_wall_planar_map_settings defaults() {
  pose_wall_planar_map_settings settings{};
  settings.struct_size = sizeof(settings);
  settings.tiles = 1024;
  settings.eviction = POSE_WALL_PLANAR_OLDEST;
  settings.renewals = 64;
  settings.cell_m = 0.05;
  settings.distance_cap_m = 2.0;
  settings.beam_max_m = 30.0;
  settings.hit_probability = 0.7;
  settings.miss_probability = 0.4;
  settings.least_probability = 0.12;
  settings.most_probability = 0.97;
  settings.occupied_probability = 0.65;
  settings.free_probability = 0.35;
  return settings;
}

// Those given, or the defaults for NULL.
std::int32_t chosen_settings(const pose_wall_planar_map_settings* given, pose_wall_planar_map_settings* chosen) {
  *chosen = defaults();
  if (given == nullptr) return POSE_WALL_OK;
  const std::int32_t status = pose_wall_planar_map_settings_check(given, nullptr);
  if (status == POSE_WALL_OK) *chosen = *given;
  return status;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT int32_t pose_wall_planar_map_settings_init(pose_wall_planar_map_settings* settings) {
  if (settings == nullptr) return POSE_WALL_E_NULL;
  *settings = defaults();
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_settings_check(const pose_wall_planar_map_settings* settings,
                                                             pose_wall_planar_fault* fault) {
  if (settings == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = pose_wall::check_struct(*settings); size != POSE_WALL_OK) return size;
  const std::int32_t status = check_numbers(*settings, fault);
  if (status != POSE_WALL_OK) return status;
  const double cap_cells = settings->distance_cap_m / settings->cell_m;
  if (settings->distance_cap_m != 0.0 && !is_within(cap_cells, 1.0 - 1e-9, 120.0 + 1e-9)) {
    return refused(fault, "distance_cap_m", "distance_cap_m must be 0 or from 1 to 120 cells");
  }
  if (settings->occupied_probability > settings->most_probability) {
    return refused(fault, "occupied_probability", "occupied_probability must be at most most_probability");
  }
  if (settings->free_probability < settings->least_probability) {
    return refused(fault, "free_probability", "free_probability must be at least least_probability");
  }
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_memory_needed(const pose_wall_planar_map_settings* settings,
                                                            uint64_t* bytes) {
  if (bytes == nullptr) return POSE_WALL_E_NULL;
  pose_wall_planar_map_settings chosen;
  const std::int32_t status = chosen_settings(settings, &chosen);
  if (status == POSE_WALL_OK) *bytes = Map::bytes(chosen);
  return status;
}

POSE_WALL_EXPORT int32_t pose_wall_planar_map_open(const pose_wall_planar_map_settings* settings, void* block,
                                                   uint64_t block_bytes, pose_wall_planar_map** map) {
  if (block == nullptr || map == nullptr) return POSE_WALL_E_NULL;
  pose_wall_planar_map_settings chosen;
  std::int32_t status = chosen_settings(settings, &chosen);
  Map* opened = nullptr;
  if (status == POSE_WALL_OK) status = Map::place(block, block_bytes, &opened, chosen);
  if (status != POSE_WALL_OK) return status;
  opened->body().open(chosen);
  *map = reinterpret_cast<pose_wall_planar_map*>(opened);
  return POSE_WALL_OK;
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

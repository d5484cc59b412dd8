// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/built_map.hpp"

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "pose_wall_planar_map.h"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kTilesMost = 65536.0;  // of pose_wall_planar_map_settings

// The corners about all that the scans reach.
struct ReachedBox {
  double x_min_m = 0.0, y_min_m = 0.0, x_max_m = 0.0, y_max_m = 0.0;
  bool is_empty = true;

  void include(double x_m, double y_m) {
    x_min_m = is_empty ? x_m : std::min(x_min_m, x_m);
    x_max_m = is_empty ? x_m : std::max(x_max_m, x_m);
    y_min_m = is_empty ? y_m : std::min(y_min_m, y_m);
    y_max_m = is_empty ? y_m : std::max(y_max_m, y_m);
    is_empty = false;
  }
};

ReachedBox corners_of(const std::vector<KeptScan>& scans, const std::vector<pose_wall_planar_pose>& poses,
                      double beam_max_m) {
  ReachedBox corners;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const pose_wall_planar_scan& scan = scans[k].scan;
    const pose_wall_planar_pose sensor = combined(poses.at(k), scan.sensor);
    corners.include(sensor.x_m, sensor.y_m);
    for (std::size_t beam = 0; beam < scans[k].range_m.size(); ++beam) {
      const double range_m = std::min(static_cast<double>(scans[k].range_m[beam]), beam_max_m);
      if (!(range_m > 0.0)) continue;
      const double angle_rad = sensor.yaw_rad + scan.angle_min_rad + static_cast<double>(beam) * scan.angle_step_rad;
      corners.include(sensor.x_m + range_m * std::cos(angle_rad), sensor.y_m + range_m * std::sin(angle_rad));
    }
  }
  return corners;
}

std::uint32_t tiles_for(const ReachedBox& corners, double cell_m) {
  const double tile_m = POSE_WALL_PLANAR_TILE_SIDE * cell_m;
  // Two more on each side: one for a part of a tile, one for the cells behind a range's end.
  const double across = std::ceil((corners.x_max_m - corners.x_min_m) / tile_m) + 2.0;
  const double up = std::ceil((corners.y_max_m - corners.y_min_m) / tile_m) + 2.0;
  return static_cast<std::uint32_t>(std::min(across * up, kTilesMost));
}

class OpenMap {
 public:
  explicit OpenMap(const pose_wall_planar_map_settings& settings) : block_(bytes_for(settings)) {
    require_ok(pose_wall_planar_map_open(&settings, block_.data(), block_.bytes(), &map_),
               translatable("the settings of the map"));
  }

  std::uint64_t insert(const KeptScan& scan, const pose_wall_planar_pose& base) {
    pose_wall_planar_map_report report{};
    report.struct_size = sizeof report;
    const pose_wall_planar_scan view = scan.view();
    require_ok(pose_wall_planar_map_insert(map_, &view, &base, &report), translatable("the scan"));
    return report.beams_not_stored;
  }

  void read_into(BuiltMap* built, double cell_m) const {
    pose_wall_planar_box box{};
    box.struct_size = sizeof box;
    require_ok(pose_wall_planar_map_box(map_, &box), translatable("the map"));
    built->cells_seen = box.cells_seen;
    built->things = box.things;
    built->block_bytes = block_.bytes();
    if (box.cells_seen == 0) return;
    const double width = std::round((box.x_max_m - box.x_min_m) / cell_m);
    const double height = std::round((box.y_max_m - box.y_min_m) / cell_m);
    if (std::max(width, height) > POSE_WALL_PLANAR_GRID_SIDE_MAX) {
      throw PlanarError(
          say("the map is {:.0f} x {:.0f} m; its image holds {} cells a side. Larger cells: --cell {:.2f}",
              box.x_max_m - box.x_min_m, box.y_max_m - box.y_min_m, POSE_WALL_PLANAR_GRID_SIDE_MAX,
              1.01 * cell_m * std::max(width, height) / POSE_WALL_PLANAR_GRID_SIDE_MAX));
    }
    MapFile& map = built->map;
    map.width = static_cast<std::uint32_t>(width);
    map.height = static_cast<std::uint32_t>(height);
    map.cells.resize(std::size_t{map.width} * map.height);
    pose_wall_planar_grid grid{};
    grid.struct_size = sizeof grid;
    // The middle of the corner's cell: its edge may round into the cell beside it.
    require_ok(pose_wall_planar_map_grid(map_, box.x_min_m + 0.5 * cell_m, box.y_min_m + 0.5 * cell_m, map.width,
                                         map.height, map.cells.data(), map.cells.size(), &grid),
               translatable("the map"));
    map.resolution_m = grid.resolution_m;
    map.origin_x_m = grid.origin_x_m;
    map.origin_y_m = grid.origin_y_m;
  }

 private:
  static std::uint64_t bytes_for(const pose_wall_planar_map_settings& settings) {
    std::uint64_t bytes = 0;
    require_ok(pose_wall_planar_map_memory_needed(&settings, &bytes), translatable("the settings of the map"));
    return bytes;
  }

  PartBlock block_;
  pose_wall_planar_map* map_ = nullptr;
};

}  // namespace

BuiltMap build_map(const std::vector<KeptScan>& scans, const std::vector<pose_wall_planar_pose>& poses, double cell_m) {
  pose_wall_planar_map_settings settings{};
  require_ok(pose_wall_planar_map_settings_init(&settings), translatable("the settings of the map"));
  settings.cell_m = cell_m;
  settings.distance_cap_m = 0.0;  // the file holds none
  settings.tiles = tiles_for(corners_of(scans, poses, settings.beam_max_m), cell_m);
  OpenMap map(settings);
  BuiltMap built;
  for (std::size_t k = 0; k < scans.size(); ++k) built.beams_not_stored += map.insert(scans[k], poses.at(k));
  map.read_into(&built, cell_m);
  return built;
}

}  // namespace pose_wall::tools

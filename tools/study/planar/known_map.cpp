// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/known_map.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "io/language/language.hpp"
#include "study/planar/carmen_scans.hpp"
#include "study/planar/plane_pose.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kTrailName = "trail.pwt";
constexpr const char* kCellsName = "map.yaml";
constexpr std::int8_t kUnseenCell = -1, kFreeCell = 0, kSurfaceCell = 100;

bool is_regular(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

// Every surface point as a place of the map.
template <typename Use>
void each_point(const SavedTrail& trail, const Use& use) {
  for (std::uint32_t k = 0; k < trail.keyframes(); ++k) {
    const pose_wall_planar_pose pose = trail.keyframe(k).pose;
    const std::vector<float> xy_m = trail.points(k);
    for (std::size_t i = 0; i + 1 < xy_m.size(); i += 2) {
      use(combined(pose, {static_cast<double>(xy_m[i]), static_cast<double>(xy_m[i + 1]), 0.0}));
    }
  }
}

// Surfaces alone; for a picture where the trail stands without its map.yaml.
MapFile cells_of(const SavedTrail& trail) {
  double x_min_m = INFINITY, y_min_m = INFINITY, x_max_m = -INFINITY, y_max_m = -INFINITY;
  each_point(trail, [&](const pose_wall_planar_pose& at) {
    x_min_m = std::min(x_min_m, at.x_m);
    y_min_m = std::min(y_min_m, at.y_m);
    x_max_m = std::max(x_max_m, at.x_m);
    y_max_m = std::max(y_max_m, at.y_m);
  });
  MapFile map;
  if (!(x_min_m <= x_max_m)) return map;
  constexpr double kFine_m = 0.1, kCells = 4000.0;  // a picture has fewer pixels
  map.resolution_m = std::max({kFine_m, (x_max_m - x_min_m) / kCells, (y_max_m - y_min_m) / kCells});
  map.origin_x_m = x_min_m - map.resolution_m;
  map.origin_y_m = y_min_m - map.resolution_m;
  const auto cells = [&map](double from_m, double to_m) {
    return static_cast<std::uint32_t>((to_m - from_m) / map.resolution_m) + 2;
  };
  map.width = cells(map.origin_x_m, x_max_m);
  map.height = cells(map.origin_y_m, y_max_m);
  map.cells.assign(std::size_t{map.width} * map.height, kUnseenCell);
  each_point(trail, [&map](const pose_wall_planar_pose& at) {
    const auto column = static_cast<std::size_t>((at.x_m - map.origin_x_m) / map.resolution_m);
    const auto row = static_cast<std::size_t>((at.y_m - map.origin_y_m) / map.resolution_m);
    map.cells.at(row * map.width + column) = kSurfaceCell;
  });
  return map;
}

KnownMap known_by_trail(const std::filesystem::path& file) {
  KnownMap map;
  map.file = file;
  map.files = {file};
  map.trail = std::make_unique<SavedTrail>(file);
  if (map.trail->keyframes() == 0) throw TrailFileError(say("{}: the trail has no keyframe", file.string()));
  const std::filesystem::path cells = file.parent_path() / kCellsName;
  if (is_regular(cells)) {
    map.cells = read_map_files(cells);
    map.files.push_back(cells);
  } else {
    map.cells = cells_of(*map.trail);
  }
  return map;
}

KnownMap known_by_cells(const std::filesystem::path& file) {
  KnownMap map;
  map.file = file;
  map.files = {file};
  map.cells = read_map_files(file);
  return map;
}

}  // namespace

bool KnownMap::has_moved(double x_m, double y_m) const {
  const double column = std::floor((x_m - cells.origin_x_m) / cells.resolution_m);
  const double row = std::floor((y_m - cells.origin_y_m) / cells.resolution_m);
  if (!(column >= 1.0 && row >= 1.0 && column + 1.0 < cells.width && row + 1.0 < cells.height)) return false;
  const auto at = static_cast<std::size_t>(row) * cells.width + static_cast<std::size_t>(column);
  for (const std::size_t line : {at - cells.width, at, at + cells.width}) {
    for (const std::size_t cell : {line - 1, line, line + 1}) {
      if (cells.cells[cell] != kFreeCell) return false;
    }
  }
  return true;
}

KnownMap read_known_map(const std::filesystem::path& map) {
  std::error_code ignored;
  if (std::filesystem::is_directory(map, ignored)) {
    if (is_regular(map / kTrailName)) return known_by_trail(map / kTrailName);
    if (is_regular(map / kCellsName)) return known_by_cells(map / kCellsName);
    throw TrailFileError(say("{}: the folder has neither {} nor {}. `pose_wall map -o FOLDER INPUT` writes both",
                             map.string(), kTrailName, kCellsName));
  }
  const std::string ending = map.extension().string();
  if (ending == ".yaml" || ending == ".yml") return known_by_cells(map);
  if (ending == ".pgm") throw MapFileError(say("{}: give the map's YAML file, which places this image", map.string()));
  if (is_carmen_log(map)) {
    throw TrailFileError(
        say("{}: this is a log of scans, no map. Make one first: pose_wall map -o map {}", map.string(), map.string()));
  }
  return known_by_trail(map);
}

}  // namespace pose_wall::tools

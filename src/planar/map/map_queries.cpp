// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/map/map_queries.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/math/bits.hpp"
#include "base/math/finite.hpp"

namespace pose_wall::planar {
namespace {

// The cells that a line goes through, each with where it enters and leaves (Amanatides and Woo 1987).
class CellsOfLine {
 public:
  explicit CellsOfLine(const BeamLine& line)
      : x_(static_cast<std::int32_t>(std::floor(line.x))),
        y_(static_cast<std::int32_t>(std::floor(line.y))),
        along_x_(line.x - std::floor(line.x), line.direction_x),
        along_y_(line.y - std::floor(line.y), line.direction_y) {}

  std::int32_t x() const { return x_; }
  std::int32_t y() const { return y_; }
  double entered() const { return entered_; }
  double left() const { return std::min(along_x_.next, along_y_.next); }
  void go_on() {
    entered_ = left();
    if (along_x_.next < along_y_.next) {
      along_x_.next += along_x_.apart;
      x_ += along_x_.step;
    } else {
      along_y_.next += along_y_.apart;
      y_ += along_y_.step;
    }
  }

 private:
  struct Axis {
    Axis(double inside, double direction) {
      constexpr double kNever = 1e300;  // a line along the other axis
      if (direction == 0.0) {
        apart = next = kNever;
        return;
      }
      apart = std::abs(1.0 / direction);
      next = (direction > 0.0 ? 1.0 - inside : inside) * apart;
      step = direction > 0.0 ? 1 : -1;
    }
    double apart = 0.0, next = 0.0;
    std::int32_t step = 0;
  };

  std::int32_t x_, y_;
  Axis along_x_, along_y_;
  double entered_ = 0.0;
};

struct Extent {
  CellBox box;
  std::uint64_t seen = 0;
};

Extent extent_of(const std::uint8_t* cells, const CellBox& whole) {
  Extent extent;
  for (std::int32_t y = 0; y < kTileSide; ++y) {
    std::int32_t first = kTileSide, last = -1;
    for (std::int32_t x = 0; x < kTileSide; ++x) {
      if (cells[y * kTileSide + x] == kNeverSeen) continue;
      ++extent.seen;
      first = std::min(first, x);
      last = x;
    }
    if (last >= 0) extent.box.take_in({whole.x0 + first, whole.y0 + y, whole.x0 + last, whole.y0 + y});
  }
  return extent;
}

}  // namespace

std::uint32_t state_of(const CellModel& model, std::uint8_t value) {
  if (value == kNeverSeen) return POSE_WALL_PLANAR_CELL_UNKNOWN;
  if (value >= model.thing_from) return POSE_WALL_PLANAR_CELL_THING;
  return value <= model.free_up_to ? POSE_WALL_PLANAR_CELL_FREE : POSE_WALL_PLANAR_CELL_UNKNOWN;
}

void ask_cell(const GridMap& map, const MapPlace& place, pose_wall_planar_cell* cell) {
  const std::int32_t x = place.cell_x(), y = place.cell_y();
  const std::uint8_t value = map.value_at(x, y);
  cell->state = state_of(map.model(), value);
  cell->probability = value != kNeverSeen ? probability_of(value) : not_a_number();
  cell->distance_m = not_a_number();
  if (!map.distances().kept()) return;
  cell->distance_m = std::sqrt(static_cast<double>(map.distances().square_at(x, y))) * map.settings().cell_m;
}

void ask_ray(const GridMap& map, const BeamLine& line, double range_max_m, bool through_unknown,
             pose_wall_planar_ray* ray) {
  const double cell_m = map.settings().cell_m, range_cells = range_max_m / cell_m;
  ray->end = POSE_WALL_PLANAR_RAY_OPEN;
  ray->range_m = range_max_m;
  const auto most = static_cast<std::int64_t>(2.0 * range_cells) + 4;  // cells on a line of that length
  CellsOfLine at(line);
  for (std::int64_t k = 0; k < most && at.entered() <= range_cells; ++k, at.go_on()) {
    const std::uint32_t state = state_of(map.model(), map.value_at(at.x(), at.y()));
    if (state == POSE_WALL_PLANAR_CELL_FREE) continue;
    if (state == POSE_WALL_PLANAR_CELL_UNKNOWN && through_unknown) continue;
    ray->end = state == POSE_WALL_PLANAR_CELL_THING ? POSE_WALL_PLANAR_RAY_THING : POSE_WALL_PLANAR_RAY_UNKNOWN;
    ray->range_m = 0.5 * (at.entered() + std::min(at.left(), range_cells)) * cell_m;
    return;
  }
}

void ask_box(const GridMap& map, pose_wall_planar_box* box) {
  CellBox all;
  box->tiles = map.tiles().count();
  box->tiles_stale = map.distances().stale_tiles();
  box->reserved = 0;
  box->cells_seen = box->things = 0;
  for (std::uint32_t tile = 0; tile < box->tiles; ++tile) {
    const TileHead& head = map.tiles().head(tile);
    const Extent extent = extent_of(map.tiles().cells(tile), head.box());
    box->cells_seen += extent.seen;
    box->things += head.things;
    all.take_in(extent.box);
  }
  const double cell_m = map.settings().cell_m, none = not_a_number();
  box->x_min_m = all.empty() ? none : all.x0 * cell_m;
  box->y_min_m = all.empty() ? none : all.y0 * cell_m;
  box->x_max_m = all.empty() ? none : (all.x1 + 1) * cell_m;
  box->y_max_m = all.empty() ? none : (all.y1 + 1) * cell_m;
}

void fill_grid(const GridMap& map, std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height,
               std::int8_t* cells) {
  const auto columns = static_cast<std::int32_t>(width), rows = static_cast<std::int32_t>(height);
  for (std::int32_t row = 0; row < rows; ++row) {
    std::int8_t* const out = cells + static_cast<std::int64_t>(row) * columns;
    for (std::int32_t column = 0; column < columns;) {
      const std::int32_t inside = inside_tile(x + column);
      const std::int32_t part = std::min(kTileSide - inside, columns - column);
      const std::uint32_t tile = map.tiles().find(tile_of(x + column), tile_of(y + row));
      const std::uint8_t* const from =
          tile != kNoTile ? map.tiles().cells(tile) + inside_tile(y + row) * kTileSide + inside : nullptr;
      for (std::int32_t k = 0; k < part; ++k) {
        out[column + k] = from != nullptr ? map.model().per_cent[from[k]] : std::int8_t{POSE_WALL_PLANAR_UNKNOWN};
      }
      column += part;
    }
  }
}

}  // namespace pose_wall::planar

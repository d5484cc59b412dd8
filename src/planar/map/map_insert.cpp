// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From a scan to its cells: things first, which mark their cells, then the free ways, which leave marked cells alone.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planar/map/grid_map.hpp"

namespace pose_wall::planar {
namespace {

double squared(double a) {
  return a * a;
}

// As far as the walk stays in the tile whose cells these are. The axes by template: this loop is most of a scan's time.
template <bool kAlongY>
void free_in_tile(const CellModel& model, std::int32_t corner_x, std::int32_t corner_y, std::uint8_t* cells,
                  BeamWalk* walk) {
  BeamWalk at = *walk;
  const std::int32_t corner = kAlongY ? corner_y : corner_x, corner_across = kAlongY ? corner_x : corner_y;
  const std::int32_t inside = at.at - corner, to_edge = at.step > 0 ? kTileSide - inside : inside + 1;
  const std::int64_t most = std::min<std::int64_t>(at.cells, to_edge);
  // From cell to cell along either axis:
  constexpr std::ptrdiff_t kStride = kAlongY ? kTileSide : 1, kStrideAcross = kAlongY ? 1 : kTileSide;
  std::uint8_t* main = cells + inside * kStride;
  const std::ptrdiff_t stride = at.step * kStride;
  std::int64_t done = 0;
  for (; done < most; ++done, main += stride, at.across += at.slope) {
    const auto across = static_cast<std::uint32_t>(at.cell_across() - corner_across);
    if (across >= static_cast<std::uint32_t>(kTileSide)) break;
    std::uint8_t& cell = main[across * kStrideAcross];
    cell = model.miss[at.beside_middle()][cell];
  }
  walk->across = at.across;
  walk->at += static_cast<std::int32_t>(done) * at.step;
  walk->cells -= done;
}

}  // namespace

void GridMap::read_scan(const pose_wall_planar_scan& scan, const Pose2& base) {
  scan_ = read_beams(scan, beams_);
  step_rad_ = std::abs(scan.angle_step_rad);
  const Turn2 turn(wrapped(base.yaw_rad));
  const Eigen::Vector2d sensor_m = turn * scan_.origin_m + base.place();
  sensor_ = place_of(sensor_m.x(), sensor_m.y());
  for (std::uint32_t k = 0; k < scan_.beams.size(); ++k) {
    Beam& beam = beams_[k];
    const Eigen::Vector2d direction =
        turn * Eigen::Vector2d(static_cast<double>(beam.direction_x), static_cast<double>(beam.direction_y));
    beam.direction_x = static_cast<float>(direction.x());
    beam.direction_y = static_cast<float>(direction.y());
    beam.range_m = static_cast<float>(static_cast<double>(beam.range_m) / settings_.cell_m);  // from here on in cells
    if (static_cast<double>(beam.range_m) * settings_.cell_m <= settings_.beam_max_m) continue;
    beam.range_m = static_cast<float>(settings_.beam_max_m / settings_.cell_m);
    if (beam.end == BeamEnd::thing) beam.end = BeamEnd::open;
  }
  for (std::uint32_t k = 0; k < scan_.beams.size(); ++k) {
    free_[k] = static_cast<float>(free_cells(k));
    unstored_[k] = 0;
  }
}

// Between a beam and the surface from its end to that of another beam; 0 where there is none.
double GridMap::sine_of_incidence(std::uint32_t beam, std::int64_t lag) const {
  const std::int64_t other = static_cast<std::int64_t>(beam) + lag;
  if (other < 0 || other >= static_cast<std::int64_t>(scan_.beams.size())) return 0.0;
  const Beam &a = beams_[beam], &b = beams_[static_cast<std::uint32_t>(other)];
  if (b.end != BeamEnd::thing) return 0.0;
  const double ax = static_cast<double>(a.direction_x), ay = static_cast<double>(a.direction_y);
  const double along_x =
      static_cast<double>(b.range_m) * static_cast<double>(b.direction_x) - static_cast<double>(a.range_m) * ax;
  const double along_y =
      static_cast<double>(b.range_m) * static_cast<double>(b.direction_y) - static_cast<double>(a.range_m) * ay;
  const double length = std::sqrt(squared(along_x) + squared(along_y));
  return length > 0.0 ? std::abs(ax * along_y - ay * along_x) / length : 0.0;
}

// In cells along the beam: one cell, or two standard deviations, across the surface that it ends at. The surface is
// taken from the ends of beams to both sides that lie two cells off. The less it is grazed by them counts: next to an
// edge one of them is on another surface.
double GridMap::grazing_margin(std::uint32_t beam) const {
  constexpr double kSurfaceCells = 2.0;  // ends closer together would show the noise of ranges and cells
  constexpr double kBeamsMost = 64.0;    // of dense scans close by: the loop and the surface stay small
  constexpr double kSineLeast = 0.1;     // about 6 degrees: further back is other rock
  constexpr double kSineAlone = 0.5;     // 30 degrees, where no other beam shows the surface
  const double across = std::max(1.0, 2.0 * scan_.sigma_m / settings_.cell_m);
  const double apart = static_cast<double>(beams_[beam].range_m) * step_rad_;
  const double wanted = std::ceil(kSurfaceCells / std::max(apart, kSurfaceCells / kBeamsMost));
  const auto lag = static_cast<std::int64_t>(wanted);
  const double sine = std::max(sine_of_incidence(beam, lag), sine_of_incidence(beam, -lag));
  return across / (sine > 0.0 ? std::max(sine, kSineLeast) : kSineAlone);
}

double GridMap::free_cells(std::uint32_t beam) const {
  constexpr double kNone = -1.0;  // not even the sensor's own cell
  const Beam& ray = beams_[beam];
  if (ray.end == BeamEnd::unknown) return kNone;
  if (ray.end == BeamEnd::open) return static_cast<double>(ray.range_m);
  return std::max(static_cast<double>(ray.range_m) - grazing_margin(beam), kNone);
}

// Near the sensor many beams share a cell. Beam k, where 2^n is the highest power of two that divides it, lies between
// two that 2^(n+1) divides. Up to where these are half a cell apart, or the nearer of them ends, they cover its way.
double GridMap::first_cell(std::uint32_t beam) const {
  constexpr double kApart = 0.5;  // cells between the two beams: each cell between them is crossed by one of them
  const std::uint32_t half = beam & (~beam + 1);
  if (beam == 0 || beam + half >= scan_.beams.size()) return 0.0;
  const double both = static_cast<double>(std::min(free_[beam - half], free_[beam + half]));
  return std::min(kApart / (2.0 * half * step_rad_), std::max(both, 0.0));
}

void GridMap::move_to(std::int32_t x, std::int32_t y, MapWork* work) {
  if (cursor_.holds(x, y)) return;
  const std::uint32_t tile = tile_for_writing(tile_of(x), tile_of(y), work);
  cursor_.x = tile_of(x) * kTileSide;
  cursor_.y = tile_of(y) * kTileSide;
  cursor_.stored = tile != kNoTile;
  cursor_.cells = cursor_.stored ? tiles_.cells(tile) : nowhere_.data();
}

void GridMap::mark_things(MapWork* work) {
  for (std::uint32_t k = 0; k < scan_.beams.size(); ++k) {
    const Beam& beam = beams_[k];
    if (beam.end != BeamEnd::thing) continue;
    const MapPlace end{sensor_.x + static_cast<double>(beam.range_m) * static_cast<double>(beam.direction_x),
                       sensor_.y + static_cast<double>(beam.range_m) * static_cast<double>(beam.direction_y)};
    const std::int32_t x = end.cell_x(), y = end.cell_y();
    move_to(x, y, work);
    std::uint8_t& cell = cursor_.at(x, y);
    cell = model_.hit[cell];
    if (!cursor_.stored) unstored_[k] = 1;
  }
}

// False where some of its cells had no tile.
bool GridMap::free_way(const BeamWalk& walk, MapWork* work) {
  bool stored = true;
  BeamWalk at = walk;
  while (at.more()) {
    move_to(at.x(), at.y(), work);
    stored = stored && cursor_.stored;
    if (at.along_y) free_in_tile<true>(model_, cursor_.x, cursor_.y, cursor_.cells, &at);
    if (!at.along_y) free_in_tile<false>(model_, cursor_.x, cursor_.y, cursor_.cells, &at);
  }
  return stored;
}

void GridMap::free_ways(MapWork* work) {
  for (std::uint32_t k = 0; k < scan_.beams.size(); ++k) {
    if (beams_[k].end == BeamEnd::unknown) continue;
    const BeamLine line{sensor_.x, sensor_.y, static_cast<double>(beams_[k].direction_x),
                        static_cast<double>(beams_[k].direction_y)};
    if (!free_way(line.walk(first_cell(k), static_cast<double>(free_[k])), work)) unstored_[k] = 1;
  }
}

MapWork GridMap::insert(const pose_wall_planar_scan& scan, const Pose2& base) {
  ++call_;
  MapWork work;
  read_scan(scan, base);
  mark_things(&work);
  free_ways(&work);
  for (std::uint32_t k = 0; k < touched_count_; ++k) {
    TileHead& head = tiles_.head(touched_[k]);
    head.stamp_ns = scan_.stamp_ns;
    ++head.scans;
  }
  settle(&work);
  for (std::uint32_t k = 0; k < scan_.beams.size(); ++k) work.beams_not_stored += unstored_[k];
  return work;
}

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_evidence.hpp"

#include <cmath>

#include "estimation/near_plane.hpp"

namespace pose_wall {
namespace {

constexpr double kRow_m = 0.3;

void count_up(std::uint16_t* counter, std::uint32_t by) {
  const std::uint32_t sum = *counter + by;
  *counter = static_cast<std::uint16_t>(sum < 0xFFFF ? sum : 0xFFFF);
}

}  // namespace

void WallGrid::lay_out(Arena& arena) {
  hits_ = arena.take<std::uint16_t>(kColumns * kRowsMax);
  through_ = arena.take<std::uint16_t>(kColumns * kRowsMax);
}

bool WallGrid::cell_of(double along_m, double z_level_m, std::uint32_t* cell) const {
  const double column = along_m * (1.0 / kColumn_m) + kColumns / 2.0, row = (z_level_m - z_min_) * rows_per_m_;
  if (!(column >= 0.0 && column < kColumns && row >= 0.0 && row < rows_)) return false;
  *cell = static_cast<std::uint32_t>(row) * kColumns + static_cast<std::uint32_t>(column);
  return true;
}

void WallGrid::mark(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, const Reach& reach) {
  hits_.fill(0);
  through_.fill(0);
  inliers_ = 0.0;
  const double height_m = scene.z_max_level_m - scene.z_min_level_m;
  z_min_ = scene.z_min_level_m;
  row_m_ = height_m / kRowsMax > kRow_m ? height_m / kRowsMax : kRow_m;
  rows_per_m_ = 1.0 / row_m_;
  rows_ = static_cast<std::uint32_t>(std::ceil(height_m / row_m_ - 1e-9));
  const Eigen::Vector3d& sensor = scene.sensor_level_m;
  const double sensor_inside_m = wall.signed_distance(sensor);
  const auto pass_through = [&](const Eigen::Vector3d& p, double r, std::uint32_t rays) {
    if (!(r < -reach.behind_m && sensor_inside_m > 0.0)) return;
    const Eigen::Vector3d crossing = sensor + (p - sensor) * way_to_plane(sensor_inside_m, r);
    std::uint32_t cell = 0;
    if (cell_of(along_level.dot(crossing), crossing.z(), &cell)) count_up(&through_[cell], rays);
  };
  for_each_up_to(scene.band_level, wall, reach.hit_m, [&](std::uint32_t i, float distance_m) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = static_cast<double>(distance_m);
    std::uint32_t cell = 0;
    if (r >= -reach.hit_m) {
      inliers_ += static_cast<double>(scene.band_level.weight[i]);
      if (cell_of(along_level.dot(p), p.z(), &cell)) count_up(&hits_[cell], 1);
    } else {
      pass_through(p, r, 1);
    }
  });
  for_each_up_to(scene.beyond_level, wall, -reach.behind_m, [&](std::uint32_t i, float distance_m) {
    pass_through(scene.beyond_level.at(i), static_cast<double>(distance_m),
                 static_cast<std::uint32_t>(scene.beyond_level.weight[i]));
  });
  for (std::uint32_t column = 0; column < kColumns; ++column) count_rows(column);
}

void WallGrid::count_rows(std::uint32_t column) {
  std::uint8_t solid_rows = 0, open_rows = 0;
  for (std::uint32_t row = 0; row < rows_; ++row) {
    const std::uint32_t cell = row * kColumns + column;
    solid_rows = static_cast<std::uint8_t>(solid_rows + (solid(cell) ? 1 : 0));
    open_rows = static_cast<std::uint8_t>(open_rows + (open(cell) ? 1 : 0));
  }
  solid_rows_[column] = solid_rows;
  open_rows_[column] = open_rows;
}

WallEvidence WallGrid::evidence() const {
  WallEvidence out;
  std::uint32_t solid_cells = 0, own_open_cells = 0, columns = 0;
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    const std::uint32_t solid_rows = solid_rows_[column], open_rows = open_rows_[column];
    if (solid_rows == 0) continue;  // nothing of the plane here: an opening speaks against nothing
    solid_cells += solid_rows;
    own_open_cells += open_rows;
    if (solid_rows < open_rows) continue;
    const double along = (static_cast<double>(column) - kColumns / 2) * kColumn_m;
    if (columns == 0) out.along_min_m = along;
    out.along_max_m = along + kColumn_m;
    ++columns;
  }
  out.inliers = static_cast<std::uint32_t>(inliers_);
  out.length_m = static_cast<double>(columns) * kColumn_m;
  out.area_m2 = static_cast<double>(solid_cells) * kColumn_m * row_m_;
  if (solid_cells > 0) {
    out.seen_through = static_cast<double>(own_open_cells) / static_cast<double>(solid_cells + own_open_cells);
  }
  const double solidity = 1.0 - out.seen_through;
  out.score_m2 = out.area_m2 * solidity * solidity;
  return out;
}

double WallGrid::gap_to_solid_m(double along_m) const {
  constexpr double kNone_m = 1e3;
  double nearest = kNone_m;
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    if (!column_is_solid(column)) continue;
    const double low = (static_cast<double>(column) - kColumns / 2) * kColumn_m;
    double gap = 0.0;
    if (along_m < low) gap = low - along_m;
    if (along_m > low + kColumn_m) gap = along_m - low - kColumn_m;
    if (gap < nearest) nearest = gap;
  }
  return nearest;
}

bool WallGrid::solid_at(double along_m, double z_level_m) const {
  std::uint32_t cell = 0;
  return cell_of(along_m, z_level_m, &cell) && solid(cell) &&
         column_is_solid(static_cast<std::uint32_t>(cell % kColumns));
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/propose/evidence.hpp"

#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/math/finite.hpp"

namespace pose_wall {
namespace {

// Separates pipes from a wall; a sparse sensor fills it; swept: half 9 lost 11 won 1 beyond, twice 10 lost 6 won.
constexpr double kRow_m = 0.3;

void count_up(std::uint16_t* counter, std::uint32_t by) {
  const std::uint32_t sum = *counter + by;
  *counter = static_cast<std::uint16_t>(sum < 0xFFFF ? sum : 0xFFFF);
}

}  // namespace

void WallGrid::lay_out(Arena& arena) {
  counters_ = arena.take<std::uint16_t>(2 * kCells + 1);
}

// Tests four points, or the rays to them, against a plane, in floats: no cell is known to the millimetre.
class WallGrid::FourMarks {
 public:
  // Not inlined: it is called from two places.
  [[gnu::noinline]] FourMarks(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level,
                              const Reach& reach)
      : slab_(wall, kAnyDepth_m, larger(reach.hit_m, -reach.behind_m)),
        hit_m_(static_cast<float>(reach.hit_m)),
        behind_m_(static_cast<float>(-reach.behind_m)),
        inside_m_(static_cast<float>(wall.signed_distance(scene.sensor_level_m))),
        along_x_(static_cast<float>(along_level.x())),
        along_y_(static_cast<float>(along_level.y())),
        sensor_along_m_(static_cast<float>(along_level.dot(scene.sensor_level_m))),
        sensor_z_m_(static_cast<float>(scene.sensor_level_m.z())) {}

  // The slab of points that count: points further before the plane show nothing.
  const Slab& slab() const { return slab_; }

  // False if none of the four counts.
  bool look_at(FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourFloats r = slab_.distances().of(x, y, z);
    hits = counts & (r <= hit_m_) & (r >= -hit_m_);
    passes = counts & (r < behind_m_) & (r < -hit_m_);
    if (!(inside_m_ > 0.0F)) passes = FourTruths{};
    if (!any_of(hits | passes)) return false;
    // A passing ray marks the place where it meets the plane, a point on the plane its own.
    const FourFloats way = hits ? all_four(1.0F) : way_to_plane(inside_m_, r);
    along_m = on_the_way(sensor_along_m_, along_x_ * x + along_y_ * y, way);
    z_level_m = on_the_way(sensor_z_m_, z, way);
    return true;
  }

  FourTruths hits{}, passes{};
  FourFloats along_m{}, z_level_m{};

 private:
  Slab slab_;
  float hit_m_, behind_m_, inside_m_, along_x_, along_y_, sensor_along_m_, sensor_z_m_;
};

FourInts WallGrid::Rows::cells_of(FourFloats along_m, FourFloats z_level_m) const {
  const FourFloats column = along_m * static_cast<float>(1.0 / kColumn_m) + 0.5F * kColumns, none{};
  const FourFloats row = (z_level_m - static_cast<float>(z_min_level_m)) * static_cast<float>(per_m());
  const FourTruths inside =
      (column >= none) & (column < all_four(kColumns)) & (row >= none) & (row < all_four(static_cast<float>(count)));
  const FourInts cell =
      cut_off(inside ? row : none) * static_cast<std::int32_t>(kColumns) + cut_off(inside ? column : none);
  return inside ? cell : all_four_ints(-1);
}

void WallGrid::mark_points(const BoundedPoints& points, Rays rays, FourMarks* marks) {
  const FourInts one = all_four_ints(1), through = all_four_ints(static_cast<std::int32_t>(kCells));
  const FourInts in_none = through + through;
  FourFloats measured{}, passed{};
  for_each_four_about(points, marks->slab(), [&](std::uint32_t i, FourTruths counts) {
    if (!marks->look_at(load_four(&points.x[i]), load_four(&points.y[i]), load_four(&points.z[i]), counts)) return;
    const FourFloats weights = load_four(&points.weight[i]), none{};
    measured += marks->hits ? weights : none;
    const FourInts cell = rows_.cells_of(marks->along_m, marks->z_level_m);
    const FourTruths tells = (marks->hits | marks->passes) & (cell >= FourInts{});
    passed += marks->passes & tells ? weights : none;
    const FourInts counter = tells ? (marks->hits ? cell : cell + through) : in_none;
    const FourInts by = rays == Rays::kOneAPoint ? one : cut_off(tells ? weights : none);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      count_up(&counters_[static_cast<std::uint32_t>(counter[lane])], static_cast<std::uint32_t>(by[lane]));
    }
  });
  inliers_ += sum_of_lanes(measured);
  passed_ += sum_of_lanes(passed);
}

WallGrid::Rows WallGrid::rows_of(const WallScene& scene) {
  const double height_m = scene.z_max_level_m - scene.z_min_level_m;
  const double row_m = height_m / kRowsMax > kRow_m ? height_m / kRowsMax : kRow_m;
  return {static_cast<std::uint32_t>(std::ceil(height_m / row_m - 1e-9)), scene.z_min_level_m, row_m};
}

void WallGrid::mark(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, const Reach& reach) {
  counters_.fill(0);
  inliers_ = passed_ = 0.0;
  rows_ = rows_of(scene);
  FourMarks in_band(scene, wall, along_level, reach);
  mark_points(scene.band_level, Rays::kOneAPoint, &in_band);
  constexpr double kNothing_m = -1.0;  // negative: no point outside the band is on the wall
  FourMarks beyond(scene, wall, along_level, {kNothing_m, reach.behind_m});
  mark_points(scene.beyond_level, Rays::kByWeight, &beyond);
  for (std::uint32_t column = 0; column < kColumns; ++column) count_rows(column);
}

void WallGrid::count_rows(std::uint32_t column) {
  std::uint8_t solid_rows = 0, open_rows = 0;
  for (std::uint32_t row = 0; row < rows_.count; ++row) {
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
    if (solid_rows == 0) continue;  // no part of the plane here: an opening is no evidence against it
    out.solid_rows[column] = solid_rows_[column];
    solid_cells += solid_rows;
    own_open_cells += open_rows;
    if (solid_rows < open_rows) continue;
    const double along = wall_column_from_m(column);
    // A single column may be a stray or a stump.
    const bool goes_on = columns > 0 && !(out.along_max_m < along);
    const double away_m = larger(larger(along - kColumn_m, -along - kColumn_m), 0.0);
    if (goes_on && away_m < out.away_m) out.away_m = away_m;
    if (columns == 0) out.along_min_m = along;
    out.along_max_m = along + kColumn_m;
    ++columns;
  }
  out.inliers = static_cast<std::uint32_t>(inliers_);
  if (inliers_ > 0.0) out.stopped = inliers_ / (inliers_ + passed_);
  out.length_m = static_cast<double>(columns) * kColumn_m;
  out.area_m2 = static_cast<double>(solid_cells) * kColumn_m * rows_.height_m;
  if (solid_cells > 0) {
    out.seen_through = static_cast<double>(own_open_cells) / static_cast<double>(solid_cells + own_open_cells);
  }
  const double solidity = 1.0 - out.seen_through;
  out.score_m2 = out.area_m2 * solidity * solidity;
  return out;
}

bool WallGrid::is_solid_at(double along_m) const {
  const double place = along_m * (1.0 / kColumn_m) + 0.5 * kColumns;
  return place >= 0.0 && place < kColumns && column_is_solid(static_cast<std::uint32_t>(place));
}

FourTruths WallGrid::solid_at(FourFloats along_m, FourFloats z_level_m, FourTruths counts) const {
  const FourInts cells = rows_.cells_of(along_m, z_level_m);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    const auto cell = static_cast<std::uint32_t>(cells[lane]);
    if (cells[lane] < 0 || !solid(cell) || !column_is_solid(cell % kColumns)) counts[lane] = 0;
  }
  return counts;
}

void mark_wall(const WallScene& scene, const Plane& plane, const Eigen::Vector3d& along_level, MarkWidth width,
               WallGrid* grid) {
  const double thresh_m = scene.settings.wall_ransac_thresh;
  const WallGrid::Reach reach = width == MarkWidth::kThreshold
                                    ? WallGrid::Reach{thresh_m, on_wall_m(scene.settings)}
                                    : WallGrid::Reach{kFitGateInThresholds * thresh_m, kFitGateInThresholds * thresh_m};
  grid->mark(scene, plane, along_level, reach);
}

}  // namespace pose_wall

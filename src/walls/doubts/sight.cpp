// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/doubts/sight.hpp"

#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/simd/four_turns.hpp"
#include "walls/doubts/sight_columns.hpp"
#include "walls/sample/distances.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kColumns = DirectionGrid::kColumns;  // of the directions' grid
constexpr double kDimShare = 0.35;     // judgement, 2026-11-21: of the expected returns; a dimmer plane hides its gaps
constexpr double kWide_m = 0.7;        // judgement, 2026-11-21: wider gaps are roads and doors; 1 m at first
constexpr int kRoadsMax = 2;           // judgement, 2026-11-21: more gaps are a row of props
constexpr double kOneGapShare = 0.34;  // judgement, 2026-11-21: one gap of up to a third of the wall may be a road, too
constexpr double kBlindFactor = 1.5;   // judgement, 2026-11-21: few cells tell of silence elsewhere: half more passes
constexpr double kBlindTopsMax = 0.1;  // judgement, 2026-11-21: with more tops silent elsewhere, silence tells nothing
constexpr double kUnexplainedMax = 0.05;  // judgement, 2026-11-21: silence, twice what wall_silent allows

// Weights may go by intensity.
FourInts points_of(FourFloats weights) {
  const FourInts rounded = cut_off(weights + 0.5F), one = all_four_ints(1);
  return rounded > one ? rounded : one;
}

FourTurns to_lidar(const Extrinsic& extrinsic) {
  return FourTurns(extrinsic.R_base_lidar.transpose(), -(extrinsic.R_base_lidar.transpose() * extrinsic.sensor_base_m));
}

// Of those that count: what is read behind the last point may be anything.
FourInts cells_of(const FourTurns& to_lidar, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
  const FourPlaces ray = to_lidar(x, y, z);
  const FourFloats none{}, rx = counts ? ray.x : none, ry = counts ? ray.y : none, rz = counts ? ray.z : none;
  return DirectionGrid::cells_of(rx, ry, rz, rx * rx + ry * ry + rz * rz);
}

// Sorts what has passed through the plane by direction; returns how deep behind it most of that ends.
double mark_behind(const WallScene& scene, const Plane& wall, double behind_m, SightScratch* scratch) {
  const double inside_m = wall.signed_distance(scene.sensor_level_m);
  const Plane wall_base{scene.R_level_base.transpose() * wall.n, wall.d};
  const FourTurns turns = to_lidar(scene.extrinsic);
  Distances depths;
  scratch->behind_lidar.copy(scene.returns_lidar.too_far);
  for_each_in(scene.cloud_base, Slab(wall_base, kAnyDepth_m, -behind_m), [&](std::uint32_t i, float distance_m) {
    const double r = static_cast<double>(distance_m);
    const PointSet& cloud = scene.cloud_base;
    const FourInts cells =
        cells_of(turns, all_four(cloud.x[i]), all_four(cloud.y[i]), all_four(cloud.z[i]), first_of_four(kFour));
    scratch->behind_lidar.add(static_cast<std::uint32_t>(cells[0]),
                              static_cast<std::uint32_t>(points_of(all_four(cloud.weight[i]))[0]));
    const Eigen::Vector3d ray = scene.cloud_base.at(i) - scene.extrinsic.sensor_base_m;
    const double to_plane = way_to_plane(inside_m, r);
    const double z_level_m = scene.sensor_level_m.z() + to_plane * scene.R_level_base.row(2).dot(ray);
    const bool near = to_plane * to_plane * ray.squaredNorm() <= SightLines::kReach_m * SightLines::kReach_m;
    if (scene.in_band(z_level_m) && near) depths.add(-r);
  });
  return depths.at_share(Distances::kNearlyAll);
}

// The columns that look at the plane, side by side from one end to the other.
struct ColumnRow {
  SightColumn item[kColumns];
  std::uint32_t count = 0;

  // How much would be silent by chance is only told where anything is silent.
  ColumnRow(const SightColumns& columns, std::uint32_t away, double brightness) {
    if (look(columns, away, brightness, false)) look(columns, away, brightness, true);
  }

 private:
  // Whether anything is silent.
  bool look(const SightColumns& columns, std::uint32_t away, double brightness, bool with_chance) {
    double silent = 0.0;
    count = 0;
    for (std::uint32_t k = 0; k < kColumns; ++k) {
      const SightColumn c = columns.at((away + k) % kColumns, brightness, with_chance);
      if (c.tally.cells > 0.0) item[count++] = c;
      silent += c.tally.silent + c.tally.silent_tops;
    }
    return silent > 0.0;
  }
};

// Columns side by side that are gaps, or are none.
struct Run {
  bool is_gap = false;
  double wide_m = 0.0;
  SightTally tally;
  bool is_road() const { return is_gap && wide_m >= kWide_m && tally.through > 0.5 * tally.cells; }
};

template <typename Visit>
void for_each_run(const ColumnRow& row, Visit visit) {
  Run run;
  for (std::uint32_t k = 0; k < row.count; ++k) {
    if (k > 0 && row.item[k].is_gap() != run.is_gap) {
      visit(run);
      run = Run{};
    }
    run.is_gap = row.item[k].is_gap();
    run.tally.add(row.item[k].tally);
    if (k + 1 < row.count) run.wide_m += std::fabs(row.item[k + 1].along_m - row.item[k].along_m);
  }
  visit(run);
}

WallSight judge(const ColumnRow& row, const SightColumns& columns) {
  double solid_m = 0.0;
  int roads = 0;
  for_each_run(row, [&](const Run& run) {
    solid_m = !run.is_gap && run.wide_m > solid_m ? run.wide_m : solid_m;
    roads += run.is_road() ? 1 : 0;
  });
  const bool roads_are_roads = solid_m >= kWide_m && roads <= kRoadsMax;
  SightTally all, longest_gap;
  for_each_run(row, [&](const Run& run) {
    if (run.is_road() && roads_are_roads) return;
    all.add(run.tally);
    if (run.is_gap && run.tally.cells > longest_gap.cells) longest_gap = run.tally;
  });
  if (longest_gap.cells <= kOneGapShare * all.cells) all.add(longest_gap, -1.0);
  WallSight out;
  if (!(all.cells > 0.0)) return out;
  const double silent = all.silent / all.cells, by_chance = all.silent_by_chance / all.cells;
  SightColumns::Blindness blind;  // what else is silent excuses only what is
  if (silent > by_chance || all.silent_tops > 0.0) blind = columns.elsewhere();
  const double elsewhere = kBlindFactor * blind.cells;
  const double unexplained = silent - (by_chance > elsewhere ? by_chance : elsewhere);
  out.silent = unexplained > 0.0 ? unexplained : 0.0;
  out.open = out.silent + all.through / all.cells;
  const bool tops_tell = blind.tops <= kBlindTopsMax && all.silent_tops > 0.0;
  out.topless = ((tops_tell ? all.silent_tops : 0.0) + all.tops_through) / all.columns;
  out.dim = silent - by_chance > kUnexplainedMax && !(out.silent > 0.0);
  return out;
}

}  // namespace

void learn_directions(const WallScene& scene, SightScratch* scratch) {
  scratch->expected.look_at(scene.returns_lidar.all);
  scratch->seen.look_at(scene.returns_lidar.all, scratch->expected);
  scratch->kept_is_told = false;
}

void tell_kept(const WallScene& scene, SightScratch* scratch) {
  if (scratch->kept_is_told) return;
  scratch->kept_is_told = true;
  scratch->kept_lidar.clear();
  const FourTurns turns = to_lidar(scene.extrinsic);
  for_each_four_points(
      scene.cloud_base, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
        const FourInts cells = cells_of(turns, x, y, z, counts);
        const FourInts points = points_of(counts ? load_four(&scene.cloud_base.weight[i]) : FourFloats{}) & counts;
        for (std::uint32_t lane = 0; lane < kFour; ++lane) {
          scratch->kept_lidar.add(static_cast<std::uint32_t>(cells[lane]), static_cast<std::uint32_t>(points[lane]));
        }
      });
}

WallSight look_at(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double behind_m,
                  SightScratch* scratch) {
  if (!(wall.signed_distance(scene.sensor_level_m) > 0.0)) return {};
  const double depth_m = mark_behind(scene, wall, behind_m, scratch);
  const SightLines lines(scene, wall, along_level);
  const SightColumns columns(scene, scratch, lines);
  const double brightness = columns.brightness();
  WallSight out;
  if (brightness >= kDimShare) {
    out = judge(ColumnRow(columns, lines.column_away(), brightness), columns);
  } else {
    out.dim = brightness >= 0.0;
  }
  out.depth_m = depth_m;
  return out;
}

}  // namespace pose_wall

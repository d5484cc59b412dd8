// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/doubts/sight.hpp"

#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/math/elementary.hpp"
#include "base/simd/four_turns.hpp"
#include "engine/cloud/direction_grid.hpp"
#include "engine/walls/doubts/sight_lines.hpp"
#include "engine/walls/sample/distances.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kColumns = DirectionGrid::kColumns;  // of the directions' grid
// Of the expected returns; a dimmer plane hides its gaps; swept: half 2 won, twice nothing.
constexpr double kDimShare = 0.35;
constexpr double kWide_m = 0.7;  // wider gaps are roads and doors; 1 m at first; swept: half and twice change nothing
constexpr int kRoadsMax = 2;     // more gaps are a row of props; swept: half 1 lost, twice nothing
// One gap of up to a third of the wall may be a road, too; swept: half 1 won, twice nothing.
constexpr double kOneGapShare = 0.34;
// Few cells show the silence elsewhere: half more passes; with 1.0 pipes before dark walls cast no doubt
// (WallSight.PipesBeforeDarkWallsAllAroundAreNotPassedOver); swept: half and twice change nothing.
constexpr double kBlindFactor = 1.5;
// Silence, twice the limit of wall_silent; swept: half and twice change nothing.
constexpr double kUnexplainedMax = 0.05;
constexpr std::uint32_t kRows = DirectionGrid::kRows;  // of the directions' grid
constexpr double kExpectedMin = 3.0;                   // by Poisson: of three expected, none comes in 5 % by chance
constexpr double kSilentShare = 0.25;  // of the expected returns, without chance; swept: half 1 won, twice 1 won
// Not the level's risk, since a smaller one would make this test laxer. Beyond lie 2.9e-7: two tests of two walls at
// 10 Hz call a whole wall open once a day.
constexpr double kChanceInSigmas = 5.0;
constexpr double kThroughShare = 0.5;  // most of a cell's returns are from behind
// A column silent or seen through over more of it is a gap; swept: half 1 moved, twice 2 lost.
constexpr double kGapShare = 0.2;
constexpr double kBrightRank = 0.75;  // the upper quartile: half of a wall may be wet, or hidden
constexpr double kDeadShare = 0.1;    // of the expected returns; swept: half 2 moved, twice nothing
constexpr double kBrightShare = 0.7;  // of the expected returns; swept: half 1 moved, twice 2 moved
// Bright among half dead: things before a dark wall; swept: half 1 moved, twice nothing.
constexpr double kBrightCellsMin = 0.05;
constexpr std::uint32_t kCellsMin = 20;  // a rank among fewer has no meaning; swept: half and twice change nothing
constexpr double kZoneCellsMin = 60.0;   // a share of as many errs by 6 % at most; swept: half and twice change nothing

// Chance that fewer than `limit` come when `mean` are expected (Poisson).
double chance_below(double limit, double mean) {
  // With so many expected, only a quarter never comes by chance (below 1e-19), and exp would leave its range.
  constexpr double kMeanMax = 100.0;
  if (!(mean < kMeanMax)) return 0.0;
  double term = exponential(-mean), sum = 0.0;
  for (double k = 0.0; k < limit; k += 1.0) {
    sum += term;
    term *= mean / (k + 1.0);
  }
  return sum;
}

// Returns from a plane, one column of directions after the other.

// Numbers of cells.
struct SightTally {
  double cells = 0.0, silent = 0.0, silent_by_chance = 0.0, through = 0.0;
  double silent_variance = 0.0;  // of what chance makes silent

  // sign -1: subtracts it.
  void add(const SightTally& other, double sign = 1.0);
};

struct SightColumn {
  SightTally tally;
  double along_m = 0.0;  // along the road from the sensor
  bool is_gap() const;
};

class SightColumns {
 public:
  // directions: from learn_directions(), with the returns that passed through the plane. Kept points are counted on
  // demand.
  SightColumns(const WallScene& scene, SightScratch* directions, const SightLines& lines)
      : scene_(scene), directions_(*directions), lines_(lines) {}

  // Share of the expected returns where the plane is seen best, 0..1; negative if too little of it is in view. A wet
  // wall answers less than a dry one, but all over.
  double brightness() const;

  // No cells: the column does not look at the plane.
  SightColumn at(std::uint32_t column, double brightness, bool with_chance) const;

  // Silent share away from the plane. A sensor may be blind here and there, look further up ahead than aside, or spin
  // about another axis than expected. 1 if too little else is in view to know.
  double blindness_elsewhere() const;

 private:
  // Numbers of cells by zone (beside, above, below).
  struct SilenceElsewhere {
    double cells[SightLines::kAlong] = {}, silent[SightLines::kAlong] = {};
  };
  void count_elsewhere(std::uint32_t column, SilenceElsewhere* out) const;

  bool may_show(std::uint32_t column) const;
  bool can_tell(std::uint32_t row, std::uint32_t column) const;
  bool is_silent(std::uint32_t row, std::uint32_t column, double brightness) const;
  bool is_through(std::uint32_t row, std::uint32_t column) const;
  bool in_band(const SightLines::Crossing& crossing) const;

  const WallScene& scene_;
  SightScratch& directions_;
  const SightLines& lines_;
};

void SightTally::add(const SightTally& other, double sign) {
  cells += sign * other.cells;
  silent += sign * other.silent;
  silent_by_chance += sign * other.silent_by_chance;
  through += sign * other.through;
  silent_variance += sign * other.silent_variance;
}

bool SightColumn::is_gap() const {
  return tally.silent + tally.through > kGapShare * tally.cells;
}

bool SightColumns::may_show(std::uint32_t column) const {
  return directions_.seen.is_seen[column] && lines_.looks_towards(column);
}

bool SightColumns::can_tell(std::uint32_t row, std::uint32_t column) const {
  return directions_.expected.at(row, column) >= kExpectedMin;
}

bool SightColumns::is_silent(std::uint32_t row, std::uint32_t column, double brightness) const {
  return scene_.returns_lidar.all.count(row, column) < kSilentShare * brightness * directions_.expected.at(row, column);
}

bool SightColumns::is_through(std::uint32_t row, std::uint32_t column) const {
  if (directions_.behind_lidar.count(row, column) == 0) return false;
  tell_kept(scene_, &directions_);
  const std::uint32_t all = directions_.kept_lidar.count(row, column) + scene_.returns_lidar.too_far.count(row, column);
  return directions_.behind_lidar.count(row, column) > kThroughShare * all;
}

bool SightColumns::in_band(const SightLines::Crossing& crossing) const {
  return crossing.near && scene_.in_band(crossing.z_level_m);
}

double SightColumns::brightness() const {
  constexpr std::uint32_t kBins = 64;  // 64ths of the expected returns
  std::uint32_t bins[kBins] = {}, cells = 0;
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    if (!may_show(column)) continue;
    for (std::uint32_t row = 0; row < kRows; ++row) {
      if (!can_tell(row, column) || !in_band(lines_.at(row, column))) continue;
      const double share = scene_.returns_lidar.all.count(row, column) / directions_.expected.at(row, column);
      const auto bin = static_cast<std::uint32_t>(share * kBins);
      ++bins[bin < kBins ? bin : kBins - 1];
      ++cells;
    }
  }
  if (cells < kCellsMin) return -1.0;
  // A wet wall is dark all over. If a few cells are bright and most dead, bright things stand before a dark wall.
  std::uint32_t dead = 0, bright = 0;
  for (std::uint32_t bin = 0; bin < kBins; ++bin) {
    dead += bin < kDeadShare * kBins ? bins[bin] : 0;
    bright += bin >= kBrightShare * kBins ? bins[bin] : 0;
  }
  if (dead >= 0.5 * cells && bright >= kBrightCellsMin * cells) return 1.0;
  std::uint32_t below = 0, bin = 0;
  while (bin + 1 < kBins && below + bins[bin] <= kBrightRank * cells) below += bins[bin++];
  return (bin + 1.0) / kBins;
}

SightColumn SightColumns::at(std::uint32_t column, double brightness, bool with_chance) const {
  SightColumn out;
  if (!may_show(column)) return out;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    if (!can_tell(row, column)) continue;
    const SightLines::Crossing c = lines_.at(row, column);
    if (!in_band(c)) continue;
    const double mean = brightness * directions_.expected.at(row, column),
                 by_chance = with_chance ? chance_below(kSilentShare * mean, mean) : 0.0;
    const bool silent = is_silent(row, column, brightness), through = !silent && is_through(row, column);
    out.tally.cells += 1.0;
    out.tally.silent += silent ? 1.0 : 0.0;
    out.tally.silent_by_chance += by_chance;
    out.tally.silent_variance += by_chance * (1.0 - by_chance);
    out.tally.through += through ? 1.0 : 0.0;
    out.along_m += c.along_m;
  }
  if (out.tally.cells > 0.0) out.along_m /= out.tally.cells;
  return out;
}

void SightColumns::count_elsewhere(std::uint32_t column, SilenceElsewhere* out) const {
  const bool towards = lines_.looks_towards(column);
  for (std::uint32_t row = 0; row < kRows; ++row) {
    if (!can_tell(row, column)) continue;
    const SightLines::Zone zone = lines_.zone(row, column);
    if (zone == SightLines::kAlong || (towards && lines_.at(row, column).near)) continue;
    out->cells[zone] += 1.0;
    out->silent[zone] += is_silent(row, column, 1.0) ? 1.0 : 0.0;
  }
}

double SightColumns::blindness_elsewhere() const {
  SilenceElsewhere counted;
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    if (directions_.seen.is_seen[column]) count_elsewhere(column, &counted);
  }
  double out = 1.0;
  // The least of the three zones, since one of them may be dark too.
  for (int zone = 0; zone < SightLines::kAlong; ++zone) {
    const double share = counted.cells[zone] >= kZoneCellsMin ? counted.silent[zone] / counted.cells[zone] : 1.0;
    out = share < out ? share : out;
  }
  return out;
}

// Weights may depend on intensity.
FourInts points_of(FourFloats weights) {
  const FourInts rounded = cut_off(weights + 0.5F), one = all_four_ints(1);
  return rounded > one ? rounded : one;
}

FourTurns to_lidar(const Extrinsic& extrinsic) {
  return FourTurns(extrinsic.R_base_lidar.transpose(), -(extrinsic.R_base_lidar.transpose() * extrinsic.sensor_base_m));
}

// Only for lanes that count: values behind the last point may be anything.
FourInts cells_of(const FourTurns& to_lidar, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
  const FourPlaces ray = to_lidar(x, y, z);
  const FourFloats none{}, rx = counts ? ray.x : none, ry = counts ? ray.y : none, rz = counts ? ray.z : none;
  return Directions::cells_of(rx, ry, rz, rx * rx + ry * ry + rz * rz);
}

// Sorts the points that passed through the plane by direction. Returns the depth within which most of them end.
double mark_behind(const WallScene& scene, const Plane& wall, double behind_m, SightScratch* scratch) {
  const double inside_m = wall.signed_distance(scene.sensor_level_m);
  const Plane wall_base{scene.R_level_base.transpose() * wall.n, wall.d};
  const FourTurns turns = to_lidar(scene.extrinsic);
  const DirectionRows& rows = scene.returns_lidar.rows;
  Distances depths;
  scratch->behind_lidar.copy(scene.returns_lidar.too_far);
  for_each_in(scene.cloud_base, Slab(wall_base, kAnyDepth_m, -behind_m), [&](std::uint32_t i, float distance_m) {
    const double r = static_cast<double>(distance_m);
    const PointSet& cloud = scene.cloud_base;
    const FourInts cells =
        cells_of(turns, all_four(cloud.x[i]), all_four(cloud.y[i]), all_four(cloud.z[i]), first_of_four(kFour));
    scratch->behind_lidar.add(rows.cell_of(static_cast<std::uint32_t>(cells[0])),
                              static_cast<std::uint32_t>(points_of(all_four(cloud.weight[i]))[0]));
    const Eigen::Vector3d ray = scene.cloud_base.at(i) - scene.extrinsic.sensor_base_m;
    const double to_plane = way_to_plane(inside_m, r);
    const double z_level_m = scene.sensor_level_m.z() + to_plane * scene.R_level_base.row(2).dot(ray);
    const bool near = to_plane * to_plane * ray.squaredNorm() <= SightLines::kReach_m * SightLines::kReach_m;
    if (scene.in_band(z_level_m) && near) depths.add(-r);
  });
  return depths.at_share(Distances::kNearlyAll);
}

// The columns toward the plane, side by side from one end to the other.
struct ColumnRow {
  SightColumn item[kColumns];
  std::uint32_t count = 0;

  // Chance is only computed if anything is silent.
  ColumnRow(const SightColumns& columns, std::uint32_t away, double brightness) {
    if (look(columns, away, brightness, false)) look(columns, away, brightness, true);
  }

 private:
  // Returns true if anything is silent.
  bool look(const SightColumns& columns, std::uint32_t away, double brightness, bool with_chance) {
    double silent = 0.0;
    count = 0;
    for (std::uint32_t k = 0; k < kColumns; ++k) {
      const SightColumn c = columns.at((away + k) % kColumns, brightness, with_chance);
      if (c.tally.cells > 0.0) item[count++] = c;
      silent += c.tally.silent;
    }
    return silent > 0.0;
  }
};

// A run of columns side by side, all gaps or none.
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

// As many more cells as chance may make silent. Half of the walls have more than its mean.
double scatter_of_chance(double variance) {
  return variance > 0.0 ? kChanceInSigmas * std::sqrt(variance) : 0.0;
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
  const double silent = all.silent / all.cells;
  const double by_chance = (all.silent_by_chance + scatter_of_chance(all.silent_variance)) / all.cells;
  // Silence elsewhere excuses only silence.
  const double elsewhere = silent > by_chance ? kBlindFactor * columns.blindness_elsewhere() : 0.0;
  const double unexplained = silent - (by_chance > elsewhere ? by_chance : elsewhere);
  out.silent = unexplained > 0.0 ? unexplained : 0.0;
  out.open = out.silent + all.through / all.cells;
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
  const DirectionRows& rows = scene.returns_lidar.rows;
  for_each_four_points(
      scene.cloud_base, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
        const FourInts cells = cells_of(turns, x, y, z, counts);
        const FourInts points = points_of(counts ? load_four(&scene.cloud_base.weight[i]) : FourFloats{}) & counts;
        for (std::uint32_t lane = 0; lane < kFour; ++lane) {
          scratch->kept_lidar.add(rows.cell_of(static_cast<std::uint32_t>(cells[lane])),
                                  static_cast<std::uint32_t>(points[lane]));
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

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_sight.hpp"

#include <cmath>

#include "estimation/distances.hpp"
#include "math/elementary.hpp"
#include "stages/walls_sight_lines.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kRows = DirectionGrid::kRows;
constexpr std::uint32_t kColumns = DirectionGrid::kColumns;
// Above the wall band, up to here, only what is seen over the plane's top counts.
constexpr double kAboveBand_m = 1.0;
// Fewer expected returns do not tell silence from chance.
constexpr double kExpectedMin = 3.0;
// A cell is silent with fewer returns than this share of what is expected, seen through when more than this share of
// its returns comes from behind.
constexpr double kSilentShare = 0.25;
constexpr double kThroughShare = 0.5;
// Of what its directions expect, the plane answers this much, or it is dim.
constexpr double kDimShare = 0.35;
constexpr double kBrightRank = 0.75;
constexpr std::uint32_t kCellsMin = 20;
// So wide a sector without returns at any elevation is out of sight: blocked, or not looked at.
constexpr double kEmptyShare = 0.05;
constexpr std::uint32_t kBlockedColumns = 5;
// Columns that are silent or seen through over more than this are a gap.
constexpr double kGapShare = 0.2;
// Gaps this wide are roads and doors, if the wall itself has parts this wide.
constexpr double kWide_m = 1.0;
// And so may be one that is no wider than this share of the wall.
constexpr double kOneGapShare = 0.34;
constexpr double kDeepShare = 0.8;
// What is silent elsewhere too, by this much more, tells nothing.
constexpr double kBlindFactor = 1.5;
constexpr double kBlindTopsMax = 0.1;
constexpr double kZoneCellsMin = 60.0;
constexpr double kZoneColumnsMin = 10.0;

// What passed through the plane, by direction; returns how deep behind it most of that ends.
double mark_behind(const WallScene& scene, const Plane& wall, double behind_m, DirectionGrid* behind_lidar) {
  constexpr double kReach_m = 8.0;
  const double inside_m = wall.signed_distance(scene.sensor_level_m);
  const Eigen::Vector3d n_base = scene.R_level_base.transpose() * wall.n;
  const Eigen::Matrix3d R_lidar_base = scene.extrinsic.R_base_lidar.transpose();
  Distances depths;
  behind_lidar->clear();
  for (std::uint32_t i = 0; i < scene.cloud_base.count; ++i) {
    const Eigen::Vector3d p = scene.cloud_base.at(i);
    const double r = n_base.dot(p) + wall.d;
    if (!(r < -behind_m)) continue;
    const Eigen::Vector3d ray = p - scene.extrinsic.sensor_base_m;
    behind_lidar->add(R_lidar_base * ray, static_cast<std::uint32_t>(scene.cloud_base.weight[i] + 0.5F));
    const double to_plane = inside_m / (inside_m - r);
    const double z_level_m = scene.sensor_level_m.z() + to_plane * scene.R_level_base.row(2).dot(ray);
    const bool in_band = z_level_m >= scene.z_min_level_m && z_level_m <= scene.z_max_level_m;
    if (in_band && to_plane * to_plane * ray.squaredNorm() <= kReach_m * kReach_m) depths.add(-r);
  }
  return depths.at_share(kDeepShare);
}

// Chance that fewer than `limit` come where `mean` are expected (Poisson).
double chance_below(double limit, double mean) {
  double term = exponential(-mean), sum = 0.0;
  for (double k = 0.0; k < limit; k += 1.0) {
    sum += term;
    term *= mean / (k + 1.0);
  }
  return sum;
}

// Columns in which the sensor sees anything.
struct Seen {
  bool column[kColumns];

  Seen(const DirectionGrid& returns, const ExpectedReturns& expected) {
    bool empty[kColumns];
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      double count = 0.0, all = 0.0;
      for (std::uint32_t row = 0; row < kRows; ++row) {
        count += returns.count(row, c);
        all += expected.at(row, c);
      }
      empty[c] = !(count > kEmptyShare * all);
    }
    for (std::uint32_t c = 0; c < kColumns; ++c) column[c] = !empty[c] || sector(empty, c) < kBlockedColumns;
  }

 private:
  // Columns of the empty sector around this one.
  static std::uint32_t sector(const bool (&empty)[kColumns], std::uint32_t c) {
    std::uint32_t before = 0, after = 0;
    while (before < kColumns && empty[(c + kColumns - before) % kColumns]) ++before;
    while (after < kColumns && empty[(c + after) % kColumns]) ++after;
    return before + after - 1;
  }
};

// Numbers of cells, and of columns.
struct Tally {
  double cells = 0.0, silent = 0.0, silent_by_chance = 0.0, through = 0.0;
  double columns = 0.0, silent_tops = 0.0, tops_through = 0.0;
  void add(const Tally& other, double sign = 1.0) {
    cells += sign * other.cells;
    silent += sign * other.silent;
    silent_by_chance += sign * other.silent_by_chance;
    through += sign * other.through;
    columns += sign * other.columns;
    silent_tops += sign * other.silent_tops;
    tops_through += sign * other.tops_through;
  }
};

struct ColumnSight {
  Tally tally;
  double along_m = 0.0;
  bool is_gap() const { return tally.silent + tally.through > kGapShare * tally.cells; }
};

struct Look {
  const WallScene& scene;
  const DirectionGrid& behind;
  const ExpectedReturns& expected;
  const SightLines& lines;

  bool in_band(const SightLines::Crossing& c) const {
    return c.near && c.z_level_m >= scene.z_min_level_m && c.z_level_m <= scene.z_max_level_m;
  }

  // How much of the expected comes back where the plane is seen best, 0..1; negative where too little of it is looked
  // at. A wet wall answers less than a dry one, but all over.
  double brightness(const Seen& seen) const {
    constexpr std::uint32_t kBins = 64;
    std::uint32_t bins[kBins] = {}, cells = 0;
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      for (std::uint32_t row = 0; row < kRows && seen.column[column]; ++row) {
        const double mean = expected.at(row, column);
        if (!(mean >= kExpectedMin) || !in_band(lines.at(row, column))) continue;
        const auto bin = static_cast<std::uint32_t>(scene.returns_lidar.count(row, column) / mean * kBins);
        ++bins[bin < kBins ? bin : kBins - 1];
        ++cells;
      }
    }
    if (cells < kCellsMin) return -1.0;
    std::uint32_t below = 0, bin = 0;
    while (bin + 1 < kBins && below + bins[bin] <= kBrightRank * cells) below += bins[bin++];
    return (bin + 1.0) / kBins;
  }

  ColumnSight column(std::uint32_t column, double brightness) const {
    ColumnSight out;
    double top_level_m = -1e3;
    for (std::uint32_t row = 0; row < kRows; ++row) {
      const double mean = brightness * expected.at(row, column), count = scene.returns_lidar.count(row, column);
      if (!(mean >= brightness * kExpectedMin)) continue;
      const SightLines::Crossing c = lines.at(row, column);
      if (!c.near || c.z_level_m < scene.z_min_level_m || c.z_level_m > scene.z_max_level_m + kAboveBand_m) continue;
      const bool silent = count < kSilentShare * mean;
      const bool through = !silent && behind.count(row, column) > kThroughShare * count;
      if (c.z_level_m > top_level_m) {
        top_level_m = c.z_level_m;
        out.tally.silent_tops = silent ? 1.0 : 0.0;
        out.tally.tops_through = through ? 1.0 : 0.0;
      }
      if (!in_band(c)) continue;
      out.tally.add(
          {1.0, silent ? 1.0 : 0.0, chance_below(kSilentShare * mean, mean), through ? 1.0 : 0.0, 0.0, 0.0, 0.0});
      out.along_m += c.along_m;
    }
    if (out.tally.cells > 0.0) out.along_m /= out.tally.cells;
    out.tally.columns = 1.0;
    return out;
  }
};

// What is silent where the plane is not: a sensor may be blind here and there, look further up ahead than aside, or
// spin about another axis than the expectation supposes.
struct Blindness {
  double cells = 1.0;  // share of them
  double tops = 1.0;   // of columns: the highest cell

  Blindness(const Look& look, const Seen& seen) {
    double all[3] = {}, silent[3] = {}, columns = 0.0, silent_tops = 0.0;
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      bool aside = false, top_is_silent = false;
      for (std::uint32_t row = 0; row < kRows && seen.column[column]; ++row) {
        const double mean = look.expected.at(row, column);
        const SightLines::Elsewhere where = look.lines.elsewhere(row, column);
        if (!(mean >= kExpectedMin) || where == SightLines::Elsewhere::kAlong || look.lines.at(row, column).near)
          continue;
        const bool is_silent = look.scene.returns_lidar.count(row, column) < kSilentShare * mean;
        const int zone = where == SightLines::Elsewhere::kSide ? 0 : (where == SightLines::Elsewhere::kUp ? 1 : 2);
        all[zone] += 1.0;
        silent[zone] += is_silent ? 1.0 : 0.0;
        aside = true;
        top_is_silent = is_silent;  // rows go up
      }
      columns += aside ? 1.0 : 0.0;
      silent_tops += aside && top_is_silent ? 1.0 : 0.0;
    }
    // The least of what is beside, above and below: one of them may be dark too.
    for (int zone = 0; zone < 3; ++zone) {
      const double share = all[zone] >= kZoneCellsMin ? silent[zone] / all[zone] : 1.0;
      cells = share < cells ? share : cells;
    }
    if (columns >= kZoneColumnsMin) tops = silent_tops / columns;
  }
};

// The columns that look at the plane, side by side from one end to the other.
struct ColumnRow {
  ColumnSight item[kColumns];
  std::uint32_t count = 0;

  ColumnRow(const Look& look, const Seen& seen, double brightness) {
    ColumnSight all[kColumns];
    std::uint32_t first = 0;  // one that does not look at it: less than half of them do
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      if (seen.column[c]) all[c] = look.column(c, brightness);
      if (!(all[c].tally.cells > 0.0)) first = c;
    }
    for (std::uint32_t k = 0; k < kColumns; ++k) {
      const ColumnSight& c = all[(first + k) % kColumns];
      if (c.tally.cells > 0.0) item[count++] = c;
    }
  }
};

struct Run {
  bool is_gap = false;
  double wide_m = 0.0;
  Tally tally;
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

WallSight judge(const ColumnRow& row, const Blindness& blind) {
  double solid_m = 0.0;
  for_each_run(row, [&](const Run& run) { solid_m = !run.is_gap && run.wide_m > solid_m ? run.wide_m : solid_m; });
  Tally all, longest_gap;
  for_each_run(row, [&](const Run& run) {
    if (run.is_road() && solid_m >= kWide_m) return;
    all.add(run.tally);
    if (run.is_gap && run.tally.cells > longest_gap.cells) longest_gap = run.tally;
  });
  if (longest_gap.cells <= kOneGapShare * all.cells) all.add(longest_gap, -1.0);
  WallSight out;
  if (!(all.cells > 0.0)) return out;
  const double by_chance = all.silent_by_chance / all.cells, elsewhere = kBlindFactor * blind.cells;
  const double silent = all.silent / all.cells - (by_chance > elsewhere ? by_chance : elsewhere);
  out.silent = silent > 0.0 ? silent : 0.0;
  out.open = out.silent + all.through / all.cells;
  out.topless = ((blind.tops <= kBlindTopsMax ? all.silent_tops : 0.0) + all.tops_through) / all.columns;
  return out;
}

}  // namespace

WallSight look_at(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double behind_m,
                  DirectionGrid* behind_lidar) {
  if (!(wall.signed_distance(scene.sensor_level_m) > 0.0)) return {};
  const double depth_m = mark_behind(scene, wall, behind_m, behind_lidar);
  const ExpectedReturns expected(scene.returns_lidar);
  const SightLines lines(scene, wall, along_level);
  const Seen seen(scene.returns_lidar, expected);
  const Look look{scene, *behind_lidar, expected, lines};
  const double brightness = look.brightness(seen);
  WallSight out;
  if (brightness >= kDimShare) out = judge(ColumnRow(look, seen, brightness), Blindness(look, seen));
  out.dim = brightness >= 0.0 && brightness < kDimShare;
  out.depth_m = depth_m;
  return out;
}

}  // namespace pose_wall

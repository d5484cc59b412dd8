// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/doubts/sight_columns.hpp"

#include "base/math/elementary.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kRows = DirectionGrid::kRows;        // of the directions' grid
constexpr std::uint32_t kColumns = DirectionGrid::kColumns;  // of the directions' grid
constexpr double kExpectedMin = 3.0;   // by Poisson, where three are expected none comes in 5 % by chance
constexpr double kSilentShare = 0.25;  // judgement, 2026-11-21: of the expected returns, less what chance takes
constexpr double kThroughShare = 0.5;  // most of a cell's returns come from behind
constexpr double kGapShare = 0.2;     // judgement, 2026-11-21: a column silent or seen through over more of it is a gap
constexpr double kBrightRank = 0.75;  // the upper quartile: half of a wall may be wet, or hidden
constexpr double kDeadShare = 0.1;    // judgement, 2026-11-21: of the expected returns
constexpr double kBrightShare = 0.7;  // judgement, 2026-11-21: of the expected returns
constexpr double kBrightCellsMin = 0.05;  // judgement, 2026-11-21: bright among half dead: things before a dark wall
constexpr std::uint32_t kCellsMin = 20;   // judgement, 2026-11-21: a rank among fewer means nothing
constexpr double kZoneCellsMin = 60.0;    // judgement, 2026-11-21: a share of as many errs by 6 % at most
constexpr double kZoneColumnsMin = 10.0;  // judgement, 2026-11-21: a tenth of the tops (kBlindTopsMax) takes ten

// Chance that fewer than `limit` come where `mean` are expected (Poisson).
double chance_below(double limit, double mean) {
  // Where so many are expected, a quarter of them never comes by chance (below 1e-19), and exp would leave its range.
  constexpr double kMeanMax = 100.0;
  if (!(mean < kMeanMax)) return 0.0;
  double term = exponential(-mean), sum = 0.0;
  for (double k = 0.0; k < limit; k += 1.0) {
    sum += term;
    term *= mean / (k + 1.0);
  }
  return sum;
}

}  // namespace

void SightTally::add(const SightTally& other, double sign) {
  cells += sign * other.cells;
  silent += sign * other.silent;
  silent_by_chance += sign * other.silent_by_chance;
  through += sign * other.through;
  columns += sign * other.columns;
  silent_tops += sign * other.silent_tops;
  tops_through += sign * other.tops_through;
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
  // A wet wall is dark all over; where a little is bright and most of it dead, bright things stand before a dark wall.
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
  constexpr double kLowest_m = -1e3;  // below every height
  SightColumn out;
  if (!may_show(column)) return out;
  double top_level_m = kLowest_m;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    if (!can_tell(row, column)) continue;
    const SightLines::Crossing c = lines_.at(row, column);
    if (!c.near || c.z_level_m < scene_.z_min_level_m || c.z_level_m > scene_.z_max_level_m + kAboveBand_m) continue;
    const double mean = brightness * directions_.expected.at(row, column),
                 by_chance = with_chance ? chance_below(kSilentShare * mean, mean) : 0.0;
    const bool silent = is_silent(row, column, brightness), through = !silent && is_through(row, column);
    if (c.z_level_m > top_level_m) {
      top_level_m = c.z_level_m;
      out.tally.silent_tops = (silent ? 1.0 : 0.0) - by_chance;
      out.tally.tops_through = through ? 1.0 : 0.0;
    }
    if (!in_band(c)) continue;
    out.tally.cells += 1.0;
    out.tally.silent += silent ? 1.0 : 0.0;
    out.tally.silent_by_chance += by_chance;
    out.tally.through += through ? 1.0 : 0.0;
    out.along_m += c.along_m;
  }
  if (out.tally.cells > 0.0) out.along_m /= out.tally.cells;
  out.tally.columns = 1.0;
  return out;
}

void SightColumns::count_elsewhere(std::uint32_t column, SilenceElsewhere* out) const {
  double top_up = -1.0;
  bool any = false, top_is_silent = false;
  const bool towards = lines_.looks_towards(column);
  for (std::uint32_t row = 0; row < kRows; ++row) {
    if (!can_tell(row, column)) continue;
    const SightLines::Zone zone = lines_.zone(row, column);
    if (zone == SightLines::kAlong || (towards && lines_.at(row, column).near)) continue;
    const bool silent_here = is_silent(row, column, 1.0);
    if (!any || lines_.up(row, column) > top_up) {
      top_up = lines_.up(row, column);
      top_is_silent = silent_here;
    }
    any = true;
    out->cells[zone] += 1.0;
    out->silent[zone] += silent_here ? 1.0 : 0.0;
  }
  out->columns += any ? 1.0 : 0.0;
  out->silent_tops += any && top_is_silent ? 1.0 : 0.0;
}

SightColumns::Blindness SightColumns::elsewhere() const {
  SilenceElsewhere counted;
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    if (directions_.seen.is_seen[column]) count_elsewhere(column, &counted);
  }
  Blindness out;
  // The least of the three: one of them may be dark too.
  for (int zone = 0; zone < SightLines::kAlong; ++zone) {
    const double share = counted.cells[zone] >= kZoneCellsMin ? counted.silent[zone] / counted.cells[zone] : 1.0;
    out.cells = share < out.cells ? share : out.cells;
  }
  if (counted.columns >= kZoneColumnsMin) out.tops = counted.silent_tops / counted.columns;
  return out;
}

}  // namespace pose_wall

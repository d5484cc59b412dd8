// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/containers/heap_sort.hpp"
#include "base/math/golden_ratio.hpp"
#include "planar/gates.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kFarthest_m = 24.0;  // of the points that search: inside a block's margin
constexpr double kSteps = 2500.0;     // of work that a seed takes at most
// Places so near are one: a coarse step of yaw, and what it moves points 4 m away by. With half and with twice of each
// the sweep's restarts were the same.
constexpr double kSame_m = 0.15, kSame_rad = 0.04;
constexpr double kPeakApart_rad = 0.15;  // some steps of yaw: nearer directions end in one fit

}  // namespace

void PlaceSearch::lay_out(Arena& arena) {
  window_ = arena.take<std::uint8_t>(static_cast<std::uint32_t>(kWide * kWide));
  chunks_ = arena.take<Chunk>(static_cast<std::uint32_t>(kOwn * kBlockTiles));
  peaks_ = arena.take<Peak>(static_cast<std::uint32_t>(kOwn * kOwn) * kPeaks);
  seeds_ = arena.take<Seed>(kSeedsMost);
  bins_ = arena.take<std::uint32_t>(kBins);
  hypotheses_ = arena.take<Hypothesis>(kHypothesesMost);
}

void PlaceSearch::open() {
  stage_ = Stage::kIdle;
  hypothesis_count_ = seed_count_ = 0;
  is_whole_ = false;
}

// One point of each patch, then a second one, and so on: near walls would have all of them otherwise.
void PlaceSearch::choose_points(const Surroundings& around) {
  std::uint32_t taken[kPatchesMost];
  chosen_count_ = 0;
  double farthest2_m2 = 1.0;
  constexpr std::uint32_t kPerPatch = 4;  // points of a patch at most: 64 points then come from 16 patches
  for (std::uint32_t round = 0; round < kPerPatch && chosen_count_ < kPointsMost; ++round) {
    for (std::uint32_t at = 0; at < around.patches; ++at) taken[at] = 0;
    for (std::uint32_t k = 0; k < around.points.size() && chosen_count_ < kPointsMost; ++k) {
      const std::uint32_t at = around.patch[k];
      if (at == kPatchesMost) continue;
      // The middle one of the patch's share of this round.
      const std::uint32_t wanted = around.in_patch[at] * (2 * round + 1) / (2 * kPerPatch);
      if (taken[at]++ != wanted || (round > 0 && around.in_patch[at] <= round)) continue;
      const double range2_m2 = as_double(around.points[k]).squaredNorm();
      if (!(range2_m2 < kFarthest_m * kFarthest_m)) continue;
      chosen_[chosen_count_++] = around.points[k];
      farthest2_m2 = std::max(farthest2_m2, range2_m2);
    }
  }
  constexpr double kStepMost_rad = 0.04;  // a coarse cell at 10 m; farther points make it finer
  const double step_rad = std::min(kStepMost_rad, kSight_m / std::sqrt(farthest2_m2));
  yaws_ = static_cast<std::uint32_t>(2.0 * kPi / step_rad) + 1;
  yaw_step_rad_ = 2.0 * kPi / yaws_;
}

void PlaceSearch::begin(const PlaceMap& map, const Surroundings& around) {
  choose_points(around);
  seed_count_ = hypothesis_count_ = 0;
  is_whole_ = true;
  least_ = static_cast<std::uint32_t>(limit_of<gate::SEED>() * PlaceMap::kLikely * chosen_count_) + 1;
  yaw_ = seed_ = 0;
  bins_.fill(0);
  blocks_done_ = blocks_all_ = 0;
  block_ = -1;
  while (next_block(map)) ++blocks_all_;
  block_ = -1;
  constexpr std::uint32_t kPointsLeast = 12;  // fewer fit anywhere in a road
  if (chosen_count_ < kPointsLeast || !next_block(map)) {
    is_whole_ = false;
    stage_ = Stage::kEnded;
    return;
  }
  stage_ = Stage::kCoarse;
  draw_block(map);
}

double PlaceSearch::progress() const {
  if (stage_ == Stage::kEnded) return 1.0;
  if (stage_ == Stage::kIdle || blocks_all_ == 0) return 0.0;
  const double coarse = (blocks_done_ + static_cast<double>(yaw_) / yaws_) / blocks_all_;
  const double fine = seed_count_ > 0 ? static_cast<double>(seed_) / seed_count_ : 0.0;
  return stage_ == Stage::kCoarse ? 0.5 * coarse : 0.5 + 0.5 * fine;
}

bool PlaceSearch::next_block(const PlaceMap& map) {
  while (++block_ < kBlocks * kBlocks) {
    const std::int32_t x = block_ % kBlocks * kBlockTiles, y = block_ / kBlocks * kBlockTiles;
    for (std::int32_t k = 0; k < kBlockTiles * kBlockTiles; ++k) {
      if (map.has_tile(x + k % kBlockTiles, y + k / kBlockTiles)) return true;
    }
  }
  return false;
}

void PlaceSearch::draw_block(const PlaceMap& map) {
  // The margin in whole tiles, and cells along a tile: the window is copied tile by tile.
  constexpr std::int32_t kMarginTiles = kMargin / PlaceMap::kTileCoarse, kCells = PlaceMap::kTileCoarse;
  const std::int32_t x = block_ % kBlocks * kBlockTiles, y = block_ / kBlocks * kBlockTiles;
  for (std::int32_t row = 0; row < kWide; ++row) {
    for (std::int32_t tile = 0; tile < kWide / kCells; ++tile) {
      const std::uint8_t* const from =
          map.likelihood_row(x - kMarginTiles + tile, y - kMarginTiles + row / kCells, row % kCells);
      std::uint8_t* const to = &window_[static_cast<std::uint32_t>(row * kWide + tile * kCells)];
      if (from != nullptr) {
        std::memcpy(to, from, kCells);
      } else {
        std::memset(to, 0, kCells);
      }
    }
  }
  chunk_count_ = 0;
  for (std::int32_t row = 0; row < kOwn; ++row) {
    for (std::int32_t tile = 0; tile < kBlockTiles; ++tile) {
      const std::uint32_t standable = map.standable_row(x + tile, y + row / kCells, row % kCells);
      if (standable == 0) continue;
      const auto column = static_cast<std::int16_t>(tile * kCells);
      chunks_[chunk_count_++] = {column, static_cast<std::int16_t>(row), standable};
    }
  }
  peaks_.fill(Peak{0, 0});
  yaw_ = 0;
}

// Where the points lie in the window, from the own cell (0, 0) with base in its middle.
void PlaceSearch::turn() {
  const Turn2 turn(yaw_of(yaw_));
  for (std::uint32_t k = 0; k < chosen_count_; ++k) {
    const Eigen::Vector2d p = turn * as_double(chosen_[k]);
    const auto column = static_cast<std::int32_t>(std::floor(p.x() / kSight_m + 0.5));
    const auto row = static_cast<std::int32_t>(std::floor(p.y() / kSight_m + 0.5));
    offset_[k] = (row + kMargin) * kWide + column + kMargin;
  }
}

void PlaceSearch::score(const Chunk& chunk) {
  const std::uint8_t* const corner = window_.data() + chunk.y * kWide + chunk.x;
  std::uint8_t sum[kLanes] = {};
  for (std::uint32_t k = 0; k < chosen_count_; ++k) {
    std::uint8_t row[kLanes];
    std::memcpy(row, corner + offset_[k], kLanes);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      sum[lane] = static_cast<std::uint8_t>(sum[lane] + row[lane]);
    }
  }
  std::uint8_t most = 0;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) most = sum[lane] > most ? sum[lane] : most;
  if (most < least_) return;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    if (sum[lane] < least_ || (chunk.standable >> lane & 1U) == 0) continue;
    note(static_cast<std::uint32_t>(chunk.y * kOwn + chunk.x) + lane, sum[lane]);
  }
}

// A cell remembers its best directions that are apart from each other.
void PlaceSearch::note(std::uint32_t cell, std::uint32_t score) {
  Peak* const peaks = &peaks_[cell * kPeaks];
  const auto apart = static_cast<std::uint32_t>(kPeakApart_rad / yaw_step_rad_);
  std::uint32_t at = 0, worst = 0;
  for (; at < kPeaks && peaks[at].score > 0; ++at) {
    const std::uint32_t off = yaw_ - peaks[at].yaw;  // yaws come in order
    if (off <= apart || yaws_ - off <= apart) {
      if (score > peaks[at].score) peaks[at] = {static_cast<std::uint16_t>(yaw_), static_cast<std::uint16_t>(score)};
      return;
    }
    if (peaks[at].score < peaks[worst].score) worst = at;
  }
  if (at == kPeaks) {
    if (score <= peaks[worst].score) return;
    at = worst;
  }
  peaks[at] = {static_cast<std::uint16_t>(yaw_), static_cast<std::uint16_t>(score)};
}

// Beside a better cell a seed would end in the same place. Along a road cells are alike, and all of them stay.
bool PlaceSearch::is_peak(std::int32_t cell, const Peak& peak) const {
  constexpr double kMuchBetter = 0.05;  // of the most likely
  const std::uint32_t enough = peak.score + static_cast<std::uint32_t>(kMuchBetter * PlaceMap::kLikely * chosen_count_);
  const auto apart = static_cast<std::uint32_t>(kPeakApart_rad / yaw_step_rad_);
  const std::int32_t x = cell % kOwn, y = cell / kOwn;
  for (std::int32_t v = std::max(0, y - 1); v <= std::min(kOwn - 1, y + 1); ++v) {
    for (std::int32_t u = std::max(0, x - 1); u <= std::min(kOwn - 1, x + 1); ++u) {
      const Peak* const others = &peaks_[static_cast<std::uint32_t>(v * kOwn + u) * kPeaks];
      for (std::uint32_t k = 0; k < kPeaks; ++k) {
        if (others[k].score <= enough) continue;
        const std::uint32_t off = others[k].yaw > peak.yaw ? static_cast<std::uint32_t>(others[k].yaw - peak.yaw)
                                                           : static_cast<std::uint32_t>(peak.yaw - others[k].yaw);
        if (off <= apart || yaws_ - off <= apart) return false;
      }
    }
  }
  return true;
}

void PlaceSearch::harvest() {
  const std::int32_t x = block_ % kBlocks * kOwn, y = block_ / kBlocks * kOwn;
  for (std::uint32_t cell = 0; cell < static_cast<std::uint32_t>(kOwn * kOwn); ++cell) {
    for (std::uint32_t k = 0; k < kPeaks; ++k) {
      const Peak& peak = peaks_[cell * kPeaks + k];
      const auto own = static_cast<std::int32_t>(cell);
      if (peak.score < least_ || !is_peak(own, peak)) continue;
      plant(
          {static_cast<std::int16_t>(x + own % kOwn), static_cast<std::int16_t>(y + own / kOwn), peak.yaw, peak.score});
    }
  }
}

// Where room runs out, the least likely seeds go.
void PlaceSearch::plant(const Seed& seed) {
  while (seed_count_ == kSeedsMost && seed.score >= least_) {
    is_whole_ = false;
    ++least_;
    std::uint32_t kept = 0;
    for (std::uint32_t k = 0; k < seed_count_; ++k) {
      if (seeds_[k].score >= least_) seeds_[kept++] = seeds_[k];
    }
    seed_count_ = kept;
  }
  if (seed.score >= least_) seeds_[seed_count_++] = seed;
}

// Seeds end in the same places: each is looked at once.
bool PlaceSearch::is_new(const Pose2& pose) {
  const auto x = static_cast<std::int64_t>(std::floor(pose.x_m / kSame_m));
  const auto y = static_cast<std::int64_t>(std::floor(pose.y_m / kSame_m));
  const auto yaw = static_cast<std::int64_t>(std::floor((wrapped(pose.yaw_rad) + kPi) / kSame_rad));
  constexpr std::int64_t kHalf = 1 << 20;  // bins to each side: 157 km, so that the key is positive
  const std::uint64_t key = (static_cast<std::uint64_t>(x + kHalf) << 40U) ^
                            (static_cast<std::uint64_t>(y + kHalf) << 16U) ^ static_cast<std::uint64_t>(yaw);
  const std::uint64_t mixed = key * kGoldenTurn64;
  const auto tag = static_cast<std::uint32_t>(mixed | 1U);
  auto at = static_cast<std::uint32_t>(mixed >> 48U) % kBins;
  constexpr std::uint32_t kTries = 64;  // a bound: beyond it a seed is fitted twice, at worst
  for (std::uint32_t k = 0; k < kTries; ++k, at = (at + 1) % kBins) {
    if (bins_[at] == tag) return false;
    if (bins_[at] != 0) continue;
    bins_[at] = tag;
    return true;
  }
  return true;
}

void PlaceSearch::keep(const Hypothesis& hypothesis) {
  std::uint32_t worst = 0;
  for (std::uint32_t k = 0; k < hypothesis_count_; ++k) {
    Hypothesis& other = hypotheses_[k];
    if ((other.pose.place() - hypothesis.pose.place()).squaredNorm() < kSame_m * kSame_m &&
        std::abs(wrapped(other.pose.yaw_rad - hypothesis.pose.yaw_rad)) < kSame_rad) {
      if (hypothesis.verdict.cost < other.verdict.cost) other = hypothesis;
      return;
    }
    if (other.verdict.cost > hypotheses_[worst].verdict.cost) worst = k;
  }
  if (hypothesis_count_ < kHypothesesMost) {
    hypotheses_[hypothesis_count_++] = hypothesis;
  } else if (hypothesis.verdict.cost < hypotheses_[worst].verdict.cost) {
    hypotheses_[worst] = hypothesis;
  }
}

void PlaceSearch::refine(const PlaceMap& map, const Surroundings& around, const Seed& seed) {
  // A cheap look before each dearer one: residuals of half a coarse cell, then of a cell of the map; as many points as
  // searched, then more. With half and with twice of each the sweep had 105 or 106 restarts unique, and 106 as it is:
  constexpr double kWide_m = 0.25, kNarrow_m = 0.08;
  constexpr std::uint32_t kRounds = 4;
  constexpr std::uint32_t kFewPoints = 64, kSomePoints = 128, kMorePoints = 320;

  // Coarse cells from the corner of the square to its middle.
  constexpr std::int32_t kMiddle = PlaceMap::kAcross * PlaceMap::kTileCoarse / 2;
  const Pose2 seeded{(seed.x - kMiddle + 0.5) * kSight_m + map.middle_m().x(),
                     (seed.y - kMiddle + 0.5) * kSight_m + map.middle_m().y(), yaw_of(seed.yaw)};
  const auto fit_from = [&](const Pose2& start, double sigma_m, std::uint32_t few) {
    return fit_pose(map, around.points, start, {sigma_m, {}, std::max(1U, around.points.size() / few), kRounds});
  };
  const Fit wide = fit_from(seeded, kWide_m, kFewPoints);
  if (!is_new(wide.pose)) return;
  const Fit narrow = fit_from(wide.pose, kNarrow_m, kSomePoints);
  if (!passes<gate::HOPEFUL>(narrow.explained)) return;
  const Fit first = fit_from(narrow.pose, around.sigma_m, kSomePoints);
  if (!passes<gate::HYPOTHESIS>(first.explained)) return;
  const Fit fine = fit_from(first.pose, around.sigma_m, kMorePoints);
  Hypothesis hypothesis;
  hypothesis.pose = fine.pose;
  hypothesis.verdict = judge_patches(map, around, fine.pose, &hypothesis.costs);
  keep(hypothesis);
}

// The best first, each fitted once more with all points.
void PlaceSearch::sort_out(const PlaceMap& map, const Surroundings& around) {
  const auto better = [](const Hypothesis& a, const Hypothesis& b) { return a.verdict.cost < b.verdict.cost; };
  heap_sort(hypotheses_.begin(), hypotheses_.begin() + hypothesis_count_, better);
  constexpr std::uint32_t kBest = 32;  // as many as kCandidatesMost of verdict.hpp
  for (std::uint32_t k = 0; k < std::min(kBest, hypothesis_count_); ++k) {
    Hypothesis& own = hypotheses_[k];
    const Fit fit = fit_pose(map, around.points, own.pose, {around.sigma_m});
    own.pose = fit.pose;
    own.explained = fit.explained;
    own.seen = fit.seen;
    own.rms_m = fit.rms_m;
    own.verdict = judge_patches(map, around, fit.pose, &own.costs);
  }
  heap_sort(hypotheses_.begin(), hypotheses_.begin() + std::min(kBest, hypothesis_count_), better);
}

bool PlaceSearch::go_on(const PlaceMap& map, const Surroundings& around, std::uint64_t steps) {
  std::uint64_t done = 0;
  while (stage_ == Stage::kCoarse && done < steps) {
    turn();
    for (std::uint32_t k = 0; k < chunk_count_; ++k) score(chunks_[k]);
    constexpr std::uint64_t kYaw = 64;  // steps that a yaw costs by itself
    done += chunk_count_ + kYaw;
    if (++yaw_ < yaws_) continue;
    harvest();
    ++blocks_done_;
    if (next_block(map)) {
      draw_block(map);
    } else {
      stage_ = Stage::kFine;
    }
  }
  while (stage_ == Stage::kFine && done < steps) {
    if (seed_ == seed_count_) {
      sort_out(map, around);
      stage_ = Stage::kEnded;
      break;
    }
    refine(map, around, seeds_[seed_++]);
    done += static_cast<std::uint64_t>(kSteps) / 5;
  }
  return stage_ == Stage::kEnded;
}

}  // namespace pose_wall::planar

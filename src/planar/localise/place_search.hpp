// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Every place of the map where the machine may stand, in every direction: which of them does what was seen not exclude?
// The work is cut into shares, so that a call takes bounded time.
//
// First a correlative search (Olson, ICRA 2009) over coarse cells and all yaws: 64 points against a field of
// likelihood, 16 places at once. What scores well is a seed. Seeds become hypotheses: Gauss and Newton with wide, then
// with narrow residuals, and a cost for each patch.

#pragma once

#include <cstdint>

#include "planar/localise/surroundings.hpp"

namespace pose_wall::planar {

struct Hypothesis {
  Pose2 pose;  // of base in the map when it was seen
  PatchCosts costs;
  PatchVerdict verdict;
  double explained = 0.0, seen = 0.0, rms_m = 0.0;
};

class PlaceSearch {
 public:
  static constexpr std::uint32_t kHypothesesMost = 512;  // the best stay (README.md): a tenth of a megabyte

  void lay_out(Arena& arena);
  void open();
  // Begins anew with what was seen. Neither that nor the map may change before the search has ended.
  void begin(const PlaceMap& map, const Surroundings& around);
  // Goes on for about so many steps of work: a step compares 64 points at 16 places, some 60 ns. True: it has ended.
  bool go_on(const PlaceMap& map, const Surroundings& around, std::uint64_t steps);
  bool is_under_way() const { return stage_ == Stage::kCoarse || stage_ == Stage::kFine; }
  // From 0 to 1.
  double progress() const;

  // After the end: the best first.
  Span<const Hypothesis> hypotheses() const { return hypotheses_.first(hypothesis_count_); }
  // No place was left out that could have been among the hypotheses, but for lack of room.
  bool is_whole() const { return is_whole_; }
  std::uint32_t seeds() const { return seed_count_; }

 private:
  enum class Stage : std::uint32_t { kIdle, kCoarse, kFine, kEnded };
  static constexpr std::int32_t kBlockTiles = 8;                             // own tiles of a block, a side
  static constexpr std::int32_t kOwn = kBlockTiles * PlaceMap::kTileCoarse;  // a block's own side in coarse cells
  static constexpr std::int32_t kMargin = 64;                                // coarse cells about them
  static constexpr std::int32_t kWide = kOwn + 2 * kMargin;                  // with the margin on both sides
  static constexpr std::int32_t kBlocks = PlaceMap::kAcross / kBlockTiles;   // along the side of the square
  static constexpr std::uint32_t kPointsMost = 64;    // by kLikely at most 192 in all, which a byte holds
  static constexpr std::uint32_t kPeaks = 4;          // directions of a cell
  static constexpr std::uint32_t kSeedsMost = 24576;  // 0.2 MB; is_whole says whether they were too few
  static constexpr std::uint32_t kLanes = 16;         // bytes of a vector register of SSE and NEON
  static constexpr std::uint32_t kBins = 65536;       // more than twice the seeds: few collide

  struct Seed {
    std::int16_t x, y;  // coarse cells of the square
    std::uint16_t yaw;
    std::uint16_t score;
  };
  struct Chunk {
    std::int16_t x, y;  // own coarse cells
    std::uint32_t standable;
  };
  struct Peak {
    std::uint16_t yaw;
    std::uint16_t score;
  };

  void choose_points(const Surroundings& around);
  bool next_block(const PlaceMap& map);
  void draw_block(const PlaceMap& map);
  void turn();
  void score(const Chunk& chunk);
  void note(std::uint32_t cell, std::uint32_t score);
  bool is_peak(std::int32_t cell, const Peak& peak) const;
  void harvest();
  void plant(const Seed& seed);
  void refine(const PlaceMap& map, const Surroundings& around, const Seed& seed);
  bool is_new(const Pose2& pose);
  void keep(const Hypothesis& hypothesis);
  void sort_out(const PlaceMap& map, const Surroundings& around);
  double yaw_of(std::uint32_t yaw) const { return yaw * yaw_step_rad_; }

  Span<std::uint8_t> window_;  // the coarse field about a block
  Span<Chunk> chunks_;
  Span<Peak> peaks_;
  Span<Seed> seeds_;
  Span<std::uint32_t> bins_;
  Span<Hypothesis> hypotheses_;
  ScanPoint chosen_[kPointsMost];
  std::int32_t offset_[kPointsMost];  // in the window, at the present yaw
  std::uint32_t chosen_count_ = 0, chunk_count_ = 0, seed_count_ = 0, hypothesis_count_ = 0;
  std::uint32_t least_ = 0;  // score of a seed
  std::uint32_t yaws_ = 1, yaw_ = 0, seed_ = 0;
  double yaw_step_rad_ = 1.0;
  std::int32_t block_ = 0, blocks_done_ = 0, blocks_all_ = 0;
  Stage stage_ = Stage::kIdle;
  bool is_whole_ = false;
};

}  // namespace pose_wall::planar

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The cost of a frame so far, in steps that are the same on every machine.
//
// Loops over data add their steps where they begin or end, by the number of their items. A step stands for about ten
// instructions of x86-64 or AArch64: `bench/instructions/count.py --dear` compares the two over ordinary and hostile
// clouds. A frame that has spent its budget (work_max) stops at the next check before further work. Results finished
// before then are reported, all else is refused.

#pragma once

#include <cstdint>

namespace pose_wall {

class Work {
 public:
  static constexpr std::uint64_t kNoEnd = ~0ULL;  // no frame takes as many steps

  Work() = default;
  explicit Work(std::uint64_t most) : most_(most) {}

  void add(std::uint64_t steps) { done_ += steps; }
  void add(std::uint64_t items, std::uint64_t steps_each) { done_ += items * steps_each; }
  std::uint64_t done() const { return done_; }
  std::uint64_t most() const { return most_; }
  std::uint64_t left() const { return done_ < most_ ? most_ - done_ : 0; }
  // True if the budget is spent. Ask only where work is left: it is cut off then, and so is all that follows.
  bool stops() {
    is_cut_off_ = is_cut_off_ || done_ > most_;
    return is_cut_off_;
  }
  // Whether something was left undone. A frame may spend its budget with its last piece of work.
  bool is_cut_off() const { return is_cut_off_; }

 private:
  std::uint64_t done_ = 0, most_ = kNoEnd;
  bool is_cut_off_ = false;
};

// Steps of one item. Each is a tenth of the instructions that its stage takes for one, rounded. They were counted under
// qemu over roads and the hostile clouds of tests/support/dear_clouds.hpp: 8 to 13 instructions a step, stage by stage.
namespace steps {

// Reading: a return of the cloud; a pass through the table of voxels, by its slots; a voxel that is sorted and written.
// The extra cost of crowded keys is not counted: it depends on the order of points, and each key has a cap.
constexpr std::uint64_t kPointRead = 11, kPointUnskewed = 16, kFourSlots = 2, kVoxelWritten = 15;
// Outliers: a voxel; one whose neighbours are sought; a column searched for its height; four compared voxels.
constexpr std::uint64_t kVoxelListed = 3, kVoxelLookedAround = 40, kColumnSearched = 16, kFourLookedAt = 2;
// Floor: a voxel tested for open ground, an open point within a radius, a hypothesis. A plane that is refined, one that
// is weighed, and each point of that. A point that a fit selects from, and one that goes into its patches:
constexpr std::uint64_t kVoxelOpened = 7, kPointWithin = 10, kFloorDrawn = 400, kFloorRefined = 4000;
constexpr std::uint64_t kFloorWeighed = 2500, kPointWeighed = 3, kPointSelected = 8, kPointPatched = 12;
// A plane that is compared with another one: each point, and each point that only one of the two may have.
constexpr std::uint64_t kPointCompared = 2, kPointApart = 4;
// Band: a voxel that is turned and cut.
constexpr std::uint64_t kVoxelLevelled = 8;
// Walls: a point of the band in passes over all of it, before the search and for each side; a hypothesis. A plane that
// is refined, one that is weighed, and each point of that. The looks at a fitted wall, and each point of the band for
// them:
constexpr std::uint64_t kPointParted = 16, kPointSided = 1, kWallDrawn = 350, kWallRefined = 7000, kWallWeighed = 5000;
constexpr std::uint64_t kPointMarked = 2, kWallLookedAt = 150000, kPointLookedAt = 11;
// A fit of a wall: a point of the band, one that is taken; a profile of strips; a point assigned by columns; one summed
// in patches; and one in a test for bends:
constexpr std::uint64_t kPointGathered = 2, kPointTaken = 12, kProfile = 30000, kPointByColumn = 12, kPointSummed = 3;
constexpr std::uint64_t kPointBent = 8;
// Fits: a point in a round of least squares; a cell of patches, a patch with points, and one that is paired with those
// around it; a patch of a surface that waves; a cell of a region in its some 150 rounds of least squares, at four each:
constexpr std::uint64_t kPointRound = 1, kCell = 4, kPatch = 20, kPatchMeasured = 60, kPatchPaired = 150;
constexpr std::uint64_t kPatchWaved = 500, kCellSettled = 600;

}  // namespace steps
}  // namespace pose_wall

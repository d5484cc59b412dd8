// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The most steps that a frame can take, by its config and the size of its cloud: computed from the caps of the loops,
// not measured. White box: it reads the caps where they stand.

#pragma once

#include <algorithm>
#include <cstdint>

#include "base/containers/work.hpp"
#include "base/estimation/patch_fit.hpp"
#include "base/estimation/surface_patches.hpp"
#include "engine/cloud/leaf.hpp"
#include "engine/config.hpp"
#include "engine/floor/floor.hpp"
#include "engine/walls/fit/points.hpp"

namespace pose_wall::test {

// All passes over the cloud, up to where the outliers may be stopped.
inline std::uint64_t most_of_reading(const Settings& s, std::uint64_t points) {
  std::uint64_t slots = 2;
  while (slots < 2ULL * s.points_max) slots *= 2;
  const std::uint64_t a_pass = points * steps::kPointRead + slots / 4 * steps::kFourSlots;
  return LeafSearch::kPassesMost * a_pass + s.points_max * (steps::kVoxelWritten + steps::kVoxelListed);
}

inline std::uint64_t most_of_patches() {
  constexpr std::uint64_t kAll = PatchGrid::kCapacity;
  return kAll * (steps::kCell + steps::kPatch + steps::kPatchMeasured) + 384 * steps::kPatchPaired +
         PatchGrid::kLayersMax * SurfacePatches::kMost * steps::kPatchWaved;
}

// The most steps of the floor from one place that asks whether the work is spent to the next one.
inline std::uint64_t most_of_a_floor_piece(const Settings& s) {
  const std::uint64_t voxels = s.points_max, waved = SurfacePatches::kMost;
  const std::uint64_t around = voxels / 4 * steps::kFourLookedAt + steps::kVoxelLookedAround;  // one last outlier
  const std::uint64_t drawn = (s.ground_iterations + 1) * steps::kFloorDrawn;
  const std::uint64_t weighed = steps::kFloorRefined + voxels * steps::kPointWeighed + steps::kFloorWeighed;
  const std::uint64_t selected = 2ULL * kFloorFitPoints * steps::kPointSelected + 5ULL * kFloorFitPoints;
  const std::uint64_t patched = kFloorFitPoints * steps::kPointPatched + most_of_patches() +
                                waved * steps::kPatchWaved + voxels * steps::kPointWithin;
  const std::uint64_t beside = voxels * steps::kPointWithin + drawn;
  return std::max({around + voxels * steps::kVoxelOpened, drawn + weighed, selected, patched, beside + weighed});
}

// As of the floor.
inline std::uint64_t most_of_a_wall_piece(const Settings& s) {
  constexpr std::uint64_t kAll = WallPoints::kMost, kRounds = 8, kStepRounds = 4;
  const std::uint64_t band = s.points_max;
  const std::uint64_t drawn = band * steps::kPointSided + (s.wall_iterations + 6ULL) * steps::kWallDrawn;
  const std::uint64_t weighed = 2 * steps::kWallRefined + steps::kWallWeighed + band * steps::kPointMarked;
  const std::uint64_t search = band * (steps::kVoxelLevelled + steps::kPointParted) + 2 * drawn + weighed;
  const std::uint64_t joint = kAll * steps::kPointSummed + PatchGrid::kCapacity * (steps::kCell + steps::kPatch);
  const std::uint64_t gathered = band * steps::kPointGathered + kAll * steps::kPointTaken;
  const std::uint64_t ring =
      steps::kProfile + kAll * (steps::kPointByColumn + kStepRounds * steps::kPointRound) + joint;
  const std::uint64_t cut =
      kAll * (steps::kPointByColumn + steps::kPointBent + kRounds * steps::kPointRound) + joint + most_of_patches();
  const std::uint64_t begun =
      2 * band * steps::kPointMarked + gathered + kAll * kRounds * steps::kPointRound + steps::kProfile + ring;
  const std::uint64_t ended = kAll * kRounds * steps::kPointRound + joint + 2 * most_of_patches() +
                              steps::kWallLookedAt + band * steps::kPointLookedAt;
  return std::max({search, begun, gathered + cut, ended});
}

// Whoever begins a piece has spent no more than the budget.
inline std::uint64_t most_of_a_frame(const Settings& s, std::uint64_t points) {
  const std::uint64_t begun =
      std::max(most_of_reading(s, points), work_most(s, points, std::min<std::uint64_t>(points, s.points_max)));
  return begun + std::max(most_of_a_floor_piece(s), most_of_a_wall_piece(s));
}

}  // namespace pose_wall::test

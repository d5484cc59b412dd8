// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The most steps that a frame can take, by its config and the size of its cloud: computed from the caps of the loops,
// not measured. White box: it reads the caps where they stand.

#pragma once

#include <cmath>
#include <cstdint>

#include "config.hpp"
#include "containers/voxel_hash.hpp"
#include "containers/work.hpp"
#include "engine.hpp"
#include "estimation/patch_fit.hpp"
#include "estimation/surface_patches.hpp"
#include "stages/ground.hpp"
#include "stages/ground_search.hpp"
#include "stages/voxel_leaf.hpp"
#include "stages/walls_points.hpp"
#include "stages/walls_search.hpp"

namespace pose_wall::test {

// Bits in which the cells of one frame can differ.
inline std::uint64_t key_bits(const Settings& s) {
  const double cells = 2.0 * reach_of(s) / s.voxel_leaf;
  return 3 * static_cast<std::uint64_t>(std::ceil(std::log2(cells)) + 1.0);
}

inline std::uint64_t most_of_reading(const Settings& s, std::uint64_t points) {
  std::uint64_t slots = 2;
  while (slots < 2ULL * s.points_max) slots *= 2;
  const std::uint64_t a_pass = points * steps::kPointRead + slots / 4 * steps::kFourSlots;
  return LeafSearch::kPassesMost * a_pass + s.points_max * steps::kVoxelWritten;
}

inline std::uint64_t most_of_patches() {
  constexpr std::uint64_t kAll = PatchGrid::kCapacity;
  return kAll * (steps::kCell + steps::kPatch + steps::kPatchMeasured) + 384 * steps::kPatchPaired;
}

// One radius of the floor, with what it began with and what is looked for beside it: nobody asks in between.
inline std::uint64_t most_of_a_floor(const Settings& s) {
  const std::uint64_t voxels = s.points_max, waved = SurfacePatches::kMost;
  const std::uint64_t search =
      (s.ground_iterations + 1) * steps::kFloorDrawn +
      kFloorShortlist * (steps::kFloorRefined + steps::kFloorWeighed + 2 * voxels * steps::kPointWeighed);
  const std::uint64_t selection = 2ULL * kGroundFitPoints * steps::kPointSelected + 5ULL * kGroundFitPoints;
  const std::uint64_t fit = 3 * selection + kGroundFitPoints * steps::kPointPatched + most_of_patches() +
                            waved * waved * steps::kPatchesWaved;
  const std::uint64_t beside = search + voxels * (steps::kPointWithin + kFloorShortlist * steps::kPointWeighed);
  return voxels * (steps::kVoxelOpened + steps::kPointWithin) + search + fit + beside;
}

// Up to where the walls that are chosen are to be fitted.
inline std::uint64_t most_of_wall_search(const Settings& s) {
  const std::uint64_t band = s.points_max;
  const std::uint64_t side = band * steps::kPointSided + (s.wall_iterations + 6ULL) * steps::kWallDrawn +
                             kWallShortlist * (2 * steps::kWallRefined + steps::kWallWeighed + band);
  return band * (steps::kVoxelLevelled + steps::kPointParted) + 5 * side;  // both sides, ahead twice, and behind
}

// One wall after it was asked for: cuts, the second fit and a close look.
inline std::uint64_t most_of_a_wall(const Settings& s) {
  constexpr std::uint64_t kAll = WallPoints::kMost, kRings = 4, kRingRounds = 3, kLastRounds = 8, kCuts = 5;
  const std::uint64_t joint = 3 * kAll + PatchGrid::kCapacity * (steps::kCell + steps::kPatch);
  const std::uint64_t gathered = s.points_max * steps::kPointGathered + kAll * steps::kPointTaken;
  const std::uint64_t ring = steps::kProfile + kAll * steps::kPointByColumn + 8 * kAll + kRingRounds * joint;
  const std::uint64_t fit = gathered + 2 * 8 * kAll + (kRings + 1) * ring + kLastRounds * joint + 2 * most_of_patches();
  const std::uint64_t cut = kAll * (steps::kPointByColumn + steps::kPointBent + 8) + joint;
  return 2 * fit + gathered + kCuts * cut + steps::kWallLookedAt + s.points_max * steps::kPointLookedAt;
}

inline std::uint64_t most_of_a_frame(const Settings& s, std::uint64_t points) {
  std::uint64_t step = most_of_a_floor(s);
  for (const std::uint64_t other : {most_of_wall_search(s), most_of_a_wall(s)}) step = other > step ? other : step;
  const std::uint64_t reading = most_of_reading(s, points), allowed = Engine::work_most_of(s, points);
  return (reading > allowed ? reading : allowed) + step;
}

}  // namespace pose_wall::test

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "containers/voxel_grid.hpp"

namespace pose_wall {
namespace {

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 29);
}

}  // namespace

void VoxelGrid::lay_out(Arena& arena, std::uint32_t capacity) {
  hash_.lay_out(arena, capacity);
  sums_ = arena.take<Sums>(capacity);
  order_ = arena.take<std::uint32_t>(capacity);
  spare_ = arena.take<std::uint32_t>(capacity);
  histogram_ = arena.take<std::uint32_t>(kRadixSize);
}

void VoxelGrid::begin(double leaf_m, double reach_m) {
  hash_.clear();
  // A power of two, and two cells to spare: the float's steps are as fine near the origin as they can be.
  std::uint32_t cells = 1;
  while ((cells - 2.0) * leaf_m < reach_m) cells *= 2;
  const double steps_per_cell = 1U << kStepBits;
  metres_per_step_ = leaf_m / steps_per_cell;
  origin_steps_ = cells * steps_per_cell;
  steps_ = {static_cast<float>(steps_per_cell / leaf_m), static_cast<float>(origin_steps_)};
}

void VoxelGrid::extract(PointSet* out) {
  const Span<const std::uint64_t> keys = hash_.keys();
  const Span<std::uint32_t> sorted =
      radix_order(keys, order_.first(keys.size()), spare_.first(keys.size()), histogram_);
  std::uint64_t fingerprint = keys.size();
  std::uint32_t at = 0;
  for (const std::uint32_t i : sorted) {
    const std::uint64_t key = keys[i];
    const Sums& s = sums_[i];
    const double per_weight = 1.0 / static_cast<double>(s.weight);
    out->x[at] = coordinate(key >> (2 * kFieldBits), s.x, per_weight);
    out->y[at] = coordinate((key >> kFieldBits) & kFieldMask, s.y, per_weight);
    out->z[at] = coordinate(key & kFieldMask, s.z, per_weight);
    out->weight[at] = static_cast<float>(s.weight) / static_cast<float>(kWeightOne);
    fingerprint = mixed(fingerprint, key);
    fingerprint = mixed(fingerprint, s.x | static_cast<std::uint64_t>(s.y) << 32);
    fingerprint = mixed(fingerprint, s.z | static_cast<std::uint64_t>(s.weight) << 32);
    ++at;
  }
  out->count = keys.size();
  fingerprint_ = fingerprint;
}

}  // namespace pose_wall

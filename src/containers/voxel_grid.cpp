// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "containers/voxel_grid.hpp"

namespace pose_wall {
namespace {

constexpr double kStepsPerMetre = 16384.0;
constexpr double kOriginSteps = 8388608.0;  // 512 m

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 29);
}

}  // namespace

void VoxelGrid::lay_out(Arena& arena, std::uint32_t capacity) {
  hash_.lay_out(arena, capacity);
  sums_ = arena.take<Sums>(capacity);
  order_ = arena.take<KeyedIndex>(capacity);
  spare_ = arena.take<KeyedIndex>(capacity);
  histogram_ = arena.take<std::uint32_t>(kRadixSize);
}

void VoxelGrid::begin(double leaf_m) {
  hash_.clear();
  leaf_steps_ = static_cast<std::int32_t>(leaf_m * kStepsPerMetre + 0.5);
  cells_per_step_ = 1.0 / static_cast<double>(leaf_steps_);
}

VoxelGrid::Cell VoxelGrid::cell_of(double coordinate_m) const {
  // Counted from far below every coordinate, so that cutting off the fraction rounds down: no call to floor().
  const std::int32_t steps = static_cast<std::int32_t>(coordinate_m * kStepsPerMetre + (kOriginSteps + 0.5));
  std::int32_t index = static_cast<std::int32_t>(static_cast<double>(steps) * cells_per_step_);
  std::int32_t offset = steps - index * leaf_steps_;
  // The product may round to the wrong side of a cell's border; whole numbers put it right.
  if (offset < 0) {
    --index;
    offset += leaf_steps_;
  } else if (offset >= leaf_steps_) {
    ++index;
    offset -= leaf_steps_;
  }
  return {index, static_cast<std::uint32_t>(offset)};
}

bool VoxelGrid::add(double x_m, double y_m, double z_m, std::uint32_t weight_sixteenths) {
  const Cell x = cell_of(x_m), y = cell_of(y_m), z = cell_of(z_m);
  const std::uint32_t known = hash_.count();
  const std::uint32_t index = hash_.insert(cell_key(x.index, y.index, z.index));
  if (index == VoxelHash::kFull) return false;
  Sums& s = sums_[index];
  if (index == known) s = Sums{0, 0, 0, 0};
  const std::uint64_t w = weight_sixteenths;
  s.x += w * x.offset_steps;
  s.y += w * y.offset_steps;
  s.z += w * z.offset_steps;
  s.weight += w;
  return true;
}

double VoxelGrid::centroid(std::uint64_t sum, std::uint64_t weight, std::int32_t cell) const {
  const double within = static_cast<double>(sum) / static_cast<double>(weight);
  return (static_cast<double>(cell) * static_cast<double>(leaf_steps_) + within - kOriginSteps) / kStepsPerMetre;
}

void VoxelGrid::extract(PointSet* out) {
  constexpr std::uint64_t kMask21 = (1U << 21) - 1;
  const std::uint32_t n = count();
  for (std::uint32_t i = 0; i < n; ++i) order_[i] = {hash_.key(i), i, 0};
  const Span<KeyedIndex> sorted = radix_sort(order_.first(n), spare_.first(n), histogram_);
  std::uint64_t fingerprint = n;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint64_t key = sorted[i].key;
    const Sums& s = sums_[sorted[i].index];
    const std::int32_t cx = static_cast<std::int32_t>((key >> 42) & kMask21) - kCellBias;
    const std::int32_t cy = static_cast<std::int32_t>((key >> 21) & kMask21) - kCellBias;
    const std::int32_t cz = static_cast<std::int32_t>(key & kMask21) - kCellBias;
    out->x[i] = static_cast<float>(centroid(s.x, s.weight, cx));
    out->y[i] = static_cast<float>(centroid(s.y, s.weight, cy));
    out->z[i] = static_cast<float>(centroid(s.z, s.weight, cz));
    out->weight[i] = static_cast<float>(s.weight) / static_cast<float>(kWeightOne);
    fingerprint = mixed(mixed(mixed(mixed(fingerprint, key), s.x), s.y), s.z + s.weight);
  }
  out->count = n;
  fingerprint_ = fingerprint;
}

}  // namespace pose_wall

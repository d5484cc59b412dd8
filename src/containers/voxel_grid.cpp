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
  order_ = arena.take<std::uint32_t>(capacity + 1);
  spare_ = arena.take<std::uint32_t>(capacity + 1);
  histogram_ = arena.take<std::uint32_t>(kRadixSize);
}

void VoxelGrid::begin(double leaf_m, double reach_m) {
  hash_.clear();
  sorted_ = order_.first(0);  // what lies there may be another stage's by now
  leaf_m_ = leaf_m;
  // Two cells to spare. Four thirds of a power of two, 10101...: the numbers of cells around the origin differ in few
  // bits, which is what sorting them costs. The float tells whole steps up to 2^24 of them, 16384 cells.
  std::uint32_t power = 1;
  while ((power - 2.0) * leaf_m < reach_m) power *= 2;
  const std::uint32_t cells = 4 * power / 3;
  const double steps_per_cell = 1U << kStepBits;
  metres_per_step_ = leaf_m / steps_per_cell;
  origin_steps_ = static_cast<std::int32_t>(cells << kStepBits);
  steps_ = {static_cast<float>(steps_per_cell / leaf_m), static_cast<float>(origin_steps_)};
}

void VoxelGrid::extract(PointSet* out) {
  const std::uint32_t cells = count();
  sorted_ = radix_order(hash_.keys(), order_.first(cells), spare_.first(cells), histogram_);
  write_sorted(out);
}

void VoxelGrid::extract_as_they_came(PointSet* out) {
  sorted_ = order_.first(count());
  for (std::uint32_t i = 0; i < sorted_.size(); ++i) sorted_[i] = i;
  write_sorted(out);
}

void VoxelGrid::write_sorted(PointSet* out) {
  const Span<const std::uint64_t> keys = hash_.keys();
  std::uint64_t fingerprint = keys.size();
  std::uint32_t at = 0;
  for (const std::uint32_t i : sorted_) {
    const std::uint64_t key = keys[i];
    const Sums& s = sums_[i];
    const double per_weight = 1.0 / static_cast<double>(s.weight);
    const VoxelKey::Cell cell = VoxelKey::cell_of(key);
    out->x[at] = coordinate(cell.x, s.x, per_weight);
    out->y[at] = coordinate(cell.y, s.y, per_weight);
    out->z[at] = coordinate(cell.z, s.z, per_weight);
    out->weight[at] = static_cast<float>(s.weight) / static_cast<float>(kWeightOne);
    const std::uint64_t xy = s.x | static_cast<std::uint64_t>(s.y) << 32,
                        zw = s.z | static_cast<std::uint64_t>(s.weight) << 32;
    // Odd factors of many bits, so that sums and key do not undo each other's changes.
    fingerprint = mixed(fingerprint, key ^ (xy * 0xC2B2AE3D27D4EB4FULL) ^ (zw * 0x165667B19E3779F9ULL));
    ++at;
  }
  out->count = keys.size();
  fingerprint_ = fingerprint;
}

Span<const std::uint32_t> VoxelGrid::find_columns() {
  const Span<std::uint32_t> begins = sorted_.data() == order_.data() ? spare_ : order_;
  std::uint32_t columns = 0;
  std::uint64_t last = 0;
  for (std::uint32_t i = 0; i < sorted_.size(); ++i) {
    const std::uint64_t column = VoxelKey::column_of(key_in_order(i));
    if (columns == 0 || column != last) begins[columns++] = i;
    last = column;
  }
  begins[columns] = sorted_.size();
  return begins.first(columns + 1);
}

}  // namespace pose_wall

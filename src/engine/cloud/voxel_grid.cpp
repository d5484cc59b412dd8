// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/voxel_grid.hpp"

#include <cstring>

namespace pose_wall {

void VoxelGrid::lay_out(Arena& arena, std::uint32_t capacity) {
  hash_.lay_out(arena, capacity);
  sums_ = arena.take<Sums>(capacity);
  order_ = hash_.first_side();
  spare_ = hash_.second_side();
  histogram_ = arena.take<std::uint32_t>(kRadixSize);
}

void VoxelGrid::begin(double leaf_m, double reach_m) {
  hash_.clear();
  sorted_ = order_.first(0);  // that room may belong to another stage by now
  leaf_m_ = leaf_m;
  // Two cells to spare. Four thirds of a power of two, 10101...: so the numbers of cells around the origin differ in
  // few bits, which makes sorting cheap. The float holds whole steps up to 2^24 of them, 16384 cells.
  std::uint32_t power = 1;
  while ((power - 2.0) * leaf_m < reach_m) power *= 2;
  const std::uint32_t cells = 4 * power / 3;
  const double steps_per_cell = 1U << kStepBits;
  origin_cell_ = static_cast<std::int32_t>(cells);
  steps_per_m_ = static_cast<float>(steps_per_cell / leaf_m);
  origin_step_ = static_cast<float>(cells << kStepBits);
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
  const auto leaf_m = static_cast<float>(leaf_m_), metres_per_step = leaf_m / (1U << kStepBits);
  const auto coordinates = [&](FourInts cells, FourWords sums, FourFloats per_weight) {
    const FourFloats steps = __builtin_convertvector(sums, FourFloats) * per_weight + 0.5F;
    return __builtin_convertvector(cells - origin_cell_, FourFloats) * leaf_m + steps * metres_per_step;
  };
  for (std::uint32_t at = 0; at < sorted_.size(); at += kFour) {
    std::uint64_t four_keys[kFour];
    Sums sums[kFour];
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const std::uint32_t i = sorted_[at + lane < sorted_.size() ? at + lane : at];
      four_keys[lane] = keys[i];
      sums[lane] = sums_[i];
    }
    const VoxelKey::FourCells cells = VoxelKey::cells_of(four_keys);
    FourWords of[kFour];  // x, y, z, weight
    transpose(sums[0], sums[1], sums[2], sums[3], of);
    const FourFloats weights = __builtin_convertvector(of[3], FourFloats), per_weight = 1.0F / weights;
    store_four(coordinates(cells.x, of[0], per_weight), &out->x[at]);
    store_four(coordinates(cells.y, of[1], per_weight), &out->y[at]);
    store_four(coordinates(cells.z, of[2], per_weight), &out->z[at]);
    store_four(weights * (1.0F / kWeightOne), &out->weight[at]);
  }
  out->count = sorted_.size();
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

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/point_set.hpp"
#include "base/containers/radix_sort.hpp"
#include "base/simd/four_floats.hpp"
#include "engine/cloud/voxel_hash.hpp"
#include "engine/cloud/voxel_key.hpp"

namespace pose_wall {

// Weights are whole sixteenths, so that sums do not depend on the order of points.
constexpr std::uint32_t kWeightOne = 16;

// Weighted centroids of the points in each cell of a grid. Coordinates are summed as whole steps of a 1024th of the
// cell's edge. So the centroids are the same bits whatever the order of the points. They are exact to half a step, or
// to a float's resolution over the whole reach.
class VoxelGrid {
 public:
  // A cell is 1024 steps wide: centroids of 5 cm cells are exact to 0.02 mm. With a cell's 21 bits (VoxelKey) a step's
  // number still is a positive integer of 32 bits.
  static constexpr std::uint32_t kStepBits = 10;

  void lay_out(Arena& arena, std::uint32_t capacity);

  // Starts a new grid; leaf from 0.01 m to 100 m, |x|, |y|, |z| <= reach_m < 1000 m.
  void begin(double leaf_m, double reach_m);

  static constexpr std::uint32_t kWeightMost = 1U << 22;  // times the largest step within a cell: below 2^32
  // A point's part in its cell: its steps within the cell times its weight, and the weight, in sixteenths.
  using Sums = FourWords;  // x, y, z, weight

  // Of four points within the reach of begin(); weights: 1 to kWeightMost.
  void split(FourFloats x_m, FourFloats y_m, FourFloats z_m, FourWords weights, std::uint64_t* keys, Sums* sums) const {
    const FourInts x = steps_of(x_m), y = steps_of(y_m), z = steps_of(z_m);
    VoxelKey::of_four({x >> kStepBits, y >> kStepBits, z >> kStepBits}, keys);
    transpose(within(x) * weights, within(y) * weights, within(z) * weights, weights, sums);
  }

  // Adds points one after the other. Nothing else may read the grid meanwhile.
  class Filling {
   public:
    explicit Filling(VoxelGrid* grid) : hash_(&grid->hash_), sums_(grid->sums_.data()) {}

    // Adds a point after split(). False if it needs a new cell and there is no room: the grid is then useless. A cell
    // takes the weight of a quarter of a million points. Points beyond that are left out, which depends on their order.
    bool add(std::uint64_t key, Sums sums) {
      const std::uint32_t known = hash_.count();
      const std::uint32_t index = hash_.insert(key);
      if (index == VoxelHash::kFull) return false;
      const Sums all = index == known ? sums : sums_[index] + sums;
      if (all[3] <= kWeightMost) sums_[index] = all;
      return true;
    }

   private:
    VoxelHash::Filling hash_;
    Sums* const sums_;
  };

  // Writes the centroids in the order of their cells' keys, or in the order in which the cells came. out must have room
  // for count(), and rows that go on for a four. No point may be added any more until begin().
  void extract(PointSet* out);
  void extract_as_they_came(PointSet* out);

  // Valid after extract() in the order of the keys, until the next begin(). Gives the key of the i-th centroid, and the
  // start of each column's keys in the list. The end of the list comes last. Before extract(): nothing and an end.
  std::uint64_t key_in_order(std::uint32_t i) const { return hash_.key(sorted_[i]); }
  Span<const std::uint32_t> find_columns();
  double leaf_m() const { return leaf_m_; }

  std::uint32_t count() const { return hash_.count(); }
  // Cost of cells that share the hash's slots since begin(), in steps of about ten instructions.
  std::uint64_t crowding() const { return hash_.links(); }
  std::uint32_t slots() const { return hash_.slots(); }

 private:
  static constexpr std::uint32_t kStepMask = (1U << kStepBits) - 1;  // the step within its cell

  void write_sorted(PointSet* out);
  // The step that holds a coordinate is coordinate * per_m + origin, cut off.
  FourInts steps_of(FourFloats coordinates_m) const { return cut_off(coordinates_m * steps_per_m_ + origin_step_); }
  static FourWords within(FourInts steps) { return reinterpret_cast<FourWords>(steps) & kStepMask; }

  VoxelHash hash_;
  Span<Sums> sums_;
  Span<std::uint32_t> order_, spare_;  // on top of the hash's tree: no key is added once they are written
  Span<std::uint32_t> sorted_;         // one of the two, in the end
  Span<std::uint32_t> histogram_;
  float steps_per_m_ = 1.0F, origin_step_ = 0.0F;
  double leaf_m_ = 1.0;
  std::int32_t origin_cell_ = 0;
};

}  // namespace pose_wall

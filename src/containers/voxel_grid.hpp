// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "containers/arena.hpp"
#include "containers/point_set.hpp"
#include "containers/radix_sort.hpp"
#include "containers/voxel_hash.hpp"
#include "containers/voxel_key.hpp"
#include "math/four_floats.hpp"

namespace pose_wall {

// Weights are whole sixteenths, so that sums do not depend on the order of points.
constexpr std::uint32_t kWeightOne = 16;

// Weighted centroids of the points in each cell of a grid. Coordinates are summed as whole steps, a 1024th of the
// cell's edge each: the centroids are the same bits whatever the order of the points, and exact to half a step, or to
// what floats tell apart over the whole reach.
class VoxelGrid {
 public:
  static constexpr std::uint32_t kStepBits = 10;

  void lay_out(Arena& arena, std::uint32_t capacity);

  // Starts a new grid; leaf from 0.01 m to 100 m, |x|, |y|, |z| <= reach_m < 1000 m.
  void begin(double leaf_m, double reach_m);

  // The step that holds a coordinate is coordinate * per_m + origin, cut off: who adds many points does it for several
  // at once.
  struct Steps {
    float per_m, origin;
    std::int32_t of(float coordinate_m) const { return static_cast<std::int32_t>(coordinate_m * per_m + origin); }
    FourInts of(FourFloats coordinates_m) const { return cut_off(coordinates_m * per_m + origin); }
  };
  const Steps& steps() const { return steps_; }

  // False where the point needs a new cell and there is no room: the grid is then of no use. A cell takes the weight of
  // a quarter of a million points; which of more count depends on their order.
  bool add(std::int32_t x_step, std::int32_t y_step, std::int32_t z_step, std::uint32_t weight_sixteenths) {
    const std::uint32_t known = hash_.count();
    const std::uint32_t index =
        hash_.insert(VoxelKey::of(x_step >> kStepBits, y_step >> kStepBits, z_step >> kStepBits));
    if (index == VoxelHash::kFull) return false;
    Sums& s = sums_[index];
    if (index == known) s = Sums{0, 0, 0, 0};
    const std::uint32_t room = kWeightMost - s.weight, w = weight_sixteenths < room ? weight_sixteenths : room;
    s.x += w * within(x_step);
    s.y += w * within(y_step);
    s.z += w * within(z_step);
    s.weight += w;
    return true;
  }
  bool add(float x_m, float y_m, float z_m, std::uint32_t weight_sixteenths) {
    return add(steps_.of(x_m), steps_.of(y_m), steps_.of(z_m), weight_sixteenths);
  }

  // Writes the centroids in the order of their cells' keys, or in that in which the cells came. out must have room for
  // count().
  void extract(PointSet* out);
  void extract_as_they_came(PointSet* out);

  // After extract() in the order of the keys, until the next begin(): the key of the i-th centroid, and where each
  // column's keys begin in the list, with its end as the last; nothing, and an end, before.
  std::uint64_t key_in_order(std::uint32_t i) const { return hash_.key(sorted_[i]); }
  Span<const std::uint32_t> find_columns();
  double leaf_m() const { return leaf_m_; }

  std::uint32_t count() const { return hash_.count(); }
  // Of all cells and their sums, after extract() in the order of the keys: equal clouds give equal numbers, others
  // different ones.
  std::uint64_t fingerprint() const { return fingerprint_; }

 private:
  static constexpr std::uint32_t kStepMask = (1U << kStepBits) - 1;
  static constexpr std::uint32_t kWeightMost = 1U << 22;  // times the largest step within a cell: below 2^32

  struct Sums {
    std::uint32_t x, y, z;  // weighted steps within the cell
    std::uint32_t weight;
  };

  void write_sorted(PointSet* out);
  static std::uint32_t within(std::int32_t step) { return static_cast<std::uint32_t>(step) & kStepMask; }
  float coordinate(std::uint32_t cell, std::uint32_t sum, double per_weight) const {
    const std::int32_t steps = static_cast<std::int32_t>(cell << kStepBits) - origin_steps_;
    return static_cast<float>((static_cast<double>(steps) + static_cast<double>(sum) * per_weight + 0.5) *
                              metres_per_step_);
  }

  VoxelHash hash_;
  Span<Sums> sums_;
  Span<std::uint32_t> order_, spare_;
  Span<std::uint32_t> sorted_;  // one of the two, in the end
  Span<std::uint32_t> histogram_;
  Steps steps_{1.0F, 0.0F};
  double leaf_m_ = 1.0, metres_per_step_ = 1.0;
  std::int32_t origin_steps_ = 0;
  std::uint64_t fingerprint_ = 0;
};

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/voxels.hpp"

#include <cmath>
#include <cstring>

#include "base/containers/work.hpp"
#include "base/math/finite.hpp"
#include "base/simd/four_floats.hpp"
#include "base/simd/four_turns.hpp"
#include "engine/cloud/leaf.hpp"
#include "engine/cloud/skew.hpp"
#include "lidar/body_boxes.hpp"
#include "lidar/point_reader.hpp"

namespace pose_wall {
namespace {

// The fate of a point. The last one that applies counts.
enum Fate : std::int32_t { kKept = 0, kNear = 1, kBody = 2, kBeyond = 3 };  // kBeyond: too far, zero or not a number

// Points are processed by the block, turned and judged four at a time. Only entries in tables go one by one.
struct PointBlock {
  // Some 4 KiB, which stay in the nearest cache; whole fours.
  static constexpr std::uint32_t kSize = 64;
  std::uint32_t count = 0;
  float x_lidar[kSize], y_lidar[kSize], z_lidar[kSize];
  float x_base[kSize], y_base[kSize], z_base[kSize];
  float time_s[kSize];       // since the stamp, where there is skew to take out
  std::uint64_t key[kSize];  // of a voxel
  VoxelGrid::Sums sums[kSize];
  std::int32_t direction[kSize];  // cell of Directions
  std::int32_t quadrant[kSize];
  std::int32_t fate[kSize];
  std::uint32_t weight[kSize];
  std::uint32_t word[kSize];  // of the cloud's print, and its sector
  std::int32_t sector[kSize];
};

// Mean intensity of the readable points. Brighter points are brighter than this.
double mean_intensity(const pose_wall_cloud& cloud, bool swap) {
  double sum = 0.0;
  std::uint64_t count = 0;
  for (std::uint32_t row = 0; row < rows_of(cloud); ++row) {
    const unsigned char* point = row_of(cloud, row);
    for (std::uint32_t column = 0; column < cloud.width; ++column, point += cloud.point_step) {
      const double value = read_field(point, cloud.intensity, swap);
      if (!(value > 0.0 && value < 1e6)) continue;
      // Whole 1/256 steps: a sum that does not depend on the order of points.
      sum += std::floor(value * 256.0);
      ++count;
    }
  }
  return count > 0 ? sum / (256.0 * static_cast<double>(count)) : 0.0;
}

// One pass over a cloud into a grid.
class Pass {
 public:
  Pass(const pose_wall_cloud& cloud, const Settings& settings, const Extrinsic& extrinsic, const Axes& axes,
       const Skew& skew)
      : cloud_(cloud),
        skew_(skew),
        to_base_(extrinsic.R_base_lidar, extrinsic.sensor_base_m),
        range_min2_(static_cast<float>(settings.range_min * settings.range_min)),
        range_max2_(static_cast<float>(settings.range_max * settings.range_max)),
        reader_(cloud),
        intensity_weight_(cloud.intensity.type != POSE_WALL_FIELD_NONE ? settings.intensity_weight : 0.0),
        mean_intensity_(intensity_weight_ > 0.0 ? mean_intensity(cloud, reader_.swap()) : 0.0),
        boxes_({settings.body_box_1, settings.body_box_2, settings.body_box_3, settings.body_box_4}, cloud) {
    const Eigen::Vector3d x_base = Eigen::Vector3d::UnitX(), y_base = Eigen::Vector3d::UnitY();
    quadrants_ = {quadrant_of(axes, x_base), quadrant_of(axes, y_base), quadrant_of(axes, -x_base),
                  quadrant_of(axes, -y_base)};
  }

  // False if the grid overflows. The counts are then complete only if the pass goes on to the end all the same.
  bool run(bool to_the_end, VoxelGrid* grid, ReturnsByDirection* returns_lidar, IngestCounts* counts,
           CloudPrint* print) const {
    bool fits = true;
    *counts = IngestCounts{};
    print->clear();
    returns_lidar->clear();
    PointBlock block;
    for (std::uint32_t row = 0; row < rows_of(cloud_); ++row) {
      const unsigned char* point = row_of(cloud_, row);
      for (std::uint32_t column = 0; column < cloud_.width;) {
        const std::uint32_t room = PointBlock::kSize - block.count, left = cloud_.width - column;
        const std::uint32_t count = left < room ? left : room;
        read(point, count, &block);
        column += count;
        point += static_cast<std::size_t>(count) * cloud_.point_step;
        if (block.count != PointBlock::kSize) continue;
        if (!take(&block, grid, returns_lidar, counts, print)) fits = false;
        if (!fits && !to_the_end) return false;
      }
    }
    return take(&block, grid, returns_lidar, counts, print) && fits;
  }

 private:
  // Points of one row, side by side.
  void read(const unsigned char* point, std::uint32_t count, PointBlock* block) const {
    const std::uint32_t begin = block->count, end = begin + count;
    block->count = end;
    reader_.row(point, count, &block->x_lidar[begin], &block->y_lidar[begin], &block->z_lidar[begin]);
    if (skew_.is_there()) {
      const unsigned char* at = point;
      for (std::uint32_t k = begin; k < end; ++k, at += cloud_.point_step) block->time_s[k] = skew_.seconds(at);
    }
    if (!(intensity_weight_ > 0.0)) {
      for (std::uint32_t k = begin; k < end; ++k) block->weight[k] = kWeightOne;
      return;
    }
    for (std::uint32_t k = begin; k < end; ++k, point += cloud_.point_step) block->weight[k] = weight_of(point);
  }

  std::uint32_t weight_of(const unsigned char* point) const {
    const double value = read_field(point, cloud_.intensity, reader_.swap());
    const double brightness = value > 0.0 && value < 1e6 ? value / (value + mean_intensity_) : 0.0;
    const double weight = kWeightOne * (1.0 - intensity_weight_ + intensity_weight_ * brightness);
    return weight >= 1.0 ? static_cast<std::uint32_t>(weight + 0.5) : 1U;
  }

  // The quadrant that an axis of base points into.
  static std::int32_t quadrant_of(const Axes& axes, const Eigen::Vector3d& axis_base) {
    const double ahead = axes.forward_base.dot(axis_base), left = axes.left_base.dot(axis_base);
    if (std::fabs(left) > std::fabs(ahead)) return left > 0.0 ? kLeft : kRight;
    return ahead > 0.0 ? kAhead : kBehind;
  }

  // Whole fours, up to end. Values beyond may be anything: they are turned as if zero and left out at the end.
  void judge_and_turn(const VoxelGrid& grid, std::uint32_t end, PointBlock* b) const {
    const FourInts kept = all_four_ints(kKept), near = all_four_ints(kNear), beyond = all_four_ints(kBeyond);
    const FourInts with_x = all_four_ints(quadrants_.with_x), with_y = all_four_ints(quadrants_.with_y);
    const FourInts against_x = all_four_ints(quadrants_.against_x), against_y = all_four_ints(quadrants_.against_y);
    const FourFloats least2 = all_four(range_min2_), most2 = all_four(range_max2_), none{};
    const FourTurns to_base = to_base_;  // a local copy, so that no store can seem to change it
    for (std::size_t k = 0; k < end; k += kFour) {
      FourFloats x = load_four(&b->x_lidar[k]), y = load_four(&b->y_lidar[k]), z = load_four(&b->z_lidar[k]);
      const FourFloats range2 = x * x + y * y + z * z;
      const FourTruths there = (range2 <= most2) & (range2 > none);
      store_four(there ? (range2 < least2 ? near : kept) : beyond, &b->fate[k]);
      store_four(words_of({x, y, z}), &b->word[k]);
      x = there ? x : none;
      y = there ? y : none;
      z = there ? z : none;
      FourInts half_columns;
      store_four(Directions::cells_of(x, y, z, range2, &half_columns), &b->direction[k]);
      store_four(half_columns, &b->sector[k]);
      const FourPlaces ray = to_base.turned(x, y, z);
      FourPlaces base = to_base.shifted(ray);
      if (skew_.is_there()) base = skew_.taken_out(base, load_four(&b->time_s[k]));
      store_four(base.x, &b->x_base[k]);
      store_four(base.y, &b->y_base[k]);
      store_four(base.z, &b->z_base[k]);
      FourWords weights;
      std::memcpy(&weights, &b->weight[k], sizeof(weights));
      grid.split(base.x, base.y, base.z, weights, &b->key[k], &b->sums[k]);
      const FourInts along_x = ray.x > none ? with_x : against_x, along_y = ray.y > none ? with_y : against_y;
      store_four(magnitude_of(ray.y) > magnitude_of(ray.x) ? along_y : along_x, &b->quadrant[k]);
    }
  }

  void judge_bodies(std::uint32_t end, PointBlock* b) const {
    if (boxes_.empty()) return;
    for (std::size_t k = 0; k < end; k += kFour) {
      const FourTruths inside =
          boxes_.hold({load_four(&b->x_base[k]), load_four(&b->y_base[k]), load_four(&b->z_base[k])});
      if (!any_of(inside)) continue;
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        if (inside[lane] != 0 && b->fate[k + lane] != kBeyond) b->fate[k + lane] = kBody;
      }
    }
  }

  // False where the grid overflows. Leaves the block empty.
  bool take(PointBlock* block, VoxelGrid* grid, ReturnsByDirection* returns_lidar, IngestCounts* counts,
            CloudPrint* print) const {
    const std::uint32_t count = block->count;
    block->count = 0;
    if (count == 0) return true;
    std::uint32_t end = count;  // of whole fours
    for (; end % kFour != 0; ++end) {
      block->x_lidar[end] = block->y_lidar[end] = block->z_lidar[end] = 0.0F;
      block->weight[end] = kWeightOne;
      block->time_s[end] = 0.0F;
    }
    judge_and_turn(*grid, end, block);
    judge_bodies(end, block);
    counts->points_in += count;
    bool fits = true;
    VoxelGrid::Filling cells(grid);
    for (std::uint32_t k = 0; k < count; ++k) {
      if (block->fate[k] == kBeyond) {
        count_beyond(*block, k, returns_lidar, counts);
        continue;
      }
      const auto direction = static_cast<std::uint32_t>(block->direction[k]);
      returns_lidar->all_slices.add(direction, 1);
      print->add(static_cast<std::uint32_t>(block->sector[k]), block->word[k]);
      if (block->fate[k] == kKept) {
        ++counts->kept_by_quadrant[block->quadrant[k]];
        if (skew_.is_there()) counts->kept_us += microseconds_of(block->time_s[k]);
        if (!cells.add(block->key[k], block->sums[k])) fits = false;
      } else {
        ++(block->fate[k] == kNear ? counts->near_by_quadrant[block->quadrant[k]] : counts->dropped_body);
      }
    }
    counts->kept = sum_of(counts->kept_by_quadrant);
    counts->dropped_near = sum_of(counts->near_by_quadrant);
    return fits;
  }

  // Whole ones: a sum that does not depend on the order of points.
  static std::uint32_t microseconds_of(float time_s) { return static_cast<std::uint32_t>(time_s * 1e6F); }

  static std::uint32_t sum_of(const std::uint32_t (&by_quadrant)[kQuadrants]) {
    return by_quadrant[kAhead] + by_quadrant[kLeft] + by_quadrant[kBehind] + by_quadrant[kRight];
  }

  static void count_beyond(const PointBlock& block, std::uint32_t k, ReturnsByDirection* returns_lidar,
                           IngestCounts* counts) {
    const Eigen::Vector3d p(static_cast<double>(block.x_lidar[k]), static_cast<double>(block.y_lidar[k]),
                            static_cast<double>(block.z_lidar[k]));
    if (!is_finite(p.x()) || !is_finite(p.y()) || !is_finite(p.z())) {
      ++counts->dropped_not_finite;
    } else if (p.squaredNorm() == 0.0) {
      ++counts->dropped_zero;
    } else if (p.squaredNorm() < 1.0) {  // its square is no float, so it was turned as if zero
      ++counts->near_by_quadrant[kBehind];
      returns_lidar->all_slices.add(Directions::cell_of(p), 1);
    } else {
      ++counts->dropped_far;
      const std::uint32_t cell = Directions::cell_of(p);
      returns_lidar->all_slices.add(cell, 1);
      returns_lidar->too_far_slices.add(cell, 1);
    }
  }

  const pose_wall_cloud& cloud_;
  const Skew& skew_;
  FourTurns to_base_;
  float range_min2_, range_max2_;
  struct {
    std::int32_t with_x, with_y, against_x, against_y;  // base's axes
  } quadrants_;
  PointReader reader_;
  double intensity_weight_;
  double mean_intensity_;
  BodyBoxes boxes_;
};

// No-returns cost a few instructions each, and the caller may leave them out of the cloud.
std::uint32_t returns_of(const IngestCounts& counts) {
  return counts.points_in - counts.dropped_not_finite - counts.dropped_zero;
}

}  // namespace

VoxelResult build_voxels(const pose_wall_cloud& cloud, const pose_wall_odometry* odometry, const Settings& settings,
                         const Extrinsic& extrinsic, const Axes& axes, const LeafMemory& last, VoxelGrid* grid,
                         const AllReturns& all_returns, PointSet* cloud_base) {
  ReturnsByDirection* const returns_lidar = all_returns.by_direction_lidar;
  VoxelResult result;
  Work work;
  const Skew skew(cloud, odometry);
  const Pass pass(cloud, settings, extrinsic, axes, skew);
  LeafSearch leaf(settings.voxel_leaf, settings.points_max, last);
  do {
    grid->begin(leaf.leaf_m(), reach_of(settings));
    result.fits = pass.run(leaf.is_largest(), grid, returns_lidar, &result.counts, all_returns.print);
    work.add(returns_of(result.counts), skew.is_there() ? steps::kPointUnskewed : steps::kPointRead);
    work.add(grid->slots() / kFour, steps::kFourSlots);
  } while (leaf.goes_on(result.fits, grid->count()));
  returns_lidar->settle();
  result.leaf_m = leaf.leaf_m();
  result.leaf = leaf.memory(result.fits, grid->count());
  cloud_base->count = 0;
  if (result.fits) {
    grid->extract(cloud_base);
    work.add(cloud_base->count, steps::kVoxelWritten);
  }
  if (skew.is_there() && result.counts.kept > 0) {
    result.scan = {skew.scan_s(), 1e-6 * static_cast<double>(result.counts.kept_us) / result.counts.kept};
  }
  result.returns = returns_of(result.counts);
  result.work = work.done();
  return result;
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/voxel.hpp"

#include <cmath>
#include <cstring>

#include "math/finite.hpp"
#include "stages/voxel_cloud_reader.hpp"

namespace pose_wall {
namespace {

constexpr double kLeafGrowth = 1.26;  // about the cube root of 2
constexpr int kLeafTries = 20;        // 1.26^19: 80 times the configured leaf

enum class Fate { kKept, kNotFinite, kZero, kNear, kFar, kBody };

struct Filter {
  double range_min2, range_max2;
  Box boxes[4];
  std::uint32_t box_count = 0;

  explicit Filter(const Settings& s)
      : range_min2(s.range_min * s.range_min), range_max2(s.range_max * s.range_max), boxes{} {
    for (const Box* box : {&s.body_box_1, &s.body_box_2, &s.body_box_3, &s.body_box_4}) {
      if (box->holds_something()) boxes[box_count++] = *box;
    }
  }

  bool in_body(const Eigen::Vector3d& p_base) const {
    for (std::uint32_t b = 0; b < box_count; ++b) {
      if (boxes[b].contains(p_base.x(), p_base.y(), p_base.z())) return true;
    }
    return false;
  }

  Fate fate(const Eigen::Vector3d& p_lidar, const Eigen::Vector3d& p_base) const {
    if (!is_finite(p_lidar.x()) || !is_finite(p_lidar.y()) || !is_finite(p_lidar.z())) return Fate::kNotFinite;
    const double range2 = p_lidar.squaredNorm();
    if (range2 == 0.0) return Fate::kZero;
    if (!(range2 <= range_max2)) return Fate::kFar;
    if (in_body(p_base)) return Fate::kBody;
    return range2 >= range_min2 ? Fate::kKept : Fate::kNear;
  }
};

// Mean intensity of the readable points: the brightness that "brighter" is measured against.
double mean_intensity(const pose_wall_cloud& cloud, bool swap) {
  double sum = 0.0;
  std::uint64_t count = 0;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
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
  Pass(const pose_wall_cloud& cloud, const Settings& settings, const Extrinsic& extrinsic, const Axes& axes)
      : cloud_(cloud),
        filter_(settings),
        extrinsic_(extrinsic),
        axes_(axes),
        swap_(needs_swap(cloud)),
        plain_(is_plain_xyz32(cloud)),
        intensity_weight_(cloud.intensity.type != POSE_WALL_FIELD_NONE ? settings.intensity_weight : 0.0),
        mean_intensity_(intensity_weight_ > 0.0 ? mean_intensity(cloud, swap_) : 0.0) {}

  // False where the grid overflows; counts are complete only on true.
  bool run(VoxelGrid* grid, ReturnsByDirection* returns_lidar, IngestCounts* counts) const {
    *counts = IngestCounts{};
    returns_lidar->clear();
    for (std::uint32_t row = 0; row < cloud_.height; ++row) {
      const unsigned char* point = row_of(cloud_, row);
      for (std::uint32_t column = 0; column < cloud_.width; ++column, point += cloud_.point_step) {
        if (!take(point, grid, returns_lidar, counts)) return false;
      }
    }
    return true;
  }

 private:
  Eigen::Vector3d position_lidar(const unsigned char* point) const {
    if (plain_) {
      float x, y, z;
      std::memcpy(&x, point + cloud_.x.offset, sizeof(float));
      std::memcpy(&y, point + cloud_.y.offset, sizeof(float));
      std::memcpy(&z, point + cloud_.z.offset, sizeof(float));
      return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    }
    return {read_field(point, cloud_.x, swap_), read_field(point, cloud_.y, swap_), read_field(point, cloud_.z, swap_)};
  }

  std::uint32_t weight_of(const unsigned char* point) const {
    if (!(intensity_weight_ > 0.0)) return kWeightOne;
    const double value = read_field(point, cloud_.intensity, swap_);
    const double brightness = value > 0.0 && value < 1e6 ? value / (value + mean_intensity_) : 0.0;
    const double weight = kWeightOne * (1.0 - intensity_weight_ + intensity_weight_ * brightness);
    return weight >= 1.0 ? static_cast<std::uint32_t>(weight + 0.5) : 1U;
  }

  Quadrant quadrant_of(const Eigen::Vector3d& p_base) const {
    const Eigen::Vector3d from_sensor = p_base - extrinsic_.sensor_base_m;
    const double ahead = axes_.forward_base.dot(from_sensor), left = axes_.left_base.dot(from_sensor);
    if (std::fabs(left) > std::fabs(ahead)) return left > 0.0 ? kLeft : kRight;
    return ahead > 0.0 ? kAhead : kBehind;
  }

  bool take(const unsigned char* point, VoxelGrid* grid, ReturnsByDirection* returns_lidar,
            IngestCounts* counts) const {
    const Eigen::Vector3d p_lidar = position_lidar(point);
    const Eigen::Vector3d p_base = extrinsic_.R_base_lidar * p_lidar + extrinsic_.sensor_base_m;
    ++counts->points_in;
    const Fate fate = filter_.fate(p_lidar, p_base);
    if (fate != Fate::kNotFinite && fate != Fate::kZero) returns_lidar->all.add(p_lidar, 1);
    if (fate == Fate::kFar) returns_lidar->too_far.add(p_lidar, 1);
    switch (fate) {
      case Fate::kNotFinite:
        ++counts->dropped_not_finite;
        return true;
      case Fate::kZero:
        ++counts->dropped_zero;
        return true;
      case Fate::kFar:
        ++counts->dropped_far;
        return true;
      case Fate::kBody:
        ++counts->dropped_body;
        return true;
      case Fate::kNear:
        ++counts->dropped_near;
        ++counts->near_by_quadrant[quadrant_of(p_base)];
        return true;
      case Fate::kKept:
        break;
    }
    ++counts->kept;
    ++counts->kept_by_quadrant[quadrant_of(p_base)];
    return grid->add(p_base.x(), p_base.y(), p_base.z(), weight_of(point));
  }

  const pose_wall_cloud& cloud_;
  Filter filter_;
  const Extrinsic& extrinsic_;
  const Axes& axes_;
  bool swap_;
  bool plain_;
  double intensity_weight_;
  double mean_intensity_;
};

}  // namespace

VoxelResult build_voxels(const pose_wall_cloud& cloud, const Settings& settings, const Extrinsic& extrinsic,
                         const Axes& axes, VoxelGrid* grid, ReturnsByDirection* returns_lidar, PointSet* cloud_base) {
  VoxelResult result;
  const Pass pass(cloud, settings, extrinsic, axes);
  double leaf_m = settings.voxel_leaf;
  for (int attempt = 0; attempt < kLeafTries && !result.fits; ++attempt) {
    if (attempt > 0) leaf_m *= kLeafGrowth;
    grid->begin(leaf_m);
    result.fits = pass.run(grid, returns_lidar, &result.counts);
    result.leaf_grown = attempt > 0;
  }
  result.leaf_m = leaf_m;
  cloud_base->count = 0;
  if (result.fits) {
    grid->extract(cloud_base);
    result.fingerprint = grid->fingerprint();
  }
  return result;
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/outliers.hpp"

#include <cstring>

#include "base/simd/four_floats.hpp"
#include "engine/cloud/voxel_columns.hpp"

namespace pose_wall {
namespace {

constexpr std::uint8_t kKeepFour[kFour] = {1, 1, 1, 1};  // marks of four kept points, compared at once

class NeighbourCounter {
 public:
  NeighbourCounter(const PointSet& points, VoxelGrid* grid, double radius_m, std::uint32_t needed)
      : points_(points), columns_(grid, radius_m), radius2_(static_cast<float>(radius_m * radius_m)), needed_(needed) {}

  // Voxels next to each other in the list are usually neighbours, which settles most points. has_enough() may find the
  // rest. Looks at the next four points, from i on; near the end of the list nothing is found.
  FourTruths next_have_enough_in_list(std::uint32_t i) {
    static_assert(kLook == 3 && kLook < kFour, "three each way; those before are of the last four");
    if (i + kFour + kLook > points_.count) return FourTruths{};
    const FourPlaces here = four_from(i);
    const Ahead ahead = {are_near(here, four_from(i + 1)), are_near(here, four_from(i + 2)),
                         are_near(here, four_from(i + 3))};
    // Neighbours before a point were found when that earlier point was looked at.
    const FourInts found = ahead.by_1 + picked<3, 4, 5, 6>(last_.by_1, ahead.by_1) +  //
                           ahead.by_2 + picked<2, 3, 4, 5>(last_.by_2, ahead.by_2) +  //
                           ahead.by_3 + picked<1, 2, 3, 4>(last_.by_3, ahead.by_3);
    last_ = ahead;
    return -found >= static_cast<std::int32_t>(needed_);  // true is -1
  }

  // Counting stops at the needed number. For one point after the other.
  bool has_enough(std::uint32_t i) {
    std::uint32_t found = 0;  // itself among them
    steps_ += steps::kVoxelLookedAround;
    columns_.for_each_run(i, [&](std::uint32_t begin, std::uint32_t end) {
      steps_ += kRun;
      while (begin < end && found <= needed_) {
        const std::uint32_t until = end - begin < kAtOnce ? end : begin + kAtOnce;
        found += near_in_run(i, begin, until);
        steps_ += ((until - begin) / kFour + 1) * steps::kFourLookedAt;
        begin = until;
      }
      return found <= needed_;
    });
    return found > needed_;
  }

  std::uint64_t steps_done() const { return steps_ + columns_.searched() * steps::kColumnSearched; }

 private:
  // Distance in the list, each way. Of 2, 3 and 4 the cheapest, by instructions counted (bench/README.md).
  static constexpr std::uint32_t kLook = 3;
  // For each of four points: whether the one so many places further on in the list is near.
  struct Ahead {
    FourTruths by_1{}, by_2{}, by_3{};
  };
  // Points between two checks for enough; a larger number counts points in vain, a smaller one checks more often.
  static constexpr std::uint32_t kAtOnce = 64;  // swept: half and twice change nothing
  static constexpr std::uint64_t kRun = 12;     // steps: its ends are searched for

  FourPlaces four_from(std::uint32_t j) const {
    return {load_four(&points_.x[j]), load_four(&points_.y[j]), load_four(&points_.z[j])};
  }

  FourTruths are_near(const FourPlaces& a, const FourPlaces& b) const {
    const FourFloats dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
    return dx * dx + dy * dy + dz * dz <= radius2_;
  }

  std::uint32_t near_in_run(std::uint32_t i, std::uint32_t begin, std::uint32_t end) const {
    const FourPlaces here{all_four(points_.x[i]), all_four(points_.y[i]), all_four(points_.z[i])};
    FourInts found{};  // true is -1
    for_each_four(begin, end,
                  [&](std::uint32_t k, FourTruths counts) { found -= counts & are_near(here, four_from(k)); });
    return sum_of_lanes(found);
  }

  const PointSet& points_;
  VoxelColumns columns_;
  float radius2_;
  std::uint32_t needed_;
  std::uint64_t steps_ = 0;
  Ahead last_;  // of the four before
};

// Moves the kept points up, in their order.
std::uint32_t close_gaps(Span<const std::uint8_t> keep, PointSet* points) {
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < points->count;) {
    if (i + kFour <= points->count && std::memcmp(&keep[i], kKeepFour, kFour) == 0) {
      points->copy_four(kept, *points, i);
      kept += kFour;
      i += kFour;
    } else {
      if (keep[i] != 0) points->copy(kept++, i);
      ++i;
    }
  }
  return kept;
}

void mark_those_with_neighbours(const Settings& settings, const PointSet& points, VoxelGrid* grid,
                                Span<std::uint8_t> keep, Work* work) {
  const double least_m = 2.0 * grid->leaf_m();
  const double radius_m = settings.outlier_radius > least_m ? settings.outlier_radius : least_m;
  const std::uint64_t left = work->left();
  NeighbourCounter counter(points, grid, radius_m, settings.outlier_min_neighbors);
  for (std::uint32_t i = 0; i < points.count; i += kFour) {
    if (counter.steps_done() > left) {  // the work is spent: the rest is kept unchecked
      std::memset(&keep[i], 1, points.count - i);
      break;
    }
    const FourTruths enough = counter.next_have_enough_in_list(i);
    if (!any_of(~enough)) {  // as most
      std::memcpy(&keep[i], kKeepFour, kFour);
      continue;
    }
    const std::uint32_t end = i + kFour < points.count ? i + kFour : points.count;
    for (std::uint32_t k = i; k < end; ++k) keep[k] = enough[k - i] != 0 || counter.has_enough(k) ? 1 : 0;
  }
  work->add(counter.steps_done());
}

}  // namespace

std::uint32_t remove_outliers(const Settings& settings, VoxelGrid* grid, Span<std::uint8_t> keep, BoundedPoints* points,
                              Work* work) {
  work->add(points->count, steps::kVoxelListed);
  const std::uint32_t before = points->count;
  if (settings.outlier_min_neighbors > 0 && before > 0) {
    mark_those_with_neighbours(settings, *points, grid, keep, work);
    points->count = close_gaps(keep, points);
  }
  points->bound();
  return before - points->count;
}

}  // namespace pose_wall

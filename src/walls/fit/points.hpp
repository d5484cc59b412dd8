// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The points a wall is fitted on. A fit goes through them some twenty times, so they lie in rows in the tangent frame
// of the plane it began with, in the order of the patches that it averages them over; within a patch the surface's come
// before the strips', and what is neither last: who asks for one of them passes over no other.

#pragma once

#include "base/containers/arena.hpp"
#include "base/estimation/patch_fit.hpp"
#include "base/estimation/tangent_points.hpp"
#include "walls/fit/strip_profile.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// u along the road, v up, r towards the machine.
struct WallPoints {
  static constexpr std::uint32_t kMost = 8192;  // 16384 before shares were even (2026-11-22)

  TangentPoints at;
  double measured_per_weight = 1.0;  // of the points that belong here, only a part is; together they stand for all
  Span<float> bias;                  // change of r per metre of range bias
  Eigen::Vector3d sensor;            // u, v, r
  double range_noise_m = 0.0;        // standard deviation of one range
  double z_at_origin_m = 0.0;        // z_level = z_at_origin + v z_per_v + r z_per_r
  double z_per_v = 1.0, z_per_r = 0.0;
  // Of each patch of PatchGrid the places behind its last points: a point of a strip may be the surface's as well, by
  // a small probability.
  struct Patch {
    std::uint32_t surface_only_end, surface_end, strip_end, end;
  };
  Span<Patch> patches;
  Span<float> spare;      // a row for who needs one for a while
  TangentPoints surface;  // a copy of those that are more likely the surface's than not

  void lay_out(Arena& arena);
  // along_level: horizontal and in the plane, so that u tells nothing of the height.
  void begin(const WallScene& scene, const Plane& around, const Eigen::Vector3d& along_level);
  // Those that the list names, kMost at most.
  void add(const PointSet& points_level, Span<const std::uint32_t> list);
  // Begins the patches, and puts the points into their order. places: scratch, one for each point.
  void sort_by_patch(PatchGrid* patches, Span<std::uint32_t> places);
  // Drops the points without weight.
  void keep(Span<const float> weights);

  // Notes what the strips' columns say of each point, and puts each patch's into the order of its ends.
  void mark_columns(const StripProfile& strips, Span<std::uint32_t> places);
  // As the columns say: of points up to a patch's surface_end.
  FourFloats surface_probability(std::uint32_t k) const { return load_four(&probability[k]); }
  void copy_surface();

  // visit(patch, first place): from one patch to the next.
  template <typename Visit>
  void for_each_patch(const Visit& visit) const {
    std::uint32_t begin = 0;
    for (const Patch& patch : patches) {
      visit(patch, begin);
      begin = patch.end;
    }
  }

  double z_level_m(std::uint32_t k) const {
    return z_at_origin_m + z_per_v * static_cast<double>(at.v[k]) + z_per_r * static_cast<double>(at.r[k]);
  }
  FourFloats four_z_level_m(std::uint32_t k) const {
    return static_cast<float>(z_at_origin_m) + static_cast<float>(z_per_v) * load_four(&at.v[k]) +
           static_cast<float>(z_per_r) * load_four(&at.r[k]);
  }

  // What belongs to a point and moves with it.
  template <typename Visit>
  void for_each_row(const Visit& visit) {
    for (Span<float>* row : {&at.u, &at.v, &at.r, &at.weight, &bias}) visit(row);
  }

  // Orders a patch's points by their part, within a part as they were; where the parts end.
  Patch put_into_order(std::uint32_t begin, std::uint32_t end, Span<std::uint32_t> places);

  Span<float> probability;  // of the surface; once columns are marked
  Span<std::uint8_t> part;  // scratch of mark_columns()
  Span<Patch> patch_room;
};

}  // namespace pose_wall

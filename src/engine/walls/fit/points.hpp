// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The points of a wall's fit. A fit reads them some twenty times. So they lie in rows, in the tangent frame of the
// fit's first plane, patch by patch. Within a patch the points are ordered surface, strip, neither, so that each group
// is one contiguous range.

#pragma once

#include "base/containers/arena.hpp"
#include "base/estimation/patch_fit.hpp"
#include "base/estimation/tangent_points.hpp"
#include "engine/walls/fit/strip_profile.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

// u along the road, v up, r towards the machine.
struct WallPoints {
  static constexpr std::uint32_t kMost = 8192;  // 16384 before shares were even (2026-11-22)

  TangentPoints at;
  double measured_per_weight = 1.0;  // scales the weights of the taken share up to all points of the wall
  Span<float> bias;                  // change of r per metre of range bias
  Eigen::Vector3d sensor;            // u, v, r
  double range_noise_m = 0.0;        // standard deviation of one range
  double z_at_origin_m = 0.0;        // z_level = z_at_origin + v z_per_v + r z_per_r
  double z_per_v = 1.0, z_per_r = 0.0;
  // For each patch of PatchGrid, the ends of its groups. A point of a strip may also be the surface's, with a small
  // probability.
  struct Patch {
    std::uint32_t surface_only_end, surface_end, strip_end, end;
  };
  Span<Patch> patches;
  Span<float> spare;      // a row for temporary use
  TangentPoints surface;  // a copy of the points that are more likely the surface's than not

  void lay_out(Arena& arena);
  // along_level: horizontal and in the plane, so that u does not depend on the height.
  void begin(const WallScene& scene, const Plane& around, const Eigen::Vector3d& along_level);
  // Adds the points of the list, kMost at most.
  void add(const PointSet& points_level, Span<const std::uint32_t> list);
  // Starts the patches and orders the points by them. places: scratch, one for each point.
  void sort_by_patch(PatchGrid* patches, Span<std::uint32_t> places);
  // Drops the points without weight.
  void keep(Span<const float> weights);

  // Notes the group of each point by the strips' columns, and orders each patch by it.
  void mark_columns(const StripProfile& strips, Span<std::uint32_t> places);
  // By the columns, for points up to a patch's surface_end.
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

  // All rows of a point, which move together.
  template <typename Visit>
  void for_each_row(const Visit& visit) {
    for (Span<float>* row : {&at.u, &at.v, &at.r, &at.weight, &bias}) visit(row);
  }

  // Orders a patch's points by group and keeps the order within a group. Returns the ends of the groups.
  Patch put_into_order(std::uint32_t begin, std::uint32_t end, Span<std::uint32_t> places);

  Span<float> probability;  // of the surface; valid after mark_columns()
  Span<std::uint8_t> part;  // scratch of mark_columns()
  Span<Patch> patch_room;
};

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the points show of a region, cell by cell: the layer that most of a cell's points lie in.

#pragma once

#include <Eigen/Core>

#include "base/containers/arena.hpp"
#include "base/containers/bounded_points.hpp"
#include "base/estimation/patch_sums.hpp"
#include "base/estimation/surface_patches.hpp"

namespace pose_wall {

// Where to look, in the frame of the points. u along the road, v across or up, h away from the machine: unit vectors at
// right angles, from the frame's origin on.
struct Region {
  Eigen::Vector3d u, v, h;
  double u_from_m, u_to_m;  // ahead and behind
  double v_min_m, v_max_m;
  double h_min_m;  // what is nearer is the machine's
  Eigen::Vector3d sensor_m;
  // Along u and v, half the second derivative: the surface may bend as much where it is not seen.
  Eigen::Vector2d bend_per_m;
  // Whether all of the surface in view tells how it goes on beyond the region along u, and along v: it neither bends
  // there nor ends.
  Eigen::Array<bool, 2, 1> goes_on{true, true};

  Eigen::Vector3d coordinates(const Eigen::Vector3d& p) const { return {u.dot(p), v.dot(p), h.dot(p)}; }
};

struct RegionCell {
  double u, v;    // mean of the layer that most points lie in; the cell's middle where nothing is seen
  float h;        // of that layer
  float first_h;  // of the first layer of several points: what a surveyor's ray may meet
  double weight;  // of the plane's: set by the fit
  bool seen;
  bool open;    // seen through an opening: it shows no surface of the region
  bool inside;  // the region, not the margin beside it

  bool is_surface() const { return seen && !open; }
};

class RegionCells {
 public:
  // A quarter of a metre, and twice that as a margin: cells beside the region tell of those at its edge. In a trial on
  // a real gallery cells of 0.4 m gave three values beyond their levels, and these one.
  static constexpr double kCell_m = 0.25, kMargin_m = 0.5;
  static constexpr double kColumnsMost = 24.0;                   // a longer region has longer cells
  static constexpr std::uint32_t kMost = SurfacePatches::kMost;  // each is a patch

  void lay_out(Arena& arena);
  void fill(const BoundedPoints& points, const Region& region);
  Span<RegionCell> all() const { return cells_.first(columns_ * rows_); }
  double cell_area_m2() const { return cell_u_m_ * kCell_m; }
  // From -1 to 1 over the region and its margin.
  Eigen::Vector2d from_middle(const RegionCell& cell) const;
  // Sums of the points near a plane h = at[0] + at[1] u + at[2] v, by cell, in the order of all(). weight_of(t): of
  // four points, t: how far they lie behind the plane, in widths of width_m; those of reach widths and more are left
  // out.
  template <typename WeightOf>
  Span<const PatchSums> sums_near(const BoundedPoints& points, const Region& region, const Eigen::Vector3d& plane,
                                  double width_m, double reach, const WeightOf& weight_of);

 private:
  static constexpr double kBin_m = 0.25;      // of depth: two hold a surface that lies at the border of one
  static constexpr std::uint32_t kBins = 29;  // 7 m: the width of a wide road; the last one holds all beyond
  static constexpr float kLayerMin = 2.0F;    // voxels: a single one may be dust
  static constexpr double kOpening_m = 3.0;   // of the definition
  struct Bin {
    float count, u, v, h;  // voxels, and sums over them
  };
  struct FourCells {
    FourInts cell;
    FourTruths counts;
  };

  void begin(const Region& region);
  void find_layers();
  void find_openings();
  FourCells cells_of(FourFloats u, FourFloats v, FourTruths counts) const;
  template <typename Visit>
  static void for_each_in(const BoundedPoints& points, const Region& region, const Visit& visit);

  Span<RegionCell> cells_;
  Span<Bin> bins_;
  Span<PatchSums> sums_;
  std::uint32_t columns_ = 0, rows_ = 0;
  double cell_u_m_ = kCell_m;
  float u_from_m_ = 0.0F, v_from_m_ = 0.0F;
};

// visit(first index, u, v, h, which of the four count).
template <typename Visit>
void RegionCells::for_each_in(const BoundedPoints& points, const Region& region, const Visit& visit) {
  const Eigen::Vector3f u = region.u.cast<float>(), v = region.v.cast<float>(), h = region.h.cast<float>();
  for_each_four_points(points, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    visit(i, u.x() * x + u.y() * y + u.z() * z, v.x() * x + v.y() * y + v.z() * z, h.x() * x + h.y() * y + h.z() * z,
          counts);
  });
}

template <typename WeightOf>
Span<const PatchSums> RegionCells::sums_near(const BoundedPoints& points, const Region& region,
                                             const Eigen::Vector3d& plane, double width_m, double reach,
                                             const WeightOf& weight_of) {
  sums_.first(columns_ * rows_).fill(PatchSums{});
  const Eigen::Vector3f sensor = region.coordinates(region.sensor_m).cast<float>(), p = plane.cast<float>();
  const float sensor_off = sensor.z() - p[0] - p[1] * sensor.x() - p[2] * sensor.y();
  const auto per_width = static_cast<float>(1.0 / width_m), most = static_cast<float>(reach);
  for_each_in(points, region, [&](std::uint32_t i, FourFloats u, FourFloats v, FourFloats h, FourTruths counts) {
    const FourFloats r = h - p[0] - p[1] * u - p[2] * v, t = r * per_width;
    const FourCells at = cells_of(u, v, counts & (magnitude_of(t) < all_four(most)));
    if (!any_of(at.counts)) return;
    const FourFloats du = u - sensor.x(), dv = v - sensor.y(), dh = h - sensor.z();
    const FourFloats bias = (r - sensor_off) / root_of(du * du + dv * dv + dh * dh);
    const FourFloats weights = weight_of(t) * load_four(&points.weight[i]);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (at.counts[lane] == 0) continue;
      const PatchPoint point = PatchPoint::of(u[lane], v[lane], r[lane], weights[lane], bias[lane]);
      sums_[static_cast<std::uint32_t>(at.cell[lane])].add(point.sums);
    }
  });
  return sums_.first(columns_ * rows_);
}

}  // namespace pose_wall

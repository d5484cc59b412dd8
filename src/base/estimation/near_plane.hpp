// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Which points lie on a plane, behind it or within a slab: most lie elsewhere and are passed over, whole blocks at a
// time where they can be, four at a time elsewhere.

#pragma once

#include <cstdint>

#include "base/containers/bounded_points.hpp"
#include "base/estimation/plane.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// Distances in floats, to some micrometres. For exact ones use the plane.
class FourDistances {
 public:
  explicit FourDistances(const Plane& plane)
      : nx_(all_four(static_cast<float>(plane.n.x()))),
        ny_(all_four(static_cast<float>(plane.n.y()))),
        nz_(all_four(static_cast<float>(plane.n.z()))),
        d_(all_four(static_cast<float>(plane.d))) {}

  FourFloats of(FourFloats x, FourFloats y, FourFloats z) const { return nx_ * x + ny_ * y + nz_ * z + d_; }
  // From an upright plane, at any height.
  FourFloats of_upright(FourFloats x, FourFloats y) const { return nx_ * x + ny_ * y + d_; }
  FourFloats of(const PointSet& points, std::uint32_t from) const {
    return of(load_four(&points.x[from]), load_four(&points.y[from]), load_four(&points.z[from]));
  }

  // Reach of boxes with these half edges across the plane to each side: the sum of their edges' reaches.
  FourFloats reach_of(FourFloats half_x, FourFloats half_y, FourFloats half_z) const {
    return magnitude_of(nx_) * half_x + magnitude_of(ny_) * half_y + magnitude_of(nz_) * half_z;
  }

 private:
  FourFloats nx_, ny_, nz_, d_;
};

// The space from low_m to high_m before a plane; in floats, too.
class Slab {
 public:
  Slab(const Plane& plane, double low_m, double high_m)
      : distances_(plane), low_m_(static_cast<float>(low_m)), high_m_(static_cast<float>(high_m)) {}
  Slab(const Plane& plane, double half_m) : Slab(plane, -half_m, half_m) {}
  static Slab empty() { return {Plane{}, -1.0}; }

  const FourDistances& distances() const { return distances_; }
  FourTruths holds(FourFloats r_m) const { return (r_m >= low_m_) & (r_m <= high_m_); }
  FourTruths holds(FourFloats x, FourFloats y, FourFloats z) const { return holds(distances_.of(x, y, z)); }
  // True for blocks that may have points in it, for four blocks from one on. For points within a kilometre.
  FourTruths may_meet(const BoundedPoints& points, std::uint32_t block) const;

 private:
  FourDistances distances_;
  float low_m_, high_m_;
};

// The blocks of a list that may hold points of a slab, one after the other.
class BlocksIn {
 public:
  BlocksIn(const BoundedPoints& points, const Slab& slab) : points_(points), slab_(slab) {}

  // The next one's points, from begin to end. False where there is none.
  bool next(std::uint32_t* begin, std::uint32_t* end);

 private:
  const BoundedPoints& points_;
  const Slab& slab_;
  std::uint32_t block_ = 0;
  FourTruths meet_{};  // of the four blocks that block_ is one of
};

// The low limit of a slab that goes on behind its plane, however far.
constexpr double kAnyDepth_m = -1e6;

// visit(first index, which of the four count): over the blocks that may hold points of the slab; others come with them.
template <typename Visit>
void for_each_four_about(const BoundedPoints& points, const Slab& slab, const Visit& visit) {
  std::uint32_t begin = 0, end = 0;
  for (BlocksIn blocks(points, slab); blocks.next(&begin, &end);) for_each_four(begin, end, visit);
}

// visit(i, distance) for the points in a slab, in their order, until it returns false.
template <typename Visit>
void for_each_in_while(const BoundedPoints& points, const Slab& slab, const Visit& visit) {
  std::uint32_t begin = 0, end = 0;
  for (BlocksIn blocks(points, slab); blocks.next(&begin, &end);) {
    for (std::uint32_t i = begin; i < end; i += kFour) {
      const FourFloats r = slab.distances().of(points, i);
      const FourTruths kept = first_of_four(end - i) & slab.holds(r);
      if (!any_of(kept)) continue;
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        if (kept[lane] != 0 && !visit(i + lane, r[lane])) return;
      }
    }
  }
}
template <typename Visit>
void for_each_in(const BoundedPoints& points, const Slab& slab, const Visit& visit) {
  for_each_in_while(points, slab, [&visit](std::uint32_t i, float distance_m) {
    visit(i, distance_m);
    return true;
  });
}

// visit(i) for the points that are in both; it is the first that blocks are passed over by.
template <typename Visit>
void for_each_in_both(const BoundedPoints& points, const Slab& slab, const Slab& other, const Visit& visit) {
  for_each_four_about(points, slab, [&](std::uint32_t i, FourTruths counts) {
    const FourTruths both =
        counts & slab.holds(slab.distances().of(points, i)) & other.holds(other.distances().of(points, i));
    if (!any_of(both)) return;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (both[lane] != 0) visit(i + lane);
    }
  });
}

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Which points lie on a plane, behind it or within a slab: most lie elsewhere and are passed over four at a time.

#pragma once

#include <cstdint>

#include "containers/point_set.hpp"
#include "estimation/plane.hpp"
#include "math/four_floats.hpp"

namespace pose_wall {

// Distances in floats: to some micrometres. Who needs them exactly asks the plane again.
class FourDistances {
 public:
  explicit FourDistances(const Plane& plane)
      : nx_(all_four(static_cast<float>(plane.n.x()))),
        ny_(all_four(static_cast<float>(plane.n.y()))),
        nz_(all_four(static_cast<float>(plane.n.z()))),
        d_(all_four(static_cast<float>(plane.d))) {}

  FourFloats of(FourFloats x, FourFloats y, FourFloats z) const { return nx_ * x + ny_ * y + nz_ * z + d_; }
  FourFloats of(const PointSet& points, std::uint32_t from) const {
    return of(load_four(&points.x[from]), load_four(&points.y[from]), load_four(&points.z[from]));
  }

 private:
  FourFloats nx_, ny_, nz_, d_;
};

// Both sides of a plane up to a distance.
class Slab {
 public:
  Slab(const Plane& plane, double half_m) : distances_(plane), half_m_(static_cast<float>(half_m)) {}
  static Slab empty() { return {Plane{}, -1.0}; }

  FourTruths holds(FourFloats x, FourFloats y, FourFloats z) const {
    return magnitude_of(distances_.of(x, y, z)) <= half_m_;
  }

 private:
  FourDistances distances_;
  float half_m_;
};

// Calls visit(i, distance) for the points whose signed distance from the plane is among those that keep asks for, in
// their order, until it returns false.
template <typename Keep, typename Visit>
void for_each_where(const PointSet& points, const Plane& plane, const Keep& keep, const Visit& visit) {
  const FourDistances distances(plane);
  for (std::uint32_t i = 0; i < points.count; i += kFour) {
    const FourFloats r = distances.of(points, i);
    const FourTruths kept = first_of_four(points.count - i) & keep(r);
    if (!any_of(kept)) continue;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (kept[lane] != 0 && !visit(i + lane, r[lane])) return;
    }
  }
}

// At most limit_m.
template <typename Visit>
void for_each_up_to_while(const PointSet& points, const Plane& plane, double limit_m, const Visit& visit) {
  const FourFloats limit = all_four(static_cast<float>(limit_m));
  for_each_where(
      points, plane, [&limit](FourFloats r) -> FourTruths { return r <= limit; }, visit);
}
template <typename Visit>
void for_each_up_to(const PointSet& points, const Plane& plane, double limit_m, const Visit& visit) {
  for_each_up_to_while(points, plane, limit_m, [&visit](std::uint32_t i, float distance_m) {
    visit(i, distance_m);
    return true;
  });
}

// From low_m to high_m.
template <typename Visit>
void for_each_between(const PointSet& points, const Plane& plane, double low_m, double high_m, const Visit& visit) {
  const FourFloats low = all_four(static_cast<float>(low_m)), high = all_four(static_cast<float>(high_m));
  for_each_where(
      points, plane, [&](FourFloats r) -> FourTruths { return (r >= low) & (r <= high); },
      [&visit](std::uint32_t i, float distance_m) {
        visit(i, distance_m);
        return true;
      });
}

}  // namespace pose_wall

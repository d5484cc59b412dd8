// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Whether a surface steps out of its plane for a while at one place: its points in slices of five centimetres along the
// road. A slice is off the plane where next to nothing lies on it, from top to bottom.

#pragma once

#include <cmath>
#include <cstdint>

namespace pose_wall {

class StepProfile {
 public:
  static constexpr double kHalf_m = 1.0;  // to both sides of the place

  // step_m: points closer to the plane are on it.
  explicit StepProfile(double step_m) : step_m_(step_m) {}

  // beside_m: along the road from the place; residual_m > 0 before the plane.
  void add(double beside_m, double residual_m) {
    const double slice = (beside_m + kHalf_m) * (1.0 / kSlice_m);
    if (!(slice >= 0.0 && slice < kCount)) return;
    Slice& at = slices_[static_cast<std::uint32_t>(slice)];
    const double off_m = std::fabs(residual_m);
    if (!(off_m >= step_m_)) {
      ++at.on;
      return;
    }
    Off& off = at.off[residual_m > 0.0 ? kStepsOut : kStepsBack];
    ++off.count;
    off.sum_m += off_m;
  }

  // By how much the surface lies before or behind the plane at the place, on average over the step; 0 where it lies on
  // the plane, or off it for less than 0.3 m: that is a post or a gap between two.
  double before_m() const { return step(kStepsOut); }
  double behind_m() const { return step(kStepsBack); }

  // Length around the place within which nothing lies on the plane; all of it where that is so to one of its ends.
  double hole_m() const;

 private:
  static constexpr double kSlice_m = 0.05;
  static constexpr std::uint32_t kCount = 40;
  enum Way : std::uint32_t { kStepsOut, kStepsBack };

  struct Off {
    std::uint32_t count = 0;
    double sum_m = 0.0;
  };
  struct Slice {
    std::uint32_t on = 0;
    Off off[2];
  };

  bool is_seen(std::uint32_t slice) const;
  bool lies_on(std::uint32_t slice, Way way) const;
  double step(Way way) const;

  double step_m_;
  Slice slices_[kCount];
};

}  // namespace pose_wall

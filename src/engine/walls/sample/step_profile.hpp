// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Tests whether a surface steps out of its plane over some length at one place, in slices of five centimetres along the
// road. A slice is off the plane if next to nothing lies on it from top to bottom. A sensor that looks past a thing
// before the plane sees the plane behind it as well. Then the thing hides the plane if it takes all elevations that are
// seen there.

#pragma once

#include <cstdint>

namespace pose_wall {

class StepProfile {
 public:
  static constexpr double kHalf_m = 1.0;  // to both sides of the place; swept: half 899 lost, twice 5 lost 1 won
  static constexpr std::uint32_t kPointsMin = 10;  // fewer points may be strays; swept: half 11 moved, twice 11 moved

  // step_m: points closer to the plane are on it.
  explicit StepProfile(double step_m) : step_m_(step_m) {}

  // beside_m: along the road from the place; residual_m > 0 before the plane; elevation: of the ray, as a tangent.
  void add(double beside_m, double residual_m, double elevation);

  // Distance of the surface before or behind the plane at the place, on average over the step. 0 where it lies on the
  // plane, or off it for less than 0.3 m: that is a post, or a gap between two. Where the plane is seen behind it, 0.6
  // m.
  double before_m() const;
  double behind_m() const;

  // Length around the place without a point on the plane; the whole length if that is so up to one of its ends.
  double hole_m() const;

 private:
  // Less than a voxel of the band (8 cm); swept: half 5 lost 1 won, twice 899 lost.
  static constexpr double kSlice_m = 0.05;
  static constexpr std::uint32_t kCount = 40;  // slices of twice kHalf_m
  // A surface lies within two steps (README); swept: half 1 won, twice 2 lost 1 won.
  static constexpr double kDepth_m = 0.15;
  static constexpr std::uint32_t kHides = 3;    // from 0.45 m on: pipes along a wall are closer to it
  static constexpr std::uint32_t kDepths = 27;  // 4 m: things along a wall are no further from it
  static constexpr std::uint32_t kParts = 10;   // of 0.2 m: a sparse sensor's points lie some centimetres apart
  static constexpr std::uint32_t kSlicesPerPart = kCount / kParts;  // four of 5 cm
  enum Way : std::uint32_t { kStepsOut, kStepsBack };

  struct Off {
    std::uint32_t count = 0;
    double sum_m = 0.0;
    void add(double off_m) {
      ++count;
      sum_m += off_m;
    }
  };
  struct Slice {
    std::uint32_t on = 0;
    Off off[2];
  };
  struct Before {
    std::uint64_t elevations = 0;
    std::uint32_t count = 0;
  };

  bool is_seen(std::uint32_t slice) const;
  bool lies_on(std::uint32_t slice, Way way) const;
  double step(Way way) const;
  bool hides_plane(std::uint32_t depth, std::uint32_t part) const;
  double hides_m() const;

  double step_m_;
  Slice slices_[kCount];
  std::uint64_t elevations_ = 0;  // one bit for each
  Before before_[kDepths + 1][kParts];
};

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Pipes and hoses one above the other look like a wall: long, straight, parallel to the road. Where they touch, no ray
// passes. But between two of them their fronts step back, with each height alike along their whole length. Rock differs
// two metres further on, so its mean over the length is nearly the same at every height.

#pragma once

#include <cstdint>

#include "base/simd/four_floats.hpp"

namespace pose_wall {

class GrooveProfile {
 public:
  // Points further than 32 m from the middle along the wall do not count.
  GrooveProfile(double z_min_m, double z_max_m, double u_middle_m);

  // Adds those of four points that count. residual_m: signed distance from the plane of the surface, positive towards
  // the sensor.
  void add(FourFloats u_m, FourFloats z_m, FourFloats residual_m, FourTruths counts);
  // True if two grooves or more lie behind the plane, each between crests above and below.
  bool is_grooved() const;

 private:
  static constexpr std::uint32_t kRows = 64;  // of 5 cm: 3.2 m, stretched where the band is higher
  struct Row {
    FourFloats sums{};         // number of points, their residuals, and the squares of these
    std::uint64_t places = 0;  // a bit for each metre of the length with points
  };
  // Mean of a row over the length and its standard error; false if too little of the row is seen.
  static bool mean_of(const Row& row, double* mean_m, double* error_m);

  Row rows_[kRows];
  float z_min_, rows_per_m_, u_from_;
};

}  // namespace pose_wall

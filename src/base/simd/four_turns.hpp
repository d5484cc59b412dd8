// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>

#include "base/simd/four_floats.hpp"

namespace pose_wall {

// A turn and a shift of four points at once, in floats: to some micrometres within 30 m, tens at 200 m.
class FourTurns {
 public:
  explicit FourTurns(const Eigen::Matrix3d& R, const Eigen::Vector3d& shift_m = Eigen::Vector3d::Zero()) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) R_[row][column] = static_cast<float>(R(row, column));
      shift_m_[row] = static_cast<float>(shift_m[row]);
    }
  }

  FourPlaces operator()(FourFloats x, FourFloats y, FourFloats z) const { return shifted(turned(x, y, z)); }

  FourPlaces turned(FourFloats x, FourFloats y, FourFloats z) const {
    return {of(0, x, y, z), of(1, x, y, z), of(2, x, y, z)};
  }
  FourPlaces shifted(const FourPlaces& turned) const {
    return {turned.x + shift_m_[0], turned.y + shift_m_[1], turned.z + shift_m_[2]};
  }

 private:
  FourFloats of(int row, FourFloats x, FourFloats y, FourFloats z) const {
    return R_[row][0] * x + R_[row][1] * y + R_[row][2] * z;
  }

  float R_[3][3], shift_m_[3];
};

}  // namespace pose_wall

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Creeps along a road without a map, by the scan alone: for a machine that does not know where it is yet.

#pragma once

#include <vector>

#include "lab/drive/machine.hpp"
#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

class RoadFeeler {
 public:
  // The arc with the most room, ahead or behind; it turns back only where there is no way on. Standing still: no way.
  Motion creep(const pose_wall_planar_scan& scan);
  // From now on the other way.
  void turn_back() { drive_ = -drive_; }

 private:
  struct Arc {
    double curvature_1_m = 0.0, free_m = 0.0;
  };
  Arc best(double drive) const;
  double free_m(double drive, double curvature_1_m) const;

  std::vector<sim::Place> things_;  // in base
  double drive_ = 1.0;
};

}  // namespace pose_wall::tools

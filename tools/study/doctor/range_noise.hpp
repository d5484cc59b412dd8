// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How much a range scatters: from the same directions looked along again, or from what lies off floor and walls.

#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "study/doctor/recording.hpp"
#include "study/doctor/road_axis.hpp"
#include "study/doctor/road_frame.hpp"

namespace pose_wall::tools::doctor {

struct RangeNoise {
  double repeated_m = 0.0;      // standard deviation; NaN where directions do not come again
  double repeated_share = 0.0;  // of the returns of one frame, those whose direction came again
  double plane_m = 0.0;         // rock included; NaN where there is no plane

  // The smaller of the two: a sensor that moves spoils the one, rock the other. NaN where there is neither.
  double best_m() const { return std::fmin(repeated_m, plane_m); }
};

RangeNoise look_at_noise(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road);

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What closes the road at its two ends: where a heading face stands at one of them, that is ahead.

#pragma once

#include <optional>

#include "study/doctor/recording.hpp"
#include "study/doctor/road_axis.hpp"
#include "study/doctor/road_frame.hpp"

namespace pose_wall::tools::doctor {

struct RoadEnds {
  double roof_m = 0.0;                 // above the floor; NaN: not seen
  std::optional<double> face_plus_m;   // from the base origin, along the road's direction
  std::optional<double> face_minus_m;  // and against it

  // One end is closed, the other is not.
  bool tells_ahead() const { return face_plus_m.has_value() != face_minus_m.has_value(); }
};

RoadEnds look_at_ends(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road);

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The machine's own body: what stands near the sensor, fixed in its frame, and is neither floor nor wall nor roof. It
// carries the sensor, so it lies ahead of it or behind it, and it ends. A conveyor, a curtain or a parked vehicle stays
// in place too while the machine stands. A box about one of these blinds the engine and the stop, so a thing beside the
// sensor gets none, and neither does a thing that runs on along the road.

#pragma once

#include <cstddef>
#include <vector>

#include "study/doctor/near_cells.hpp"
#include "study/doctor/recording.hpp"
#include "study/doctor/road_axis.hpp"
#include "study/doctor/road_ends.hpp"
#include "study/doctor/road_frame.hpp"

namespace pose_wall::tools::doctor {

// A thing that stayed in place and gets no box.
struct LeftOut {
  Box box_base;
  const char* why = "";  // in English: translate it where it is shown
};

struct BodySeen {
  std::vector<Box> boxes_base;    // with a margin; for body_box_1 to body_box_4
  double in_boxes_share = 0.0;    // of all returns, those inside
  std::size_t cells = 0;          // of the body
  std::size_t cells_below = 0;    // of them, those between the sensor and the floor
  std::vector<LeftOut> left_out;  // fixed and near, but not as a body is
  double passing_share = 0.0;     // of the near returns, those of things that moved
  std::uint32_t slices = 0;       // parts of the recording that were compared; under 2 nothing can be told
};

BodySeen look_for_body(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road,
                       const RoadEnds& ends);

}  // namespace pose_wall::tools::doctor

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How the sensor hangs on the machine, upright or upside down, and all that is seen if it is true.

#pragma once

#include <optional>

#include "pose_wall.hpp"
#include "study/doctor/body_seen.hpp"
#include "study/doctor/floor_seen.hpp"
#include "study/doctor/range_noise.hpp"
#include "study/doctor/recording.hpp"
#include "study/doctor/road_axis.hpp"
#include "study/doctor/road_ends.hpp"

namespace pose_wall::tools::doctor {

struct SupposedMount {
  bool is_flipped = false;
  api::Config config;     // as told, then levelled
  double tilt_rad = 0.0;  // of the floor, in the mounting as told (or that turned upside down)
  FloorSeen floor;
  RoadAxis road;
  RoadEnds ends;
  BodySeen body;
  RangeNoise noise;
};

SupposedMount suppose_mount(const api::Config& told, bool flipped, const std::vector<KeptFrame>& frames);

struct MountChoice {
  SupposedMount likely;
  std::optional<SupposedMount> other;  // where a floor is seen in that, too
  bool is_sure = false;
  std::string reason;
  bool contradicts_height = false;  // no plane lies where --height says
};

// `height_m`: of the sensor above the floor, as somebody measured it. `is_told`: the config names a turn of the sensor.
MountChoice choose_mount(const api::Config& told, bool is_told, std::optional<double> height_m,
                         const std::vector<KeptFrame>& frames);

}  // namespace pose_wall::tools::doctor

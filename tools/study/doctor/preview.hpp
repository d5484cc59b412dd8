// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The recording by the proposed settings, measured as `pose_wall run` measures it: every frame in its order, with
// smoothing, holding and motion as they are set. So the shares here are those that `run` prints for the same frames.

#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "io/config_file/load_config.hpp"
#include "io/frames/frame_source.hpp"
#include "pose_wall.h"

namespace pose_wall::tools::doctor {

struct Preview {
  using Numbers = std::array<double, POSE_WALL_QUANTITIES>;
  std::size_t frames = 0;               // that could be measured
  Numbers valid{}, degraded{}, held{};  // shares of the frames; the rest is invalid
  Numbers level{};                      // median protection level where the value is not invalid; NaN: never
  std::array<std::size_t, POSE_WALL_REASON_COUNT> reasons{};  // frames that have each
  double travel_m = 0.0;  // along the road between the two farthest frames, where motion measured it; else 0

  // Names of the most frequent reasons, at most `count`, joined by ", ".
  std::string reasons_text(std::size_t count) const;
};

using NextFrame = std::function<std::optional<SourcedFrame>()>;

// To the end of the frames. Throws ConfigError when the engine refuses the settings.
Preview preview(const LoadedConfig& settings, double rate_hz, const NextFrame& next);

}  // namespace pose_wall::tools::doctor
